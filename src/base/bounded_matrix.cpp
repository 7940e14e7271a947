#include "strutt/base/bounded_matrix.hpp"

#include <cmath>

namespace strutt {
namespace {

constexpr double kSecondOrder = 1.01;  // room for the products of errors

}  // namespace

template <typename Matrix>
BasicBoundedMatrix<Matrix> BasicBoundedMatrix<Matrix>::identity(int size) {
  return {{Matrix::Identity(size, size), 0}, Matrix::Zero(size, size)};
}

template <typename Matrix>
void BasicBoundedMatrix<Matrix>::normalise() {
  const long before = value.exponent;
  value.normalise();
  error = times_power_of_two(error, before - value.exponent);
}

namespace {

/// suffix[j]: the product of the factors after j, for all but the last.
template <typename Matrix>
std::vector<BasicScaledMatrix<Matrix>> products_after(
    const std::vector<BasicBoundedMatrix<Matrix>>& factors) {
  std::vector<BasicScaledMatrix<Matrix>> suffix(factors.size() - 1);
  for (std::size_t j = suffix.size(); j-- > 0;) {
    suffix[j] = j + 1 < suffix.size() ? suffix[j + 1] * factors[j + 1].value : factors[j + 1].value;
  }
  return suffix;
}

}  // namespace

template <typename Matrix>
BasicBoundedMatrix<Matrix> ordered_product(const std::vector<BasicBoundedMatrix<Matrix>>& factors, int size) {
  using Bounded = BasicBoundedMatrix<Matrix>;
  if (factors.empty()) return Bounded::identity(size);
  if (factors.size() == 1) {
    Bounded result = factors[0];
    result.error *= kSecondOrder;
    result.normalise();
    return result;
  }
  const auto suffix = products_after(factors);
  Bounded result{suffix[0] * factors[0].value, {}};
  if (factors[0].error.size() == 0) return result;

  result.error = Matrix::Zero(size, size);
  BasicScaledMatrix<Matrix> prefix;  // the product of the factors before j > 0
  for (std::size_t j = 0; j < factors.size(); ++j) {
    const auto& factor = factors[j];
    Matrix carried = kSecondOrder * factor.error + size * 0x1p-53 * factor.value.mantissa.cwiseAbs();
    long exponent = factor.value.exponent - result.value.exponent;
    if (j < suffix.size()) {
      carried = suffix[j].mantissa.cwiseAbs() * carried;
      exponent += suffix[j].exponent;
    }
    if (j > 0) {
      carried *= prefix.mantissa.cwiseAbs();
      exponent += prefix.exponent;
    }
    result.error += times_power_of_two(carried, exponent);
    if (j < suffix.size()) prefix = j > 0 ? factor.value * prefix : factor.value;
  }
  return result;
}

template struct BasicBoundedMatrix<Eigen::MatrixXd>;
template struct BasicBoundedMatrix<Eigen::Matrix2d>;
template BoundedMatrix ordered_product(const std::vector<BoundedMatrix>&, int);
template BoundedMatrix2 ordered_product(const std::vector<BoundedMatrix2>&, int);

}  // namespace strutt
