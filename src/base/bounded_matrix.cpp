#include "strutt/base/bounded_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace strutt {
namespace {

constexpr double kSecondOrder = 1.01;  // room for the products of errors

}  // namespace

BoundedMatrix BoundedMatrix::identity(int size) {
  BoundedMatrix result{ScaledMatrix{Eigen::MatrixXd::Identity(size, size), 0},
                       Eigen::MatrixXd::Zero(size, size)};
  return result;
}

void BoundedMatrix::normalise() {
  const long before = value.exponent;
  value.normalise();
  const int shift = static_cast<int>(value.exponent - before);
  error = error.unaryExpr([shift](double x) { return std::ldexp(x, -shift); });
}

namespace {

/// suffix[j]: the product of the factors after j, for all but the last.
std::vector<ScaledMatrix> products_after(const std::vector<BoundedMatrix>& factors) {
  std::vector<ScaledMatrix> suffix(factors.size() - 1);
  for (std::size_t j = suffix.size(); j-- > 0;) {
    suffix[j] = j + 1 < suffix.size() ? suffix[j + 1] * factors[j + 1].value : factors[j + 1].value;
  }
  return suffix;
}

}  // namespace

BoundedMatrix ordered_product(const std::vector<BoundedMatrix>& factors, int size) {
  if (factors.empty()) return BoundedMatrix::identity(size);
  if (factors.size() == 1) {
    BoundedMatrix result = factors[0];
    result.error *= kSecondOrder;
    result.normalise();
    return result;
  }
  const std::vector<ScaledMatrix> suffix = products_after(factors);
  BoundedMatrix result{suffix[0] * factors[0].value, {}};
  if (factors[0].error.size() == 0) return result;

  result.error = Eigen::MatrixXd::Zero(size, size);
  ScaledMatrix prefix;  // the product of the factors before j > 0
  for (std::size_t j = 0; j < factors.size(); ++j) {
    const auto& factor = factors[j];
    Eigen::MatrixXd carried = kSecondOrder * factor.error + size * 0x1p-53 * factor.value.mantissa.cwiseAbs();
    long exponent = factor.value.exponent - result.value.exponent;
    if (j < suffix.size()) {
      carried = suffix[j].mantissa.cwiseAbs() * carried;
      exponent += suffix[j].exponent;
    }
    if (j > 0) {
      carried *= prefix.mantissa.cwiseAbs();
      exponent += prefix.exponent;
    }
    const int shift = static_cast<int>(std::clamp(exponent, -5000L, 5000L));
    result.error += carried.unaryExpr([shift](double x) { return std::ldexp(x, shift); });
    if (j < suffix.size()) prefix = j > 0 ? factor.value * prefix : factor.value;
  }
  return result;
}

}  // namespace strutt
