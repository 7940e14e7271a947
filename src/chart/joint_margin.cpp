#include "chart/joint_margin.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "chart/edge_surface.hpp"
#include "strutt/floquet/sensitivity.hpp"
#include "strutt/model/model_derivative.hpp"

namespace strutt {
namespace {

constexpr int kRaySteps = 24;
constexpr int kMostTurns = 60;
constexpr std::size_t kMostStarts = 6;
constexpr double kBeyond = 1.001;  // how far behind a known edge a ray goes
constexpr double kParallel =
    1e-16;  // squared angle between ray and normal, below which r is right to rounding

using Vector = std::vector<double>;

double product(const Vector& a, const Vector& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

Vector combined(const Vector& a, double factor, const Vector& b) {
  Vector result = a;
  for (std::size_t i = 0; i < a.size(); ++i) result[i] += factor * b[i];
  return result;
}

Vector unit(Vector v) {
  const double length = std::sqrt(product(v, v));
  for (double& x : v) x /= length;
  return v;
}

/// A ray from the design to a surface.
struct Ray {
  double length = HUGE_VAL;
  double error = 0.0;
  Vector direction;
  Vector normal;               ///< of the surface where the ray ends
  double slope_squared = 1.0;  ///< squared sine of the angle between both; 1 without a normal
};

class NearestPoint {
 public:
  NearestPoint(EdgeSurface& surface, std::size_t size) : surface_(surface), centre_(size, 1.0) {}

  /// The shortest ray that turning `direction` into the normal leads to; not longer than `most`.
  Ray from(const Vector& direction, double most) {
    Ray best = ray(direction, most);
    for (int turn = 0; turn < kMostTurns && std::isfinite(best.length); ++turn) {
      if (best.slope_squared < kParallel || !turned(best)) break;
    }
    return best;
  }

  Vector point(const Ray& r) const { return combined(centre_, r.length, r.direction); }

 private:
  /// Turns the ray towards the normal, less far if it becomes longer. As long: only if it is nearer to the
  /// normal.
  bool turned(Ray& best) {
    const Vector difference = combined(best.normal, -1.0, best.direction);
    for (double share = 1.0; share > 1e-3; share *= 0.25) {
      const Ray next = ray(unit(combined(best.direction, share, difference)), best.length * 1.01);
      const bool shorter = next.length < best.length - best.error - next.error;
      const bool as_long = next.length < best.length + best.error + next.error;
      if (shorter || (as_long && next.slope_squared < 0.5 * best.slope_squared)) {
        best = next;
        return true;
      }
    }
    return false;
  }

  double value(const Vector& direction, double length) {
    return surface_.at(combined(centre_, length, direction)).value;
  }

  /// The first point of the surface on a ray.
  Ray ray(const Vector& direction, double most) {
    double before = 0.0;
    for (int i = 1; i <= kRaySteps; ++i) {
      const double length = most * i / kRaySteps, f = value(direction, length);
      if (std::isnan(f)) return {};  // no such scene from here on
      if (f <= 0.0) return solved(direction, before, length);
      before = length;
    }
    return {};
  }

  Ray solved(const Vector& direction, double low, double high) {
    const auto f = [&](double length) { return value(direction, length); };
    const double at_low = f(low), at_high = f(high);
    ZeroBracket bracket{high, high};
    if (at_high < 0.0) bracket = bracketed_zero(f, low, high, at_low, at_high, are_close);
    const double length = bracket.middle();
    Ray result{length, uncertainty(direction, length, bracket.high - bracket.low), direction, {}};
    result.normal = surface_.normal(point(result), direction);
    if (result.normal.empty()) return result;
    const Vector difference = combined(result.normal, -1.0, direction);
    const double chord = product(difference, difference);  // 2 (1 - cos)
    result.slope_squared = std::min(1.0, chord);
    return result;
  }

  /// What the error of F is in length.
  double uncertainty(const Vector& direction, double length, double bracket) {
    const double step = 1e-5 * length;
    const double slope =
        std::abs(value(direction, length + step) - value(direction, length - step)) / (2.0 * step);
    const Margin f = surface_.at(combined(centre_, length, direction));
    const double by_value = slope > 0.0 ? (std::abs(f.value) + f.error) / slope : HUGE_VAL;
    return std::min(by_value, length) * (1.0 + 1e-3) + bracket + 4.0 * kUnit * length;
  }

  EdgeSurface& surface_;
  Vector centre_;
};

/// Directions to the edges that single parameters reach, nearest first, and to the gradient of F at the
/// design.
std::vector<Ray> starts(const Scene& scene, const std::vector<std::string>& taking_part,
                        const std::vector<ParameterMargin>& alone) {
  std::vector<Ray> result;
  for (const ParameterMargin& row : alone) {
    const auto found = std::ranges::find(taking_part, row.parameter);
    if (found == taking_part.end()) continue;
    for (const auto& edge : {row.lower_edge, row.upper_edge}) {
      if (!edge) continue;
      Vector direction(taking_part.size(), 0.0);
      const double change = (*edge - row.value) / row.value;
      direction[static_cast<std::size_t>(found - taking_part.begin())] = std::copysign(1.0, change);
      result.push_back({std::abs(change), 0.0, direction, {}});
    }
  }
  std::ranges::sort(result, {}, &Ray::length);
  if (result.size() > kMostStarts) result.resize(kMostStarts);
  if (result.empty()) return result;
  MonodromyEngine engine;
  Vector gradient;
  for (const std::string& path : taking_part)
    gradient.push_back(sensitivity(engine, scene, path).margin.value * parameter(scene, path));
  const double size = product(gradient, gradient);
  if (std::isfinite(size) && size > 0.0)
    for (const double side : {-1.0, 1.0})
      result.push_back(
          {result.front().length, 0.0, unit(combined(Vector(gradient.size(), 0.0), side, gradient)), {}});
  return result;
}

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
  const auto rays = starts(scene, result.parameters, alone);
  std::vector<std::optional<EdgeSurface::Edge>> edges;
  for (const auto& edge : bounding_edges(scene, verdict == Verdict::stable)) edges.emplace_back(edge);
  if (edges.empty()) edges.emplace_back();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EdgeSurface surface(scene, result.parameters, edges[i], sign);
    std::optional<EdgeSurface::Edge> behind;
    for (const Ray& start : rays) {
      if (options.cancel != nullptr && *options.cancel) return result;
      NearestPoint search(surface, result.parameters.size());
      const double most = std::min(start.length, std::abs(result.distance)) * kBeyond;
      const Ray found = search.from(start.direction, most);
      if (!(found.length < std::abs(result.distance))) continue;
      const Vector point = search.point(found);
      if (const auto next = surface.behind_closed(point)) {
        behind = next;
        continue;
      }
      result.distance = sign * found.length;
      result.error = found.error + found.length * found.slope_squared;
      result.edge = surface.values(point);
      result.tongue = surface.tongue(point);
      result.method = surface.method();
    }
    if (behind) edges.push_back(behind);
  }
  for (const ParameterMargin& row : alone) include(row, scene, result);
  if (!(result.error <= options.tolerance)) result.outcome = Outcome::tolerance_not_reached;
  return result;
}

}  // namespace strutt
