#include "strutt/floquet/monodromy.hpp"

#include <algorithm>
#include <array>

#include "floquet/propagators.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr std::array kMethods{Method::automatic, Method::propagator, Method::exact, Method::arkode,
                              Method::cvode};

/// What comes closest: `by_series`, which did not reach the tolerance, or SUNDIALS.
HillMonodromy better_monodromy(PropagatorPool& pool, const HillEquation& equation, HillMonodromy by_series,
                               const MonodromyOptions& options) {
  HillMonodromy other = hill_monodromy(pool, equation, Method::arkode, options);
  HillMonodromy& better = other.error < by_series.error ? other : by_series;
  HillMonodromy& worse = &better == &other ? by_series : other;
  better.cost += worse.cost;
  better.estimate_cost += worse.estimate_cost;
  return better;
}

bool ends_the_search(Outcome outcome) {
  return outcome == Outcome::converged || outcome == Outcome::non_finite || outcome == Outcome::cancelled;
}

[[noreturn]] void refuse_exact() {
  throw InvalidInput(
      "method exact needs a piecewise-constant coefficient; use auto, propagator, arkode or cvode");
}

}  // namespace

void MonodromyOptions::validate() const {
  require(tolerance >= 1e-13 && tolerance <= 1e-2, "tolerance", tolerance, "in [1e-13, 1e-2]");
  if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end()) {
    throw InvalidInput("method", to_string(method),
                       "one of auto, propagator, exact, arkode, cvode for a monodromy matrix");
  }
}

Method method_for(const HillEquation& equation, Method asked) {
  const bool closed_form = equation.coefficient.is_piecewise_constant();
  if (asked == Method::automatic) return closed_form ? Method::exact : Method::propagator;
  if (asked == Method::exact && !closed_form) refuse_exact();
  MonodromyOptions{.method = asked}.validate();
  return asked;
}

Method method_for(const LinearPeriodicSystem&, Method asked) {
  if (asked == Method::automatic) return Method::arkode;
  if (asked == Method::exact) refuse_exact();
  if (asked == Method::propagator) {
    throw InvalidInput(
        "method propagator needs a system of one degree of freedom; use auto, arkode or cvode");
  }
  MonodromyOptions{.method = asked}.validate();
  return asked;
}

struct MonodromyEngine::Workspace : PropagatorPool {};

MonodromyEngine::MonodromyEngine() : workspace_(std::make_unique<Workspace>()) {}
MonodromyEngine::~MonodromyEngine() = default;
MonodromyEngine::MonodromyEngine(MonodromyEngine&&) noexcept = default;
MonodromyEngine& MonodromyEngine::operator=(MonodromyEngine&&) noexcept = default;

HillMonodromy MonodromyEngine::compute(const HillEquation& equation, const MonodromyOptions& options) {
  return std::move(compute(std::span(&equation, 1), options).front());
}

std::vector<HillMonodromy> MonodromyEngine::compute(std::span<const HillEquation> equations,
                                                    const MonodromyOptions& options) {
  options.validate();
  std::vector<HillMonodromy> results(equations.size());
  std::vector<HillEquation> smooth;  // those that go side by side
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    equations[i].validate();
    const Method method = method_for(equations[i], options.method);
    if (method == Method::propagator) {
      smooth.push_back(equations[i]);
      places.push_back(i);
    } else {
      results[i] = hill_monodromy(*workspace_, equations[i], method, options);
    }
  }
  auto found = series_monodromies(workspace_->series, smooth, options);
  for (std::size_t j = 0; j < found.size(); ++j) {
    const bool done = options.method == Method::propagator || ends_the_search(found[j].outcome);
    results[places[j]] =
        done ? std::move(found[j]) : better_monodromy(*workspace_, smooth[j], std::move(found[j]), options);
  }
  return results;
}

Monodromy MonodromyEngine::compute(const LinearPeriodicSystem& system, const MonodromyOptions& options) {
  system.validate();
  options.validate();
  return system_monodromy(*workspace_, system, method_for(system, options.method), options);
}

}  // namespace strutt
