#include <algorithm>

#include "floquet/assembly.hpp"
#include "floquet/undamped_system.hpp"
#include "strutt/integrate/taylor_propagator.hpp"

namespace strutt {
namespace {

constexpr int kStepsTogether = 64;  // multiplied at once, so that long phases do not need much memory

/// The propagators of groups of steps.
Propagators<Eigen::MatrixXd> propagated(const TaylorEquation& equation, const TaylorStepPlan& plan,
                                        int half_periods, const MonodromyOptions& options) {
  Propagators<Eigen::MatrixXd> result;
  TaylorPropagator propagator(equation, plan, half_periods);
  for (int first = 0; first < plan.steps; first += kStepsTogether) {
    if (options.cancel != nullptr && options.cancel->load()) {
      result.outcome = Outcome::cancelled;
      break;
    }
    const int last = std::min(first + kStepsTogether, plan.steps);
    result.factors.push_back(propagator.propagate(first, last, options.estimate_error));
  }
  result.cost.steps = plan.steps;
  result.cost.right_hand_sides = plan.steps * propagator.products_per_step();
  return result;
}

}  // namespace

Monodromy taylor_monodromy(const UndampedSystem& y, const MonodromyOptions& options) {
  const int half_periods = y.even_symmetric ? 1 : 2;
  const TaylorEquation equation{y.damping, y.stiffness, y.coefficient_error * y.rate};
  return tighten(taylor_ladder(options), options.tolerance, [&](double local_tolerance) {
    const auto plan = plan_taylor_steps(equation, half_periods, local_tolerance);
    if (plan.steps == 0) return without_result<Eigen::MatrixXd>(Method::propagator, Outcome::step_limit);
    const auto found = propagated(equation, plan, half_periods, options);
    if (found.outcome != Outcome::converged)
      return without_result<Eigen::MatrixXd>(Method::propagator, found.outcome);
    return y.assembled(found, y.even_symmetric);
  });
}

}  // namespace strutt
