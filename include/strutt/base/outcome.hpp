#pragma once

#include <string_view>

namespace strutt {

/// How a computation ended. Everything but `converged` leaves the value it reached in place; its `error` says
/// how far it can be trusted.
enum class Outcome : signed char {
  converged,              ///< the error bound is within the tolerance asked for
  tolerance_not_reached,  ///< a value, but its error bound is above the tolerance
  step_limit,             ///< the budget of integration steps ran out
  time_limit,             ///< the budget of seconds ran out
  step_underflow,         ///< the step became too small to change the time (t + h == t)
  non_finite,             ///< a state, coefficient or result is NaN or infinite
  cancelled,              ///< the caller asked to stop
  failed,                 ///< the integrator gave up for another reason
};

inline constexpr int kOutcomeCount = 8;

/// The name as written to files: `converged`, `tolerance_not_reached`, ...
std::string_view to_string(Outcome outcome);

}  // namespace strutt
