#include "strutt/chart/surrogate.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <random>

#include "chart/factor_error.hpp"
#include "chart/half_period_nodes.hpp"
#include "chart/product_table.hpp"
#include "chart/surrogate_box.hpp"
#include "floquet/assembly.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;
// Of the tolerance, for the engine: the errors at the nodes that have the largest factors count where they
// are small too.
constexpr double kNodeShare = 1e-6, kCheckShare = 1e-4;
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

/// The engine at scattered points, one model per thread.
class Referee {
 public:
  Referee(const Scene& scene, const Axis& x, const Axis& y, double even_phase,
          const SurrogateOptions& options)
      : parallel_{.threads = options.threads, .cancel = options.cancel},
        tolerance_(std::max(kCheckShare * options.tolerance, kLowestTolerance)) {
    for (int slot = 0; slot < thread_count(parallel_); ++slot)
      models_.push_back(std::make_unique<HalfPeriodModel>(scene, x, y, even_phase));
  }

  /// At parameter values. False: cancelled.
  bool sample(const std::vector<std::array<double, 2>>& values, std::vector<HalfPeriodSample>& result) {
    result.resize(values.size());
    const bool complete = parallel_for(values.size(), parallel_, [&](std::size_t i, int slot) {
      result[i] = models_[static_cast<std::size_t>(slot)]->sample(values[i][0], values[i][1], tolerance_,
                                                                  parallel_.cancel);
    });
    return complete && !(parallel_.cancel != nullptr && parallel_.cancel->load());
  }

 private:
  ParallelOptions parallel_;
  double tolerance_;
  std::vector<std::unique_ptr<HalfPeriodModel>> models_;
};

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

/// Largest |surrogate - engine| over the factors at a point, in units of the sum of both bounds.
double disagreement(const SurrogateBox& box, const std::array<double, 2>& at,
                    const HalfPeriodSample& engine) {
  if (!engine.valid) return std::numeric_limits<double>::infinity();
  const auto value = evaluate(box, at[0], at[1]);
  const auto shift = static_cast<int>(std::clamp(engine.exponent - box.exponent, -2000L, 2000L));
  const std::array<double, 4> units{1.0, box.kappa, 1.0 / box.kappa, 1.0};
  double largest = 0.0;
  for (std::size_t f = 0; f < 4; ++f) {
    const double difference = std::abs(value[f] - std::ldexp(engine.value[f] * units[f], shift));
    largest = std::max(largest, difference / (box.error[f] + std::ldexp(engine.error[f] * units[f], shift)));
  }
  return largest;
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
bool check(SurrogateBox& box, const Axis& x, const Axis& y, Referee& referee, std::mt19937_64& random,
           SurrogateReport& report) {
  const auto points = scattered(box, random);
  std::vector<HalfPeriodSample> engine;
  if (!referee.sample(parameter_values(x, y, points), engine)) return false;
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

double Surrogate::coordinate(const Axis& axis, double value) {
  return axis.scale == AxisScale::linear ? value : std::log(std::abs(value));
}

std::string Surrogate::refusal(const Scene& scene, const Axis& x, const Axis& y) {
  if (x.points < 2 || y.points < 2) return "an axis has only one point";
  const auto even = even_point(scene, x, y);
  if (!even.reason.empty()) return even.reason;
  HalfPeriodModel model(scene, x, y, even.phase);
  const Axis few_x{x.parameter, x.from, x.to, 2, x.scale}, few_y{y.parameter, y.from, y.to, 2, y.scale};
  for (const auto property : {&CentredEquation::half_damping, &CentredEquation::kappa_square}) {
    const auto value = [&](double px, double py) {
      const auto point = model.at(px, py);
      return point ? (*point).*property : std::numeric_limits<double>::quiet_NaN();
    };
    if (!ProductTable::of(value, few_x, few_y))
      return "damping or mean of the coefficient is not a product of functions of the two parameters";
  }
  return "";
}

Surrogate::Surrogate(const Scene& scene, const Axis& x, const Axis& y, const SurrogateOptions& options)
    : scene_(scene), x_(x), y_(y), options_(options) {
  x.validate("x");
  y.validate("y");
  MonodromyOptions{.tolerance = options.tolerance}.validate();
  if (const auto reason = refusal(scene, x, y); !reason.empty())
    throw InvalidInput("no surrogate over " + x.parameter + " and " + y.parameter + ": " + reason);
  even_phase_ = even_point(scene, x, y).phase;

  HalfPeriodNodes nodes(scene, x, y, even_phase_, {.threads = options.threads, .cancel = options.cancel});
  Referee referee(scene, x, y, even_phase_, options);
  const double node_tolerance = std::max(kNodeShare * options.tolerance, kLowestNodeTolerance);
  const Sampling sampling = [&](const auto& points, auto& result) {
    return nodes.sample(parameter_values(x, y, points), node_tolerance, result);
  };
  SurrogateBox whole;
  for (const auto& [axis, index] : {std::pair{x, std::size_t{0}}, std::pair{y, std::size_t{1}}}) {
    const double from = coordinate(axis, axis.from), to = coordinate(axis, axis.to);
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
        std::min(cells_in(box, whole, x, y), budget - static_cast<double>(report_.nodes));
    const auto build = build_box(box, sampling, rounding, options.tolerance, affordable);
    report_.nodes += build.nodes;
    report_.right_hand_sides += build.right_hand_sides;
    cancelled_ = build.outcome == BoxOutcome::cancelled;
    if (box.interpolated) cancelled_ = !check(box, x, y, referee, random, report_);
    if (cancelled_) return;
    const bool split = build.outcome == BoxOutcome::split_x || build.outcome == BoxOutcome::split_y;
    if (split && depth < kDeepest && boxes_.size() + pending.size() < kMostBoxes) {
      for (auto& half : halves(box, build.outcome == BoxOutcome::split_x ? 0 : 1))
        pending.push_back({std::move(half), depth + 1});
      continue;
    }
    if (box.interpolated) {
      ++report_.boxes;
      const auto degree = std::max(box.coefficients[0].rows(), box.coefficients[0].cols()) - 1;
      report_.highest_degree = std::max(report_.highest_degree, static_cast<int>(degree));
    } else if (build.outcome != BoxOutcome::interpolated) {
      ++report_.boxes_left_out;
    }
    boxes_.push_back(std::move(box));
  }
}

std::optional<Monodromy> Surrogate::monodromy(double x, double y) const {
  const double at_x = coordinate(x_, x), at_y = coordinate(y_, y);
  const auto found = std::find_if(boxes_.begin(), boxes_.end(), [&](const SurrogateBox& box) {
    return at_x >= box.low[0] && at_x <= box.high[0] && at_y >= box.low[1] && at_y <= box.high[1];
  });
  if (found == boxes_.end() || !found->interpolated) return std::nullopt;
  const auto point = HalfPeriodModel(scene_, x_, y_, even_phase_).at(x, y);
  if (!point) return std::nullopt;
  const auto factors = at_kappa(evaluate(*found, at_x, at_y), found->error, point->kappa / found->kappa);
  const auto matrix = [](const std::array<double, 4>& f) {
    return Eigen::MatrixXd{{f[0], f[1]}, {f[2], f[3]}};
  };
  BoundedMatrix half{{matrix(factors.value), found->exponent}, matrix(factors.error)};
  half.normalise();

  const double h = point->half_damping;
  const FactorScale scale(found->exponent, h, point->kappa, point->shifted);
  Monodromy result;
  result.undamped = period_from_half({half}, 0);
  result.matrix = restore_damping(result.undamped, h, scale.slope);
  result.half = std::move(half);
  result.half_damping = h;
  result.kappa = point->kappa;
  result.error = scaled_error(result.matrix);
  result.method = Method::surrogate;
  result.outcome = result.error <= options_.tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
  return result;
}

}  // namespace strutt
