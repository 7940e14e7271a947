#pragma once

#include <atomic>
#include <optional>

#include "chart/reference_equation.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt::judge {

/// The monodromy matrix over one period from t = 0, state (q, q'/kappa), to about 40 digits.
struct Monodromy {
  Matrix matrix;
  Real kappa = 1;  ///< in the scene's unit of time
};

/// Taylor series of order 60 in the phase, each step as long as its last terms stay below 1e-42 of the
/// largest; the equation turns the known coefficients of its terms into a recurrence for those of the
/// solution (Jorba and Zou, Experiment. Math. 14 (2005) 99-117). Nothing when `cancel` is set or 200,000
/// steps do not suffice.
std::optional<Monodromy> monodromy(const Equation& equation, const std::atomic<bool>* cancel = nullptr);

/// |computed - true| of trace and entries as the column `error` of `strutt stability` bounds it
/// (docs/conventions.md); +inf where there is no matrix.
double true_error(const Monodromy& truth, const Stability& result);

/// The same of the trace alone.
double trace_error(const Monodromy& truth, const Stability& result);

}  // namespace strutt::judge
