#include "chart/surrogate_build.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "chart/box_subdivision.hpp"
#include "chart/surrogate_box.hpp"

namespace strutt {
namespace {

/// Largest |surrogate - engine| over the entries at a point, in units of the sum of both bounds.
double disagreement(const SurrogateBox& box, const std::array<double, 2>& at,
                    const PropagatorSample& engine) {
  if (!engine.valid) return std::numeric_limits<double>::infinity();
  const auto shift = static_cast<int>(std::clamp(engine.exponent - box.exponent, -2000L, 2000L));
  const auto in_unit_of_box = [shift](double v) { return std::ldexp(v, shift); };
  const auto exact = at_kappa(engine.value, engine.error, box.kappa);
  const Eigen::ArrayXXd difference =
      (evaluate(box, at[0], at[1]) - exact.value.unaryExpr(in_unit_of_box)).cwiseAbs();
  return (difference / (error_matrix(box) + exact.error.unaryExpr(in_unit_of_box)).array()).maxCoeff();
}

/// Pseudo-random points of a box; the generator's raw bits, since distributions differ between libraries.
std::vector<std::array<double, 2>> scattered(const SurrogateBox& box, std::mt19937_64& random) {
  std::vector<std::array<double, 2>> points(kChecks);
  for (auto& point : points) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double share = static_cast<double>(random() >> 11) * 0x1p-53;
      point[axis] = std::lerp(box.low[axis], box.high[axis], share);
    }
  }
  return points;
}

/// False: cancelled.
bool check(SurrogateBox& box, const Axis& x, const Axis& y, const Sampling& referee, std::mt19937_64& random,
           SurrogateReport& report) {
  const auto points = scattered(box, random);
  std::vector<PropagatorSample> engine;
  if (!referee(parameter_values(x, y, points), engine)) return false;
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    largest = std::max(largest, disagreement(box, points[i], engine[i]));
    report.right_hand_sides += engine[i].right_hand_sides;
  }
  report.checks += points.size();
  report.largest_check = std::max(report.largest_check, largest);
  if (!(largest <= 1.0)) {
    box.interpolated = false;
    ++report.failed_checks;
  }
  return true;
}

}  // namespace

SurrogateBuild build_surrogate(const Scene& scene, const Axis& x, const Axis& y,
                               const SurrogateOptions& options, const SurrogateScope& scope,
                               const SurrogateSource& source) {
  SurrogateBuild built;
  built.data.scene = scene;
  built.data.x = x;
  built.data.y = y;
  built.data.tolerance = options.tolerance;
  built.data.kind = scope.kind;
  built.data.even_phase = scope.even_phase;
  auto& report = built.data.report;
  const Sampling nodes = [&](const auto& points, auto& result) {
    return source.nodes(parameter_values(x, y, points), result);
  };
  const auto rounding = coordinate_errors(x, y);
  std::mt19937_64 random(1928);  // one seed, so that the same chart is checked at the same points
  const auto attempt = [&](SurrogateBox& box, double affordable) {
    auto build = build_box(box, scope.kind, nodes, rounding, options.tolerance, affordable);
    report.nodes += build.nodes;
    report.right_hand_sides += build.right_hand_sides;
    if (box.interpolated && !check(box, x, y, source.referee, random, report))
      build.outcome = BoxOutcome::cancelled;
    return build;
  };
  const auto receive = [&](SurrogateBox&& box, BoxOutcome outcome) {
    if (box.interpolated) {
      ++report.boxes;
      const auto degree = std::max(box.coefficients[0].rows(), box.coefficients[0].cols()) - 1;
      report.highest_degree = std::max(report.highest_degree, static_cast<int>(degree));
    } else if (outcome != BoxOutcome::interpolated) {
      ++report.boxes_left_out;
    }
    built.data.boxes.push_back(std::move(box));
  };
  built.cancelled = !subdivide(x, y, attempt, receive);
  return built;
}

}  // namespace strutt
