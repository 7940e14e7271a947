#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "floquet/series_propagators.hpp"
#include "strutt/floquet/monodromy.hpp"
#include "strutt/integrate/linear_propagator.hpp"

namespace strutt {

/// What computes propagators, kept from one equation to the next.
struct PropagatorPool {
  SeriesPropagators series;
  std::map<std::pair<int, Backend>, LinearPropagator> integrators;

  LinearPropagator& integrator(int states, Method method) {
    const Backend backend = method == Method::cvode ? Backend::cvode_adams : Backend::arkode_erk;
    return integrators.try_emplace({states, backend}, states, backend).first->second;
  }
};

/// By Method::exact, arkode or cvode.
HillMonodromy hill_monodromy(PropagatorPool& pool, const HillEquation& equation, Method method,
                             const MonodromyOptions& options);
/// By Method::propagator, all at once.
std::vector<HillMonodromy> series_monodromies(SeriesPropagators& tables,
                                              std::span<const HillEquation* const> equations,
                                              const MonodromyOptions& options);
Monodromy system_monodromy(PropagatorPool& pool, const LinearPeriodicSystem& system, Method method,
                           const MonodromyOptions& options);

/// Propagators of consecutive segments, and how their integration went.
template <typename Matrix>
struct Propagators {
  std::vector<BasicBoundedMatrix<Matrix>> factors;  // with the bounds of their rounding
  std::vector<BasicBoundedMatrix<Matrix>>
      checks;  // the same from the second runs, without bounds; empty where no second runs are needed
  Outcome outcome = Outcome::converged;
  IntegrationCost cost, estimate_cost;

  void append(Propagation&& step) {
    if (outcome == Outcome::converged) outcome = step.outcome;
    cost += step.cost;
    estimate_cost += step.estimate_cost;
    factors.push_back(
        {{std::move(step.matrix.value.mantissa), step.matrix.value.exponent}, std::move(step.matrix.error)});
    checks.push_back({.value = {std::move(step.check.mantissa), step.check.exponent}});
  }
};

/// `highest_order`: of the harmonics of the equation.
PropagatorOptions propagator_options(const MonodromyOptions& options, double local_tolerance,
                                     int highest_order);

/// The result of putting the factors together, with the truncation that the second runs, put together the
/// same way, show.
template <typename Matrix, typename PutTogether>
BasicMonodromy<Matrix> combined(const Propagators<Matrix>& propagators, const PutTogether& put_together) {
  BasicMonodromy<Matrix> result = put_together(propagators.factors);
  result.cost = propagators.cost;
  result.estimate_cost = propagators.estimate_cost;
  result.outcome = propagators.outcome;
  if (!propagators.checks.empty()) {
    const BasicMonodromy<Matrix> check = put_together(propagators.checks);
    add_truncation(result.matrix, check.matrix.value);
    add_truncation(result.undamped, check.undamped.value);
    if (result.half) add_truncation(*result.half, check.half->value);
  }
  return result;
}

/// Local tolerances: where to begin, and below what not to go.
struct ToleranceLadder {
  double first, lowest;
};
ToleranceLadder sundials_ladder(const MonodromyOptions& options);  // of a step
ToleranceLadder series_ladder(const MonodromyOptions& options);    // of a piece
ToleranceLadder taylor_ladder(const MonodromyOptions& options);    // of the period
inline constexpr double kLadderStep = 0.01;

/// How `result` ended, now that nothing tighter is tried.
template <typename Matrix>
void settle(BasicMonodromy<Matrix>& result, double tolerance) {
  if (result.outcome == Outcome::converged && !(result.error <= tolerance)) {
    result.outcome = std::isfinite(result.error) ? Outcome::tolerance_not_reached : Outcome::non_finite;
  }
  if (result.outcome != Outcome::converged && result.outcome != Outcome::tolerance_not_reached) {
    result.error = std::numeric_limits<double>::infinity();
  }
}

/// Runs attempt(local_tolerance) with tighter and tighter tolerances until the error is small enough.
template <typename Attempt>
auto tighten(const ToleranceLadder& ladder, double tolerance, const Attempt& attempt) {
  double local = ladder.first;
  auto result = attempt(local);
  while (result.outcome == Outcome::converged && result.error > tolerance && local > ladder.lowest) {
    local = std::max(kLadderStep * local, ladder.lowest);
    const auto spent = result.cost, spent_estimating = result.estimate_cost;
    result = attempt(local);
    result.cost += spent;
    result.estimate_cost += spent_estimating;
  }
  result.sharpest = !(local > ladder.lowest);
  settle(result, tolerance);
  return result;
}

}  // namespace strutt
