#pragma once

#include <string_view>

namespace strutt {

/// The routes to a result, cheapest first where several fit.
enum class Method : signed char {
  automatic,   ///< the cheapest that meets the tolerance
  surrogate,   ///< Chebyshev interpolation over parameter boxes
  propagator,  ///< batched fixed-step propagator
  cvode,       ///< SUNDIALS CVODE, Adams-Moulton
  arkode,      ///< SUNDIALS ARKODE, explicit Runge-Kutta
  fourier,     ///< eigenvalues of the Fourier-side matrices
  exact,       ///< closed form
};

inline constexpr int kMethodCount = 7;

/// The name on the command line and in files: `auto`, `surrogate`, ..., `exact`.
std::string_view to_string(Method method);

/// Inverse of to_string; throws InvalidInput naming the known methods.
Method method_from_string(std::string_view name);

}  // namespace strutt
