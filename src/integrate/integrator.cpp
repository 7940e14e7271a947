#include "strutt/integrate/integrator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "integrate/run.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

// Below this, the rounding of a step is as large as the error it may have.
constexpr double kSmallestRelativeTolerance = 1e-15;
constexpr std::array kOrders{2, 3, 4, 5, 6, 8};

void require_valid(const EventRequest* events) {
  if (!events) return;
  if (!events->function) throw InvalidInput("EventRequest::function", "empty", "a function");
  if (events->crossings.empty())
    throw InvalidInput("EventRequest::crossings", "empty", "one per event function");
}

void require_size(Eigen::Index size, int dimension) {
  require(size == dimension, "size of the state", static_cast<double>(size),
          "the dimension of the integrator, " + std::to_string(dimension));
}

/// Throws unless the times run one way, from t0 on.
void require_monotonic(double t0, std::span<const double> times) {
  const bool forwards = times.back() >= t0;
  double last = t0;
  for (const double time : times) {
    const bool behind = forwards ? time < last : time > last;
    require(!behind, "times", time, "monotonic, from t0 on");
    last = time;
  }
}

/// The ends of the smooth pieces of a run from t0 to t1, t1 being the last of them.
std::vector<double> piece_ends(double t0, double t1, std::span<const double> breakpoints) {
  if (!std::is_sorted(breakpoints.begin(), breakpoints.end())) throw InvalidInput("breakpoints must ascend");
  std::vector<double> ends;
  for (const double breakpoint : breakpoints)
    if (std::min(t0, t1) < breakpoint && breakpoint < std::max(t0, t1)) ends.push_back(breakpoint);
  if (t1 < t0) std::reverse(ends.begin(), ends.end());
  ends.push_back(t1);
  return ends;
}

}  // namespace

void IntegratorOptions::validate() const {
  if (backend == Backend::arkode_erk)
    require(std::find(kOrders.begin(), kOrders.end(), order) != kOrders.end(), "order", order,
            "2, 3, 4, 5, 6 or 8");
  require(relative_tolerance > 0.0 && std::isfinite(relative_tolerance), "relative_tolerance",
          relative_tolerance, "positive, finite");
  require(absolute_tolerance >= 0.0 && std::isfinite(absolute_tolerance), "absolute_tolerance",
          absolute_tolerance, "not negative, finite");
  require(max_step > 0.0, "max_step", max_step, "positive");
  require(first_step >= 0.0 && std::isfinite(first_step), "first_step", first_step, "not negative, finite");
  require(max_steps >= 1, "max_steps", static_cast<double>(max_steps), "at least 1");
  require(max_seconds >= 0.0, "max_seconds", max_seconds, "not negative");
}

IntegrationCost& IntegrationCost::operator+=(const IntegrationCost& other) {
  steps += other.steps;
  rejections += other.rejections;
  right_hand_sides += other.right_hand_sides;
  return *this;
}

struct Integrator::Implementation {
  Implementation(int dimension_, const IntegratorOptions& options_)
      : dimension(dimension_), options(options_), stepper(dimension_, options_), locator(stepper, options_) {}

  /// What keeps a run from being tried; `converged`: nothing.
  Outcome obstacle(double t0, double t1, StateView state) const {
    if (!std::isfinite(t0) || !std::isfinite(t1) || !detail::all_finite(state)) return Outcome::non_finite;
    if (options.relative_tolerance < kSmallestRelativeTolerance) return Outcome::tolerance_not_reached;
    return Outcome::converged;
  }

  int dimension;
  IntegratorOptions options;
  detail::Stepper stepper;
  detail::EventLocator locator;
};

Integrator::Integrator(int dimension, const IntegratorOptions& options) {
  require(dimension >= 1, "dimension", dimension, "at least 1");
  options.validate();
  implementation_ = std::make_unique<Implementation>(dimension, options);
}

Integrator::~Integrator() = default;
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator& Integrator::operator=(Integrator&&) noexcept = default;

void Integrator::set_options(const IntegratorOptions& options) {
  options.validate();
  const IntegratorOptions& present = implementation_->options;
  if (options.backend != present.backend)
    throw InvalidInput("the backend of an integrator cannot be changed");
  if (options.backend == Backend::arkode_erk)
    require(options.order == present.order, "order", options.order,
            "that of the integrator, " + std::to_string(present.order));
  implementation_->options = options;
  implementation_->stepper.configure(options);
  implementation_->locator.configure(options);
}

const IntegratorOptions& Integrator::options() const { return implementation_->options; }

IntegrationResult Integrator::advance(const RightHandSide& f, double t0, double t1,
                                      Eigen::Ref<Eigen::VectorXd> state, const EventRequest* events) {
  auto& [dimension, options, stepper, locator] = *implementation_;
  require_size(state.size(), dimension);
  require_valid(events);
  if (const Outcome obstacle = implementation_->obstacle(t0, t1, state); obstacle != Outcome::converged) {
    IntegrationResult result;
    result.outcome = obstacle;
    result.t = t0;
    return result;
  }
  detail::Run run(stepper, locator, options, events, t0, state);
  run.cross(f, t1);
  state = run.state();
  return run.take_result();
}

Trajectory Integrator::trajectory(const PiecewiseRightHandSide& f, double t0, StateView state0,
                                  std::span<const double> times, std::span<const double> breakpoints,
                                  const EventRequest* events) {
  auto& [dimension, options, stepper, locator] = *implementation_;
  require_size(state0.size(), dimension);
  require_valid(events);
  Trajectory trajectory;
  trajectory.result.t = t0;
  trajectory.states.setConstant(dimension, static_cast<Eigen::Index>(times.size()),
                                std::numeric_limits<double>::quiet_NaN());
  if (times.empty()) return trajectory;
  const bool finite_times =
      std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t); });
  trajectory.result.outcome =
      finite_times ? implementation_->obstacle(t0, times.back(), state0) : Outcome::non_finite;
  if (trajectory.result.outcome != Outcome::converged) return trajectory;
  require_monotonic(t0, times);

  detail::Run run(stepper, locator, options, events, t0, state0);
  run.set_recorder({times, trajectory.states});
  double begin = t0;
  for (const double end : piece_ends(t0, times.back(), breakpoints)) {
    const double interior = 0.5 * (begin + end);
    const auto smooth = [&f, interior](double t, StateView y, StateOut dydt) { f(t, interior, y, dydt); };
    if (!run.cross(smooth, end)) break;
    begin = end;
  }
  trajectory.result = run.take_result();
  return trajectory;
}

IntegrationResult integrate(const RightHandSide& f, double t0, double t1, Eigen::Ref<Eigen::VectorXd> state,
                            const IntegratorOptions& options, const EventRequest* events) {
  return Integrator(static_cast<int>(state.size()), options).advance(f, t0, t1, state, events);
}

}  // namespace strutt
