#include "chart/cell_engine.hpp"

#include <cmath>
#include <limits>

#include "strutt/base/error.hpp"

namespace strutt {

StabilityParts parts_of(const std::vector<Layer>& layers) {
  StabilityParts parts{.verdict = false, .winding = false, .matrix = false};
  for (const Layer layer : layers) {
    parts.verdict = parts.verdict || layer == Layer::verdict;
    parts.winding = parts.winding || layer == Layer::winding;
    parts.matrix = parts.matrix || layer == Layer::discriminant;
  }
  return parts;
}

CellEngine::CellEngine(const Scene& scene, const ChartRequest& request)
    : scene_(scene),
      x_(&parameter(scene_, request.x.parameter)),
      y_(&parameter(scene_, request.y.parameter)),
      options_{.tolerance = request.tolerance,
               .method = request.method == Method::surrogate ? Method::automatic : request.method,
               .cancel = request.cancel},
      parts_(parts_of(request.layers)) {}

std::vector<Stability> CellEngine::compute(std::span<const std::array<double, 2>> points) {
  std::vector<LinearModel> models;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    *x_ = points[i][0];
    *y_ = points[i][1];
    try {
      LinearModel model = linear_model(scene_);
      std::visit([](const auto& m) { m.validate(); }, model);
      models.push_back(std::move(model));
      places.push_back(i);
    } catch (const InvalidInput&) {
      // outcome failed: the corners were checked, but not every combination inside need be a body
    }
  }
  auto found = analyse(engine_, models, options_, parts_);
  std::vector<Stability> results(points.size());
  for (std::size_t j = 0; j < places.size(); ++j) results[places[j]] = std::move(found[j]);
  return results;
}

double written_trace(double trace) {
  return std::abs(trace) > 1e300 ? std::copysign(std::numeric_limits<double>::infinity(), trace) : trace;
}

double layer_value(const Stability& cell, Layer layer) {
  if (layer == Layer::outcome) return static_cast<double>(cell.outcome);
  const bool has_value = cell.outcome == Outcome::converged || cell.outcome == Outcome::tolerance_not_reached;
  if (layer == Layer::verdict) return static_cast<double>(has_value ? cell.verdict : Verdict::unresolved);
  if (!has_value) return std::numeric_limits<double>::quiet_NaN();
  switch (layer) {
    case Layer::growth:
      return cell.growth;
    case Layer::winding:
      return cell.winding;
    case Layer::discriminant:
      return written_trace(cell.discriminant * std::exp(cell.log_scale));
    default:
      return cell.margin;
  }
}

}  // namespace strutt
