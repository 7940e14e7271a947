#pragma once

#include <complex>
#include <vector>

#include "floquet/hill_matrix.hpp"
#include "strutt/model/periodic_function.hpp"

namespace strutt {

/// The coefficient of Hill's equation without its mean, as complex harmonics, about an even centre if there
/// is one.
struct FourierExcitation {
  bool even = false;
  std::vector<std::complex<double>> harmonics{0.0};
  std::vector<double> errors{0.0};  ///< bounds of what each harmonic may differ from what was meant
  double change = 0.0;              ///< a bound of the norm of the difference from what was given

  /// `relative_error`: of each coefficient as given. Throws InvalidInput unless there are finitely many
  /// harmonics and the sum of their amplitudes is at most 1e6.
  explicit FourierExcitation(const PeriodicFunction& coefficient, double relative_error = 0.0);

  /// A bound of the norm of all errors.
  double uncertainty() const;

  HillMatrix matrix(HillBasis basis, double exponent) const { return {basis, exponent, harmonics, errors}; }
};

}  // namespace strutt
