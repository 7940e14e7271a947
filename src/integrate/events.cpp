#include "integrate/events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/bracketed_zero.hpp"

namespace strutt::detail {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// An interval around a guess, inside the step, at whose ends the function has the signs the crossing needs.
struct Bracket {
  double low, high;
  double at_low, at_high;
};

/// Widens an interval around `guess` until the function rises through zero in it; empty if it does not in the
/// whole step. A zero at its very start is not meant: it belongs to the step before or is where the run
/// began.
template <typename Function>
std::optional<Bracket> bracket(const Function& rises, double start, double guess, double end) {
  for (double share = 1e-3;; share *= 10.0) {
    const double width = share * (end - start);
    const bool whole = share >= 1.0;
    // Within the step whatever its direction; both differences have the sign of the step.
    const double low = whole || (guess - start) / width <= 1.0 ? start : guess - width;
    const double high = whole || (end - guess) / width <= 1.0 ? end : guess + width;
    const Bracket found{low, high, rises(low), rises(high)};
    const bool begins = found.at_low < 0.0 || (found.at_low == 0.0 && low != start);
    if (begins && found.at_high >= 0.0 && found.at_low != found.at_high) return found;
    if (whole) return std::nullopt;
  }
}

/// The zero of `rises` in the bracket, to rounding.
template <typename Function>
double zero(const Function& rises, const Bracket& bracket, double step) {
  if (bracket.at_low == 0.0) return bracket.low;
  if (bracket.at_high == 0.0) return bracket.high;
  const auto close = [step](double a, double b) {
    return std::abs(b - a) <= 2.0 * kEpsilon * std::max(std::abs(b), std::abs(step));
  };
  constexpr int kMostEvaluations = 60;
  // Ascending ends, as toms748 wants them.
  const bool forwards = bracket.low < bracket.high;
  return bracketed_zero(rises, forwards ? bracket.low : bracket.high, forwards ? bracket.high : bracket.low,
                        forwards ? bracket.at_low : bracket.at_high,
                        forwards ? bracket.at_high : bracket.at_low, close, kMostEvaluations)
      .middle();
}

}  // namespace

void EventLocator::configure(const IntegratorOptions& options) {
  options_ = options;
  if (refiner_) refiner_->configure(options);
}

long EventLocator::take_right_hand_sides() { return std::exchange(right_hand_sides_, 0); }

std::vector<Event> EventLocator::locate(const RightHandSide& f, const EventRequest& request) {
  std::vector<Event> events;
  for (const Root& root : stepper_.roots()) {
    const bool accurate = options_.backend != Backend::arkode_erk;
    events.push_back(accurate ? Event{root.index, root.t, root.state} : refine(f, request, root));
  }
  const bool forwards = stepper_.t() >= stepper_.step_start();
  std::stable_sort(events.begin(), events.end(),
                   [forwards](const Event& a, const Event& b) { return forwards ? a.t < b.t : a.t > b.t; });
  return events;
}

Event EventLocator::refine(const RightHandSide& f, const EventRequest& request, const Root& root) {
  values_.resize(static_cast<Eigen::Index>(request.crossings.size()));
  const auto rises = [&](double t) {
    request.function(t, state_at(f, t), values_);
    return root.rising ? values_[root.index] : -values_[root.index];
  };
  const double start = stepper_.step_start();
  const double end = stepper_.t();
  const std::optional<Bracket> found = bracket(rises, start, root.t, end);
  if (!found) return {root.index, root.t, root.state};
  const double t = zero(rises, *found, end - start);
  return {root.index, t, state_at(f, t)};
}

/// The step was accepted, so that the part of it up to t is one accepted step, too: of the accuracy of all
/// others.
const Eigen::VectorXd& EventLocator::state_at(const RightHandSide& f, double t) {
  const double start = stepper_.step_start();
  if (t == stepper_.t()) return state_ = stepper_.state();
  state_ = stepper_.start_state();
  if (std::abs(t - start) < 4.0 * kEpsilon * std::max(std::abs(t), std::abs(start))) return state_;
  if (!refiner_) refiner_ = stepper_.sibling(options_);
  refiner_->start(f, start, stepper_.start_state(), t, t - start);
  while (!refiner_->at_stop() && refiner_->step() == Outcome::converged) continue;
  right_hand_sides_ += refiner_->cost().right_hand_sides;
  if (refiner_->at_stop()) return state_ = refiner_->state();
  return state_.setConstant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace strutt::detail
