#include "strutt/base/scaled_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace strutt {

template <typename Matrix>
BasicScaledMatrix<Matrix> BasicScaledMatrix<Matrix>::identity(int size) {
  BasicScaledMatrix result{Matrix::Identity(size, size), 0};
  result.normalise();
  return result;
}

template <typename Matrix>
void BasicScaledMatrix<Matrix>::normalise() {
  const double largest = mantissa.size() == 0 ? 0.0 : mantissa.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !std::isfinite(largest)) return;
  int shift = 0;
  std::frexp(largest, &shift);
  mantissa = times_power_of_two(mantissa, -shift);
  exponent += shift;
}

template <typename Matrix>
double BasicScaledMatrix<Matrix>::entry(int row, int column) const {
  return std::ldexp(mantissa(row, column), static_cast<int>(std::clamp(exponent, -5000L, 5000L)));
}

template <typename Matrix>
double BasicScaledMatrix<Matrix>::log_max_abs() const {
  return std::log(mantissa.cwiseAbs().maxCoeff()) + static_cast<double>(exponent) * std::log(2.0);
}

template <typename Matrix>
BasicScaledMatrix<Matrix> operator*(const BasicScaledMatrix<Matrix>& a, const BasicScaledMatrix<Matrix>& b) {
  BasicScaledMatrix<Matrix> result{a.mantissa * b.mantissa, a.exponent + b.exponent};
  result.normalise();
  return result;
}

template <typename Matrix>
Matrix times_power_of_two(const Matrix& x, long exponent) {
  if (exponent == 0) return x;
  // one product where the factor is a normal number: a call for every entry costs ten times as much
  if (exponent >= -1022 && exponent <= 1023) return x * std::ldexp(1.0, static_cast<int>(exponent));
  const int shift = static_cast<int>(std::clamp(exponent, -5000L, 5000L));
  return x.unaryExpr([shift](double entry) { return std::ldexp(entry, shift); });
}

#define STRUTT_INSTANTIATE(Matrix)                                                \
  template struct BasicScaledMatrix<Matrix>;                                      \
  template BasicScaledMatrix<Matrix> operator*(const BasicScaledMatrix<Matrix>&,  \
                                               const BasicScaledMatrix<Matrix>&); \
  template Matrix times_power_of_two(const Matrix&, long);
STRUTT_INSTANTIATE(Eigen::MatrixXd)
STRUTT_INSTANTIATE(Eigen::Matrix2d)
#undef STRUTT_INSTANTIATE

}  // namespace strutt
