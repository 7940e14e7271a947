#include "strutt/floquet/monodromy.hpp"

#include <algorithm>
#include <array>

#include "floquet/propagators.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

constexpr std::array kMethods{Method::automatic, Method::propagator, Method::exact, Method::arkode,
                              Method::cvode};

/// The one that comes closest, at the cost of both.
template <typename Matrix>
BasicMonodromy<Matrix> better_of(BasicMonodromy<Matrix> a, BasicMonodromy<Matrix> b) {
  auto& better = b.error < a.error ? b : a;
  const auto& worse = &better == &b ? a : b;
  better.cost += worse.cost;
  better.estimate_cost += worse.estimate_cost;
  return std::move(better);
}

/// Is SUNDIALS to be asked, after the propagator ended like this? Where only rounding keeps the propagator
/// from its tolerance, an adaptive method does no better at many times the cost.
bool needs_sundials(Outcome outcome, Method asked) {
  return asked == Method::automatic && outcome == Outcome::step_limit;
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
  if (asked == Method::automatic) return Method::propagator;
  if (asked == Method::exact) refuse_exact();
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
  const DefaultFloatingPoint environment;
  options.validate();
  std::vector<HillMonodromy> results(equations.size());
  std::vector<const HillEquation*> smooth;  // those that go side by side
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    equations[i].validate();
    const Method method = method_for(equations[i], options.method);
    if (method == Method::propagator) {
      smooth.push_back(&equations[i]);
      places.push_back(i);
    } else {
      results[i] = hill_monodromy(*workspace_, equations[i], method, options);
    }
  }
  auto found = series_monodromies(workspace_->series, smooth, options);
  for (std::size_t j = 0; j < found.size(); ++j) {
    auto& result = results[places[j]] = std::move(found[j]);
    if (!needs_sundials(result.outcome, options.method)) continue;
    result = better_of(std::move(result), hill_monodromy(*workspace_, *smooth[j], Method::arkode, options));
  }
  return results;
}

Monodromy MonodromyEngine::compute(const LinearPeriodicSystem& system, const MonodromyOptions& options) {
  const DefaultFloatingPoint environment;
  system.validate();
  options.validate();
  const Method method = method_for(system, options.method);
  auto result = system_monodromy(*workspace_, system, method, options);
  if (method != Method::propagator || !needs_sundials(result.outcome, options.method)) return result;
  return better_of(std::move(result), system_monodromy(*workspace_, system, Method::arkode, options));
}

}  // namespace strutt
