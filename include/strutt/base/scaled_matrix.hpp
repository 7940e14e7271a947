#pragma once

#include <Eigen/Core>

namespace strutt {

/// Zeros, or a matrix without entries where the type does not say how many there are.
template <typename Matrix>
Matrix cleared() {
  if constexpr (Matrix::SizeAtCompileTime == Eigen::Dynamic) {
    return {};
  } else {
    return Matrix::Zero();
  }
}

/// A square matrix as mantissa x 2^exponent, so that products of strongly growing propagators do not overflow
/// (numerical extremes N1, N15). Normalised: the largest absolute entry of the mantissa lies in [1/2, 1), or
/// all are 0. `Matrix` is Eigen::MatrixXd, or Eigen::Matrix2d for equations of second order.
template <typename Matrix>
struct BasicScaledMatrix {
  Matrix mantissa = cleared<Matrix>();
  long exponent = 0;

  static BasicScaledMatrix identity(int size);

  /// Brings `mantissa` back into the range above. Exact: only powers of two move.
  void normalise();

  /// Entry (row, column) as a plain double; overflows to +-inf, underflows to 0.
  double entry(int row, int column) const;

  /// Natural logarithm of the largest absolute entry; -inf for the zero matrix.
  double log_max_abs() const;
};

using ScaledMatrix = BasicScaledMatrix<Eigen::MatrixXd>;
using ScaledMatrix2 = BasicScaledMatrix<Eigen::Matrix2d>;

/// Product, normalised. Each entry carries the rounding of one inner product in double.
template <typename Matrix>
BasicScaledMatrix<Matrix> operator*(const BasicScaledMatrix<Matrix>& a, const BasicScaledMatrix<Matrix>& b);

/// x 2^exponent, rounded once; overflows to +-inf, underflows to 0.
template <typename Matrix>
Matrix times_power_of_two(const Matrix& x, long exponent);

}  // namespace strutt
