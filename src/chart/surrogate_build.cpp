#include "chart/surrogate_build.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <random>

#include "chart/hill_nodes.hpp"
#include "chart/surrogate_box.hpp"
#include "chart/surrogate_scope.hpp"
#include "chart/system_nodes.hpp"
#include "strutt/base/parallel.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;
// Of the tolerance, for the engine: the errors at the nodes that have the largest factors count where they
// are small too.
constexpr double kNodeShare = 1e-6, kCheckShare = 1e-4;
constexpr double kSystemShare = 1e-2;  // the same for systems, whose nodes are dear
constexpr double kLowestNodeTolerance = 1e-16, kLowestTolerance = 1e-13;
constexpr double kShareOfCells =
    0.25;                     // the nodes of all boxes, tried ones included, as a share of the cells
constexpr int kChecks = 16;   // per box
constexpr int kDeepest = 24;  // halvings from the whole chart to a box
constexpr std::size_t kMostBoxes = 4096;

/// The parameter value at an axis coordinate.
double parameter_value(const Axis& axis, double coordinate) {
  return axis.scale == AxisScale::linear ? coordinate : std::copysign(std::exp(coordinate), axis.from);
}

/// Bound of the rounding between a parameter value and its coordinate, both ways.
double coordinate_error(const Axis& axis, double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  return axis.scale == AxisScale::linear ? kUnit * largest : 4.0 * kUnit * (1.0 + largest);
}

/// Parameter values of points in axis coordinates.
std::vector<std::array<double, 2>> parameter_values(const Axis& x, const Axis& y,
                                                    const std::vector<std::array<double, 2>>& points) {
  std::vector<std::array<double, 2>> values;
  for (const auto& p : points) values.push_back({parameter_value(x, p[0]), parameter_value(y, p[1])});
  return values;
}

/// The engine at scattered points of Hill equations, one model per thread.
class HillReferee {
 public:
  HillReferee(const Scene& scene, const Axis& x, const Axis& y, const std::optional<double>& even_phase,
              const ParallelOptions& parallel)
      : parallel_(parallel) {
    for (int slot = 0; slot < thread_count(parallel_); ++slot)
      models_.push_back(std::make_unique<HillModel>(scene, x, y, even_phase));
  }

  bool sample(const std::vector<std::array<double, 2>>& points, double tolerance,
              std::vector<PropagatorSample>& result) {
    result.assign(points.size(), {});
    const bool complete = parallel_for(points.size(), parallel_, [&](std::size_t i, int slot) {
      result[i] = models_[static_cast<std::size_t>(slot)]->sample(points[i][0], points[i][1], tolerance,
                                                                  parallel_.cancel);
    });
    return complete && !(parallel_.cancel != nullptr && parallel_.cancel->load());
  }

 private:
  ParallelOptions parallel_;
  std::vector<std::unique_ptr<HillModel>> models_;
};

SurrogateSource source_of(const SurrogateScope& scope, const Scene& scene, const Axis& x, const Axis& y,
                          const SurrogateOptions& options) {
  const ParallelOptions parallel{.threads = options.threads, .cancel = options.cancel};
  if (scope.is_system) {
    const auto systems = std::make_shared<SystemNodes>(scene, x, y, scope.splits_damping, parallel);
    const auto sample = [systems, tolerance = kSystemShare * options.tolerance](const auto& points,
                                                                                auto& result) {
      return systems->sample(points, tolerance, result);
    };
    return {sample, sample};
  }
  const auto nodes = std::make_shared<HillNodes>(scene, x, y, scope.even_phase, parallel);
  const auto referee = std::make_shared<HillReferee>(scene, x, y, scope.even_phase, parallel);
  return {[nodes, tolerance = std::max(kNodeShare * options.tolerance, kLowestNodeTolerance)](
              const auto& points, auto& result) { return nodes->sample(points, tolerance, result); },
          [referee, tolerance = std::max(kCheckShare * options.tolerance, kLowestTolerance)](
              const auto& points, auto& result) { return referee->sample(points, tolerance, result); }};
}

/// Cells of the chart in a box, as if they were spread evenly (they are, in axis coordinates).
double cells_in(const SurrogateBox& box, const SurrogateBox& whole, const Axis& x, const Axis& y) {
  const auto share = [&](std::size_t axis) {
    return (box.high[axis] - box.low[axis]) / (whole.high[axis] - whole.low[axis]);
  };
  return static_cast<double>(x.points) * share(0) * static_cast<double>(y.points) * share(1);
}

std::array<SurrogateBox, 2> halves(const SurrogateBox& box, std::size_t axis) {
  SurrogateBox first, second;
  first.low = second.low = box.low;
  first.high = second.high = box.high;
  first.high[axis] = second.low[axis] = 0.5 * (box.low[axis] + box.high[axis]);
  return {first, second};
}

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

struct Pending {
  SurrogateBox box;
  int depth;
};

}  // namespace

SurrogateBuild build_surrogate(const Scene& scene, const Axis& x, const Axis& y,
                               const SurrogateOptions& options) {
  return build_surrogate(scene, x, y, options, source_of(surrogate_scope(scene, x, y), scene, x, y, options));
}

SurrogateBuild build_surrogate(const Scene& scene, const Axis& x, const Axis& y,
                               const SurrogateOptions& options, const SurrogateSource& source) {
  SurrogateBuild built;
  built.data.scene = scene;
  built.data.x = x;
  built.data.y = y;
  built.data.tolerance = options.tolerance;
  auto& boxes = built.data.boxes;
  auto& report = built.data.report;
  const auto scope = surrogate_scope(scene, x, y);
  built.data.kind = scope.kind;
  built.data.even_phase = scope.even_phase;
  const Sampling sampling = [&](const auto& points, auto& result) {
    return source.nodes(parameter_values(x, y, points), result);
  };
  SurrogateBox whole;
  for (const auto& [axis, index] : {std::pair{x, std::size_t{0}}, std::pair{y, std::size_t{1}}}) {
    const double from = Surrogate::coordinate(axis, axis.from), to = Surrogate::coordinate(axis, axis.to);
    whole.low[index] = std::min(from, to);
    whole.high[index] = std::max(from, to);
  }
  const std::array<double, 2> rounding{coordinate_error(x, whole.low[0], whole.high[0]),
                                       coordinate_error(y, whole.low[1], whole.high[1])};
  const double budget = kShareOfCells * cells_in(whole, whole, x, y);
  std::mt19937_64 random(1928);  // one seed, so that the same chart is checked at the same points
  std::deque<Pending> pending{{whole, 0}};
  while (!pending.empty()) {
    auto [box, depth] = std::move(pending.front());
    pending.pop_front();
    const double affordable =
        std::min(cells_in(box, whole, x, y), budget - static_cast<double>(report.nodes));
    const auto build = build_box(box, scope.kind, sampling, rounding, options.tolerance, affordable);
    report.nodes += build.nodes;
    report.right_hand_sides += build.right_hand_sides;
    built.cancelled = build.outcome == BoxOutcome::cancelled;
    if (box.interpolated) built.cancelled = !check(box, x, y, source.referee, random, report);
    if (built.cancelled) return built;
    const bool split = build.outcome == BoxOutcome::split_x || build.outcome == BoxOutcome::split_y;
    if (split && depth < kDeepest && boxes.size() + pending.size() < kMostBoxes) {
      for (auto& half : halves(box, build.outcome == BoxOutcome::split_x ? 0 : 1))
        pending.push_back({std::move(half), depth + 1});
      continue;
    }
    if (box.interpolated) {
      ++report.boxes;
      const auto degree = std::max(box.coefficients[0].rows(), box.coefficients[0].cols()) - 1;
      report.highest_degree = std::max(report.highest_degree, static_cast<int>(degree));
    } else if (build.outcome != BoxOutcome::interpolated) {
      ++report.boxes_left_out;
    }
    boxes.push_back(std::move(box));
  }
  return built;
}

}  // namespace strutt
