#include "chart/cell_engine.hpp"

#include <cmath>
#include <limits>

#include "strutt/base/error.hpp"

namespace strutt {

CellEngine::CellEngine(const Scene& scene, const ChartRequest& request)
    : scene_(scene),
      x_(&parameter(scene_, request.x.parameter)),
      y_(&parameter(scene_, request.y.parameter)),
      options_{.tolerance = request.tolerance,
               .method = request.method == Method::surrogate ? Method::automatic : request.method,
               .cancel = request.cancel} {
  for (const Layer layer : request.layers) {
    parts_.winding = parts_.winding || layer == Layer::winding;
    parts_.matrix = parts_.matrix || layer == Layer::discriminant;
  }
}

Stability CellEngine::compute(double x, double y) {
  *x_ = x;
  *y_ = y;
  try {
    return analyse(engine_, linear_model(scene_), options_, parts_);
  } catch (const InvalidInput&) {
    return {};  // outcome failed: the corners were checked, but not every combination inside need be a body
  }
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
