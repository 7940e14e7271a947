#include "integrate/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace strutt::detail {
namespace {

/// So close that SUNDIALS does not start between them; it multiplies such differences, too, which must not
/// underflow.
bool indistinguishable(double a, double b) {
  constexpr double kClose = 4.0 * std::numeric_limits<double>::epsilon();
  constexpr double kTiny = 1e-150;
  return std::abs(b - a) <= kTiny || std::abs(b - a) <= kClose * std::max(std::abs(a), std::abs(b));
}

}  // namespace

Budget::Budget(const IntegratorOptions& options)
    : options_(options), timed_(std::isfinite(options.max_seconds)) {
  if (timed_) begin_ = Clock::now();
}

Outcome Budget::spend_step() {
  if (options_.cancel && options_.cancel->load(std::memory_order_relaxed)) return Outcome::cancelled;
  if (timed_ && std::chrono::duration<double>(Clock::now() - begin_).count() >= options_.max_seconds)
    return Outcome::time_limit;
  if (steps_ >= options_.max_steps) return Outcome::step_limit;
  ++steps_;
  return Outcome::converged;
}

Run::Run(Stepper& stepper, EventLocator& locator, const IntegratorOptions& options,
         const EventRequest* events, double t0, StateView state0)
    : stepper_(stepper),
      locator_(locator),
      options_(options),
      events_(events),
      budget_(options),
      state_(state0) {
  result_.t = t0;
  stepper_.watch(events);
}

bool Run::cross(const RightHandSide& f, double t1) {
  while (recorder_.pending() && indistinguishable(recorder_.time(), result_.t))
    recorder_.take_column() = state_;
  if (result_.t == t1) return going();
  if (indistinguishable(result_.t, t1)) {
    hop(f, t1);
    return going();
  }
  forwards_ = t1 > result_.t;
  const double first_step = forwards_ ? options_.first_step : -options_.first_step;
  stepper_.start(f, result_.t, state_, next_stop(t1), first_step);
  while (going() && result_.t != t1) step(f, t1);
  if (!terminated_) state_ = stepper_.state();
  result_.cost += stepper_.cost();
  result_.cost.right_hand_sides += locator_.take_right_hand_sides();
  return going();
}

/// Some units in the last place: Euler's step is exact to rounding.
void Run::hop(const RightHandSide& f, double t1) {
  Eigen::VectorXd derivative(state_.size());
  f(result_.t, state_, derivative);
  ++result_.cost.right_hand_sides;
  if (!all_finite(derivative)) {
    result_.outcome = Outcome::non_finite;
    return;
  }
  state_ += (t1 - result_.t) * derivative;
  result_.t = t1;
  ++result_.cost.steps;
}

void Run::step(const RightHandSide& f, double t1) {
  result_.outcome = budget_.spend_step();
  if (result_.outcome != Outcome::converged) return;
  result_.outcome = stepper_.step();
  if (result_.outcome != Outcome::converged) return;
  result_.t = stepper_.t();
  if (!stepper_.roots().empty()) take_events(f);
  record();
  if (going() && stepper_.at_stop() && result_.t != t1) stepper_.set_stop(next_stop(t1));
}

void Run::take_events(const RightHandSide& f) {
  std::vector<Event> found = locator_.locate(f, *events_);
  if (events_->terminal) {
    found.resize(1);
    terminated_ = true;
    result_.t = found.front().t;
    state_ = found.front().state;
  }
  std::move(found.begin(), found.end(), std::back_inserter(result_.events));
}

/// Everything asked for up to the end of the step.
void Run::record() {
  const auto passed = [this](double time) { return forwards_ ? time <= result_.t : time >= result_.t; };
  while (recorder_.pending() && passed(recorder_.time())) {
    const double time = recorder_.time();
    if (time != result_.t)
      stepper_.interpolate(time, recorder_.take_column());
    else if (terminated_)
      recorder_.take_column() = state_;
    else
      recorder_.take_column() = stepper_.state();
  }
}

/// ARKODE has no interpolant as accurate as its steps (at most degree 5) and must stop wherever a state is
/// wanted.
double Run::next_stop(double t1) const {
  if (options_.backend != Backend::arkode_erk || !recorder_.pending()) return t1;
  return forwards_ ? std::min(recorder_.time(), t1) : std::max(recorder_.time(), t1);
}

}  // namespace strutt::detail
