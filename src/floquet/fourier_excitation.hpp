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
  double change = 0.0;  ///< a bound of the norm of the difference from what was given

  /// Throws InvalidInput unless it has finitely many harmonics and the sum of their amplitudes is at most
  /// 1e6.
  explicit FourierExcitation(const PeriodicFunction& coefficient);

  HillMatrix matrix(HillBasis basis, double exponent) const { return {basis, exponent, harmonics}; }
};

}  // namespace strutt
