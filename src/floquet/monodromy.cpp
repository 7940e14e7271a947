#include "strutt/floquet/monodromy.hpp"

#include <algorithm>
#include <array>

#include "floquet/propagators.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr std::array kMethods{Method::automatic, Method::propagator, Method::exact, Method::arkode,
                              Method::cvode};

/// The splitting where it reaches the tolerance, otherwise whatever comes closest.
HillMonodromy automatic_hill_monodromy(PropagatorPool& pool, const HillEquation& equation,
                                   const MonodromyOptions& options) {
  HillMonodromy result = hill_monodromy(pool, equation, Method::propagator, options);
  if (result.outcome == Outcome::converged || result.outcome == Outcome::non_finite) return result;
  HillMonodromy other = hill_monodromy(pool, equation, Method::arkode, options);
  HillMonodromy& better = other.error < result.error ? other : result;
  HillMonodromy& worse = &better == &other ? result : other;
  better.cost += worse.cost;
  better.estimate_cost += worse.estimate_cost;
  return better;
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
  equation.validate();
  options.validate();
  const Method method = method_for(equation, options.method);
  if (options.method == Method::automatic && method == Method::propagator)
    return automatic_hill_monodromy(*workspace_, equation, options);
  return hill_monodromy(*workspace_, equation, method, options);
}

Monodromy MonodromyEngine::compute(const LinearPeriodicSystem& system, const MonodromyOptions& options) {
  system.validate();
  options.validate();
  return system_monodromy(*workspace_, system, method_for(system, options.method), options);
}

}  // namespace strutt
