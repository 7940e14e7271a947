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
Monodromy automatic_hill_monodromy(PropagatorPool& pool, const HillEquation& equation,
                                   const MonodromyOptions& options) {
  Monodromy result = hill_monodromy(pool, equation, Method::propagator, options);
  if (result.outcome == Outcome::converged || result.outcome == Outcome::non_finite) return result;
  Monodromy other = hill_monodromy(pool, equation, Method::arkode, options);
  Monodromy& better = other.error < result.error ? other : result;
  Monodromy& worse = &better == &other ? result : other;
  better.cost += worse.cost;
  better.estimate_cost += worse.estimate_cost;
  return better;
}

}  // namespace

void MonodromyOptions::validate() const {
  require(tolerance >= 1e-13 && tolerance <= 1e-2, "tolerance", tolerance, "in [1e-13, 1e-2]");
  if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end()) {
    throw InvalidInput("method", to_string(method),
                       "one of auto, propagator, exact, arkode, cvode for a monodromy matrix");
  }
}

struct MonodromyEngine::Workspace : PropagatorPool {};

MonodromyEngine::MonodromyEngine() : workspace_(std::make_unique<Workspace>()) {}
MonodromyEngine::~MonodromyEngine() = default;
MonodromyEngine::MonodromyEngine(MonodromyEngine&&) noexcept = default;
MonodromyEngine& MonodromyEngine::operator=(MonodromyEngine&&) noexcept = default;

Monodromy MonodromyEngine::compute(const HillEquation& equation, const MonodromyOptions& options) {
  equation.validate();
  options.validate();
  const bool closed_form = equation.coefficient.is_piecewise_constant();
  if (options.method == Method::exact && !closed_form) {
    throw InvalidInput(
        "method exact needs a piecewise-constant coefficient; use auto, propagator, arkode or cvode");
  }
  if (options.method != Method::automatic)
    return hill_monodromy(*workspace_, equation, options.method, options);
  if (closed_form) return hill_monodromy(*workspace_, equation, Method::exact, options);
  return automatic_hill_monodromy(*workspace_, equation, options);
}

Monodromy MonodromyEngine::compute(const LinearPeriodicSystem& system, const MonodromyOptions& options) {
  system.validate();
  options.validate();
  if (options.method == Method::exact || options.method == Method::propagator) {
    throw InvalidInput("method", to_string(options.method),
                       "auto, arkode or cvode for a system of several degrees of freedom");
  }
  const Method method = options.method == Method::automatic ? Method::arkode : options.method;
  return system_monodromy(*workspace_, system, method, options);
}

}  // namespace strutt
