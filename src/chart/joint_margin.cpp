#include "chart/joint_margin.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "chart/edge_surface.hpp"
#include "chart/nearest_point.hpp"
#include "strutt/floquet/sensitivity.hpp"
#include "strutt/model/model_derivative.hpp"

namespace strutt {
namespace {

constexpr std::size_t kMostStarts = 8;
constexpr double kBeyond = 1.001;  // how far behind a known edge a ray goes
constexpr double kBefore = 0.999;  // how far before the nearest edge known no other is looked for
constexpr double kSame = 1e-12;    // difference of distances that means nothing
constexpr int kMostRounds = 20;

using Vector = Eigen::VectorXd;

struct Start {
  Vector direction;
  double length;
};

/// Directions to the edges that single parameters reach, nearest first, and to the gradient of F at the
/// design.
std::vector<Start> starts(const Scene& scene, const std::vector<std::string>& taking_part,
                          const std::vector<ParameterMargin>& alone) {
  const auto size = static_cast<Eigen::Index>(taking_part.size());
  std::vector<Start> result;
  for (const ParameterMargin& row : alone) {
    const auto found = std::ranges::find(taking_part, row.parameter);
    if (found == taking_part.end()) continue;
    for (const auto& edge : {row.lower_edge, row.upper_edge}) {
      if (!edge) continue;
      const double change = (*edge - row.value) / row.value;
      const Vector axis = Vector::Unit(size, found - taking_part.begin());
      result.push_back({std::copysign(1.0, change) * axis, std::abs(change)});
    }
  }
  std::ranges::sort(result, {}, &Start::length);
  if (result.size() > kMostStarts) result.resize(kMostStarts);
  if (result.empty()) return result;
  MonodromyEngine engine;
  Vector gradient(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::string& path = taking_part[static_cast<std::size_t>(i)];
    gradient[i] = sensitivity(engine, scene, path).margin.value * parameter(scene, path);
  }
  const double length = gradient.norm();
  if (std::isfinite(length) && length > 0.0)
    for (const double side : {-1.0, 1.0}) result.push_back({side / length * gradient, result.front().length});
  return result;
}

/// The nearest point of one surface, if it is nearer than what is known.
class SurfaceSearch {
 public:
  SurfaceSearch(EdgeSurface& surface, JointMargin& result, const std::atomic<bool>* cancel)
      : surface_(surface),
        result_(result),
        nearest_(surface, static_cast<Eigen::Index>(result.parameters.size()), cancel) {}

  /// Whether there is a nearer point next to the ray in a direction.
  bool from(const Vector& direction, double most) {
    const auto ray = nearest_.shortest(direction, most, std::abs(result_.distance) * (1.0 + kSame));
    if (!ray || !is_better(*ray)) return false;
    const Vector point = nearest_.point(*ray);
    if (const auto next = surface_.behind_closed(point)) {
      behind_ = next;
      return false;
    }
    result_.distance = std::copysign(ray->value, result_.distance);
    result_.error = NearestPoint::error(*ray);
    result_.edge = surface_.values(point);
    result_.tongue = surface_.tongue(point);
    result_.method = surface_.method();
    return true;
  }

  /// Nearer points anywhere else.
  void everywhere() {
    for (int round = 0; round < kMostRounds && !behind_ && std::isfinite(result_.distance); ++round) {
      const double distance = kBefore * std::abs(result_.distance);
      const auto direction = nearest_.outside(distance);
      if (!direction || !from(*direction, distance)) break;
    }
  }

  /// Where this surface bounds nothing for its tongue is closed: the next one.
  const std::optional<EdgeSurface::Edge>& behind() const { return behind_; }

 private:
  /// Nearer, or as near with a smaller error.
  bool is_better(const SpherePoint& ray) const {
    const double known = std::abs(result_.distance);
    return ray.value < known * (1.0 - kSame) ||
           (ray.value < known * (1.0 + kSame) && NearestPoint::error(ray) < result_.error);
  }

  EdgeSurface& surface_;
  JointMargin& result_;
  NearestPoint nearest_;
  std::optional<EdgeSurface::Edge> behind_;
};

/// An edge of one parameter that is nearer than what the rays found: they miss what a line only touches, as
/// at the tip of a tongue.
void include(const ParameterMargin& row, const Scene& scene, JointMargin& result) {
  const auto found = std::ranges::find(result.parameters, row.parameter);
  if (found == result.parameters.end() || (!row.lower_edge && !row.upper_edge)) return;
  const auto distance = [&](const std::optional<double>& edge) {
    return edge ? std::abs(*edge - row.value) : HUGE_VAL;
  };
  const double edge =
      distance(row.lower_edge) <= distance(row.upper_edge) ? *row.lower_edge : *row.upper_edge;
  const double error = row.error * std::max(1.0, std::abs(edge)) / std::abs(row.value);
  if (!(std::abs(row.relative_distance) + error < std::abs(result.distance) - result.error)) return;
  result.distance = row.relative_distance;
  result.error = error;
  result.edge.clear();
  for (const std::string& path : result.parameters) result.edge.push_back(parameter(scene, path));
  result.edge[static_cast<std::size_t>(found - result.parameters.begin())] = edge;
  result.tongue = row.tongue;
  result.method = row.method;
}

}  // namespace

JointMargin joint_margin(const Scene& scene, Verdict verdict, const std::vector<ParameterMargin>& alone,
                         const MarginOptions& options) {
  JointMargin result;
  const double sign = verdict == Verdict::stable ? 1.0 : -1.0;
  result.distance *= sign;
  for (const ParameterMargin& row : alone)
    if (row.value != 0.0 && keeps_structure(scene, row.parameter)) result.parameters.push_back(row.parameter);
  const auto directions = starts(scene, result.parameters, alone);
  std::vector<std::optional<EdgeSurface::Edge>> edges;
  for (const auto& edge : bounding_edges(scene, verdict == Verdict::stable)) edges.emplace_back(edge);
  if (edges.empty()) edges.emplace_back();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EdgeSurface surface(scene, result.parameters, edges[i], sign);
    SurfaceSearch search(surface, result, options.cancel);
    for (const Start& start : directions) search.from(start.direction, start.length * kBeyond);
    search.everywhere();
    if (search.behind()) edges.push_back(search.behind());
    if (options.cancel != nullptr && *options.cancel) return result;
  }
  for (const ParameterMargin& row : alone) include(row, scene, result);
  // no edge found says nothing where that of a parameter alone is not known
  const bool unknown = std::ranges::any_of(alone, [](const auto& row) { return std::isnan(row.distance); });
  if (unknown && std::isinf(result.distance)) result.distance = result.error = NAN;
  if (!(result.error <= options.tolerance)) result.outcome = Outcome::tolerance_not_reached;
  return result;
}

}  // namespace strutt
