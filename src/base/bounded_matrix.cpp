#include "strutt/base/bounded_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace strutt {

BoundedMatrix BoundedMatrix::identity(int size) {
  BoundedMatrix result{ScaledMatrix{Eigen::MatrixXd::Identity(size, size), 0}, Eigen::MatrixXd::Zero(size, size)};
  return result;
}

void BoundedMatrix::normalise() {
  const long before = value.exponent;
  value.normalise();
  const int shift = static_cast<int>(value.exponent - before);
  error = error.unaryExpr([shift](double x) { return std::ldexp(x, -shift); });
}

BoundedMatrix ordered_product(const std::vector<BoundedMatrix>& factors, int size) {
  if (factors.empty()) return BoundedMatrix::identity(size);
  const std::size_t count = factors.size();
  std::vector<ScaledMatrix> suffix(count);  // suffix[j] = product of the factors after j
  suffix[count - 1] = ScaledMatrix::identity(size);
  for (std::size_t j = count - 1; j-- > 0;) suffix[j] = suffix[j + 1] * factors[j + 1].value;

  ScaledMatrix prefix = ScaledMatrix::identity(size);
  BoundedMatrix result{suffix[0] * factors[0].value, Eigen::MatrixXd::Zero(size, size)};
  const double product_rounding = count > 1 ? size * 0x1p-53 : 0.0;
  for (std::size_t j = 0; j < count; ++j) {
    const auto& factor = factors[j];
    const Eigen::MatrixXd own = 1.01 * factor.error + product_rounding * factor.value.mantissa.cwiseAbs();
    const Eigen::MatrixXd carried = suffix[j].mantissa.cwiseAbs() * own * prefix.mantissa.cwiseAbs();
    const long exponent = suffix[j].exponent + factor.value.exponent + prefix.exponent - result.value.exponent;
    const int shift = static_cast<int>(std::clamp(exponent, -5000L, 5000L));
    result.error += carried.unaryExpr([shift](double x) { return std::ldexp(x, shift); });
    prefix = factor.value * prefix;
  }
  return result;
}

}  // namespace strutt
