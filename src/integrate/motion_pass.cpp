#include "integrate/motion_pass.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"

namespace strutt::detail {
namespace {

// How much the difference of the two runs is trusted. The reference tests hold the bound above the true
// error.
constexpr double kSafety = 4.0;
// Rounding, in units of 2^-53. Of the largest state of a segment: once, and a step. Of the restoring force, a
// radian: between the inputs and the coefficients (alpha^2: 6, frequency^2: 1, harmonics: 4), value of W and
// sine, phase.
constexpr double kPassRounding = 3.0;
constexpr double kRoundingPerStep = 1.5;
constexpr double kRoundingPerRadian = 16.0;

// The run that checks ARKODE's order 8: a formula of lower order at the same tolerance, whose error is larger
// even where both take the same steps. CVODE is checked by order 8, which is far more accurate at the same
// tolerance.
constexpr int kMainOrder = 8;
constexpr int kCheckOrder = 6;

// Errors of this size, rad, are beyond the linear theory they are computed by.
constexpr double kLinearLimit = 0.25;

// The least part of a segment that is integrated; over less, Euler's step is exact to rounding.
constexpr double kNoStep = 1e-12;

// The shares of a segment that one step of the two runs may take at most, and so the steps a segment costs at
// least.
constexpr double kMainSteps = 3.0;
constexpr double kCheckSteps = 2.0;

// Keeps tolerances of a state that is exactly 0 positive.
constexpr double kSmallestState = 1e-200;

Backend backend_of(Method method) {
  return method == Method::cvode ? Backend::cvode_adams : Backend::arkode_erk;
}

}  // namespace

MotionPass::MotionPass(const MotionEquation& equation, const MotionOptions& options, double alpha,
                       double local_tolerance)
    : equation_(equation),
      options_(options),
      alpha_(alpha),
      tolerance_(local_tolerance),
      main_(2, {.backend = backend_of(options.method), .order = kMainOrder}),
      check_(6, {.backend = Backend::arkode_erk,
                 .order = options.method == Method::cvode ? kMainOrder : kCheckOrder}) {}

bool MotionPass::within_reach(const Segment& segment, double t) const {
  const double segments = equation_.segments_in(equation_.offset(segment, equation_.phase(t)));
  return (kMainSteps + kCheckSteps) * segments <= static_cast<double>(steps_left());
}

Outcome MotionPass::run(const MotionStart& start, const std::vector<std::size_t>& order,
                        std::vector<MotionPoint>& points, long max_steps) {
  max_steps_ = max_steps;
  const double fixed = options_.about == Equilibrium::inverted ? 1.0 : 0.0;
  const SplitAngle angle = options_.linear ? split_angle(start.angle, fixed) : split_angle(start.angle);
  half_turns_ = angle.half_turns;
  state_ << angle.rest, start.velocity / (equation_.kappa() * equation_.frequency());
  errors_ = ErrorBox(4.0 * kUnit * state_.cwiseAbs());

  Segment segment = equation_.first_segment();
  std::size_t next = 0;
  while (next < order.size()) {
    std::vector<double> offsets;
    std::vector<MotionPoint*> targets;
    for (; next < order.size(); ++next) {
      MotionPoint& point = points[order[next]];
      const double offset = equation_.offset(segment, equation_.phase(point.t));
      if (!(offset <= segment.length)) break;
      // Rounding must not let a later time come first.
      offsets.push_back(std::max(offset, offsets.empty() ? 0.0 : offsets.back()));
      targets.push_back(&point);
    }
    const Outcome outcome = cross(segment, offsets, targets);
    if (outcome != Outcome::converged) return outcome;
    if (next < order.size() && !within_reach(segment, points[order[next]].t)) return Outcome::step_limit;
    segment = equation_.next(segment);
  }
  return Outcome::converged;
}

Trajectory MotionPass::integrate(Integrator& integrator, const Segment& segment, const Eigen::VectorXd& state,
                                 const std::vector<double>& offsets, double size, bool is_check) {
  IntegratorOptions options = integrator.options();
  options.relative_tolerance = tolerance_;
  options.absolute_tolerance = options.relative_tolerance * size;
  // Never over a whole wave of the coefficients at once.
  options.max_step =
      std::min(segment.length / (is_check ? kCheckSteps : kMainSteps), 6.0 / equation_.highest_order());
  options.max_steps = std::max(steps_left(), 1L);
  options.cancel = options_.cancel;
  integrator.set_options(options);
  const double half_turns = half_turns_;
  return integrator.trajectory(
      [&, half_turns](double offset, double, StateView y, StateOut dydt) {
        equation_.derivative(segment, half_turns, offset, y, dydt);
      },
      0.0, state, offsets);
}

double MotionPass::rounding(const Segment& segment, double size, long steps) const {
  const double force = equation_.linear() ? size : std::max(std::min(size, 1.0), gained(segment));
  return kUnit * (size * (kPassRounding + kRoundingPerStep * static_cast<double>(steps)) +
                  force * kRoundingPerRadian * equation_.radians(segment));
}

/// What the linear theory leaves out: |W| e^2/2 an interval, for errors of at most e in this segment.
double MotionPass::remainder(const Segment& segment, const Eigen::Matrix2d& propagator, double added) const {
  if (equation_.linear()) return 0.0;
  const double before = errors_.bound(Eigen::Matrix2d::Identity())[0];
  const double after = errors_.bound(propagator)[0] + added;
  const double error = 2.0 * std::max(before, after);
  if (!(error < kLinearLimit)) return kInfinity;
  const double rate = equation_.coefficient_bound() / equation_.kappa();
  return rate * segment.length * std::max(1.0, propagator.norm()) * error * error / 2.0;
}

/// One segment: both runs from the same state, the values asked for in it, and the error carried to its end.
Outcome MotionPass::cross(const Segment& segment, const std::vector<double>& offsets,
                          const std::vector<MotionPoint*>& targets) {
  if (steps_left() <= 0) return Outcome::step_limit;
  rebase();
  const double size = std::max({state_.cwiseAbs().maxCoeff(), gained(segment), kSmallestState});
  // Times that a step cannot be made to are where the segment begins.
  std::size_t early = 0;
  for (; early < offsets.size() && offsets[early] < kNoStep * segment.length; ++early) {
    const Eigen::Vector2d moved = state_ + offsets[early] * slope(segment);
    record(*targets[early], half_turns_, moved,
           errors_.bound(Eigen::Matrix2d::Identity())[0] + rounding(segment, size, 0));
  }
  std::vector<double> times(offsets.begin() + static_cast<std::ptrdiff_t>(early), offsets.end());
  times.push_back(segment.length);
  const Trajectory values = integrate(main_, segment, state_, times, size, false);
  cost_ += values.result.cost;
  // The variational columns are scaled like the state, since there is one absolute tolerance.
  Eigen::VectorXd extended(6);
  extended << state_, size, 0.0, 0.0, size;
  const Trajectory check = integrate(check_, segment, extended, times, size, true);
  estimate_cost_ += check.result.cost;

  double difference = 0.0, largest = size;
  for (std::size_t j = 0; j < times.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    const Eigen::Vector2d state = values.states.col(column);
    const Eigen::Matrix2d propagator = check.states.col(column).tail<4>().reshaped(2, 2) / size;
    if (!state.allFinite() || !propagator.allFinite()) break;
    difference = std::max(difference, (state - check.states.col(column).head<2>()).cwiseAbs().maxCoeff());
    largest = std::max(largest, state.cwiseAbs().maxCoeff());
    double added = kSafety * difference + rounding(segment, largest, values.result.cost.steps);
    added += remainder(segment, propagator, added);
    if (early + j < targets.size()) {
      record(*targets[early + j], half_turns_, state, errors_.bound(propagator)[0] + added);
    } else {
      state_ = state;
      errors_.advance(propagator, added);
    }
  }
  if (values.result.outcome != Outcome::converged) return values.result.outcome;
  return check.result.outcome;
}

/// The derivative of the state at the beginning of the segment.
Eigen::Vector2d MotionPass::slope(const Segment& segment) const {
  Eigen::VectorXd result(2);
  equation_.derivative(segment, half_turns_, 0.0, state_, result);
  return result;
}

/// Moves to the nearest multiple of pi; some overlap keeps a swing about pi/2 from changing it all the time.
void MotionPass::rebase() {
  constexpr double kFar = 2.0;
  if (equation_.linear() || !(std::abs(state_[0]) > kFar)) return;
  const SplitAngle moved = split_angle(state_[0]);
  half_turns_ += moved.half_turns;
  state_[0] = moved.rest;
}

void MotionPass::record(MotionPoint& point, double half_turns, const Eigen::Vector2d& state,
                        double error) const {
  MotionPoint found = point;
  found.angle = joined({half_turns, state[0]});
  found.error = error + kUnit * std::abs(found.angle);
  if (std::isnan(found.error)) found.error = kInfinity;
  if (!(found.error < point.error) && !std::isnan(point.angle)) return;
  found.velocity = state[1] * equation_.kappa() * equation_.frequency();
  const double rate = found.velocity / alpha_;
  const bool hanging = std::fmod(half_turns, 2.0) == 0.0;
  const double twice_cosine = 2.0 * (hanging ? std::cos(state[0] / 2.0) : std::sin(state[0] / 2.0));
  found.energy = (rate - twice_cosine) * (rate + twice_cosine);
  found.outcome = found.error <= options_.tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
  point = found;
}

}  // namespace strutt::detail
