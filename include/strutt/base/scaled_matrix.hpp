#pragma once

#include <Eigen/Core>

namespace strutt {

/// A square matrix as mantissa x 2^exponent, so that products of strongly growing propagators do not overflow
/// (numerical extremes N1, N15). Normalised: the largest absolute entry of the mantissa lies in [1/2, 1), or all are 0.
struct ScaledMatrix {
  Eigen::MatrixXd mantissa;
  long exponent = 0;

  static ScaledMatrix identity(int size);

  /// Brings `mantissa` back into the range above. Exact: only powers of two move.
  void normalise();

  /// Entry (row, column) as a plain double; overflows to +-inf, underflows to 0.
  double entry(int row, int column) const;

  /// Natural logarithm of the largest absolute entry; -inf for the zero matrix.
  double log_max_abs() const;
};

/// Product, normalised. Each entry carries the rounding of one inner product in double.
ScaledMatrix operator*(const ScaledMatrix& a, const ScaledMatrix& b);

}  // namespace strutt
