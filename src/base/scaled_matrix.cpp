#include "strutt/base/scaled_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace strutt {

ScaledMatrix ScaledMatrix::identity(int size) {
  ScaledMatrix result{Eigen::MatrixXd::Identity(size, size), 0};
  result.normalise();
  return result;
}

void ScaledMatrix::normalise() {
  const double largest = mantissa.size() == 0 ? 0.0 : mantissa.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !std::isfinite(largest)) return;
  int shift = 0;
  std::frexp(largest, &shift);
  mantissa = mantissa.unaryExpr([shift](double x) { return std::ldexp(x, -shift); });
  exponent += shift;
}

double ScaledMatrix::entry(int row, int column) const {
  return std::ldexp(mantissa(row, column), static_cast<int>(std::clamp(exponent, -5000L, 5000L)));
}

double ScaledMatrix::log_max_abs() const {
  return std::log(mantissa.cwiseAbs().maxCoeff()) + static_cast<double>(exponent) * std::log(2.0);
}

ScaledMatrix operator*(const ScaledMatrix& a, const ScaledMatrix& b) {
  ScaledMatrix result{a.mantissa * b.mantissa, a.exponent + b.exponent};
  result.normalise();
  return result;
}

}  // namespace strutt
