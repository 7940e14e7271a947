#include "floquet/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"

namespace strutt {

BoundedMatrix2 mirrored(BoundedMatrix2 propagator) {
  auto& m = propagator.value.mantissa;
  std::swap(m(0, 0), m(1, 1));
  std::swap(propagator.error(0, 0), propagator.error(1, 1));
  return propagator;
}

BoundedMatrix2 period_from_half(const std::vector<BoundedMatrix2>& half, std::size_t before) {
  std::vector<BoundedMatrix2> factors;
  factors.reserve(2 * half.size());
  for (std::size_t j = before; j-- > 0;) factors.push_back(mirrored(half[j]));  // [0, theta0]
  factors.insert(factors.end(), half.begin(), half.end());                      // [theta0, theta0 + pi]
  for (std::size_t j = half.size(); j-- > before;)
    factors.push_back(mirrored(half[j]));  // the rest, mirrored
  return ordered_product(factors, 2);
}

template <typename Matrix>
BasicBoundedMatrix<Matrix> restore_damping(const BasicBoundedMatrix<Matrix>& undamped, double half_damping,
                                           double slope) {
  if (half_damping == 0.0) return undamped;
  const Eigen::Index n = undamped.value.mantissa.rows(), d = n / 2;
  Matrix left = Matrix::Identity(n, n), right = left;
  left.bottomLeftCorner(d, d).diagonal().setConstant(-slope);
  right.bottomLeftCorner(d, d).diagonal().setConstant(slope);

  const double exponent = std::floor(-half_damping / std::numbers::ln2);
  const double factor = std::exp(-half_damping - exponent * std::numbers::ln2);
  BasicBoundedMatrix<Matrix> result;
  result.value = {factor * (left * undamped.value.mantissa * right),
                  undamped.value.exponent + static_cast<long>(exponent)};
  if (undamped.error.size() == 0) {
    result.normalise();
    return result;
  }
  // roundings: three a product, the slope's in both outer factors, and those of exp(-h), which grow with h
  const Matrix size = factor * (left.cwiseAbs() * undamped.value.mantissa.cwiseAbs() * right.cwiseAbs());
  result.error = factor * (left.cwiseAbs() * undamped.error * right.cwiseAbs()) +
                 (8.0 + 4.0 * half_damping) * kUnit * size;
  result.normalise();
  return result;
}

template <typename Matrix>
double scaled_error(const BasicBoundedMatrix<Matrix>& matrix) {
  const double largest_error = std::max(matrix.error.maxCoeff(), matrix.error.trace());
  const double largest = matrix.value.mantissa.cwiseAbs().maxCoeff();
  if (!std::isfinite(largest) || !std::isfinite(largest_error))
    return std::numeric_limits<double>::infinity();
  const int exponent = static_cast<int>(std::clamp(matrix.value.exponent, -5000L, 5000L));
  // divide by max(1, largest * 2^exponent) without overflow
  const double scaled =
      std::ldexp(largest, exponent) > 1.0 ? largest_error / largest : std::ldexp(largest_error, exponent);
  const auto n = static_cast<double>(matrix.value.mantissa.rows());
  return scaled + (2.0 + n) * kUnit;  // conversion to the scene's units and the sum of the trace
}

double determinant_defect(const BoundedMatrix2& propagator) {
  const auto& m = propagator.value.mantissa;
  const double product = m(0, 1) * m(1, 0);
  const double rest = std::fma(m(0, 1), m(1, 0), -product);
  const double determinant = std::fma(m(0, 0), m(1, 1), -product) - rest;
  const int exponent = static_cast<int>(std::clamp(propagator.value.exponent, -5000L, 5000L));
  return std::abs(determinant - std::ldexp(1.0, -2 * exponent)) / m.squaredNorm();
}

Monodromy widened(const HillMonodromy& m) {
  const auto wide = [](const BoundedMatrix2& narrow) {
    return BoundedMatrix{{narrow.value.mantissa, narrow.value.exponent}, narrow.error};
  };
  Monodromy result{.matrix = wide(m.matrix),
                   .undamped = wide(m.undamped),
                   .half_damping = m.half_damping,
                   .half = std::nullopt,
                   .kappa = m.kappa,
                   .error = m.error,
                   .determinant_defect = m.determinant_defect,
                   .sharpest = m.sharpest,
                   .method = m.method,
                   .outcome = m.outcome,
                   .cost = m.cost,
                   .estimate_cost = m.estimate_cost};
  if (m.half) result.half = wide(*m.half);
  return result;
}

template BoundedMatrix restore_damping(const BoundedMatrix&, double, double);
template BoundedMatrix2 restore_damping(const BoundedMatrix2&, double, double);
template double scaled_error(const BoundedMatrix&);
template double scaled_error(const BoundedMatrix2&);

}  // namespace strutt
