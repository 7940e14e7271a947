#include "floquet/reciprocal_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"

namespace strutt {
namespace {

/// ln|lambda| >= 0 and its error from rho = (mantissa) 2^exponent = lambda + 1/lambda.
struct LogModulus {
  double value, error;
};
LogModulus log_modulus(std::complex<double> mantissa, double error, long exponent) {
  const double log_rho = std::log(std::abs(mantissa)) + static_cast<double>(exponent) * std::numbers::ln2;
  if (log_rho > 30.0) return {log_rho, error / std::abs(mantissa) + kUnit * log_rho};
  const double scale = std::ldexp(1.0, static_cast<int>(std::max(exponent, -2000L)));
  const std::complex<double> half = 0.5 * scale * mantissa;
  const std::complex<double> root = std::sqrt((half - 1.0) * (half + 1.0));
  const double modulus = std::max(std::abs(half + root), std::abs(half - root));
  const double shift = 0.5 * scale * error;
  return {std::log(modulus), std::min(shift / std::abs(root), std::sqrt(2.0 * shift) + shift) + 4.0 * kUnit};
}

/// 1 - |rho|/(2 cosh h).
Margin real_margin(double mantissa, double error, long exponent, double h) {
  const double log_cosh = h + std::log1p(std::exp(-2.0 * h));
  const double log_scale = static_cast<double>(exponent) * std::numbers::ln2 - log_cosh;
  if (std::log(std::abs(mantissa)) + log_scale > 690.0) return {kLowestMargin, 0.0};
  const double scale = std::exp(log_scale);
  return {1.0 - std::abs(mantissa) * scale,
          error * scale + 8.0 * kUnit * (1.0 + h) * (1.0 + std::abs(mantissa) * scale)};
}

/// A real number with a bound.
struct BoundedSum {
  double value, error;
};
BoundedSum sum(BoundedSum x, BoundedSum y) {
  return {x.value + y.value, x.error + y.error + kUnit * std::abs(x.value + y.value)};
}
BoundedSum difference(BoundedSum x, BoundedSum y) { return sum(x, {-y.value, y.error}); }
BoundedSum half(BoundedSum x) { return {0.5 * x.value, 0.5 * x.error}; }
BoundedSum product(BoundedSum x, BoundedSum y) {
  const double value = x.value * y.value;
  return {value, std::abs(x.value) * y.error + std::abs(y.value) * x.error + x.error * y.error +
                     kUnit * std::abs(value)};
}

}  // namespace

SystemStability stability_of(std::span<const MultiplierSum> sums, bool collision, long exponent,
                             double half_damping) {
  bool all_real = true;
  Margin least{1.0, 0.0};
  LogModulus largest{0.0, 0.0};
  for (const auto& r : sums) {
    all_real = all_real && r.value.imag() == 0.0;
    const auto margin = real_margin(r.value.real(), r.error, exponent, half_damping);
    if (margin.value < least.value) least = margin;
    least.error = std::max(least.error, margin.value == least.value ? margin.error : 0.0);
    const bool on_circle =
        r.value.imag() == 0.0 && std::ldexp(std::abs(r.value.real()), static_cast<int>(exponent)) <= 2.0;
    const auto modulus = on_circle ? LogModulus{0.0, 0.0} : log_modulus(r.value, r.error, exponent);
    if (modulus.value > largest.value) largest = modulus;
  }
  SystemStability result;
  result.growth = largest.value - half_damping;
  const Margin by_growth{-result.growth, largest.error + 4.0 * kUnit * half_damping};
  if (!collision) {
    result.margin = all_real ? least : by_growth;
    return result;
  }
  // Real or complex cannot be told: the margin lies between the two formulas.
  const double a = least.value, b = by_growth.value;
  result.margin = {0.5 * (a + b), 0.5 * std::abs(a - b) + std::max(least.error, by_growth.error)};
  if (half_damping == 0.0 && result.margin.value > -result.margin.error) {
    result.margin.error =
        std::max(result.margin.error, std::abs(result.margin.value));  // growth 0 proves nothing
  }
  return result;
}

SystemStability reciprocal_stability(const SymplecticBlocks& n, long exponent, double half_damping) {
  const auto entry = [](const Eigen::Matrix2d& m, const Eigen::Matrix2d& error, int i, int j) {
    return BoundedSum{m(i, j), error(i, j)};
  };
  const auto p = [&](int i, int j) { return sum(entry(n.a, n.a_error, i, j), entry(n.d, n.d_error, j, i)); };
  const auto skew = [&](const Eigen::Matrix2d& m, const Eigen::Matrix2d& error) {
    return difference(entry(m, error, 0, 1), entry(m, error, 1, 0));
  };
  const BoundedSum p11 = p(0, 0), p22 = p(1, 1), middle = half(sum(p11, p22)),
                   apart = half(difference(p11, p22));
  const BoundedSum delta = difference(sum(product(apart, apart), product(p(0, 1), p(1, 0))),
                                      product(skew(n.b, n.b_error), skew(n.c, n.c_error)));
  const double root = std::sqrt(std::abs(delta.value));
  const bool collision = !(std::abs(delta.value) > delta.error);
  // |sqrt(x) - sqrt(y)| = |x - y|/(sqrt(x) + sqrt(y)), and at most sqrt(|x - y|)
  const double shift = collision ? std::sqrt(delta.error)
                                 : delta.error / (root + std::sqrt(std::abs(delta.value) - delta.error));
  const double error = middle.error + shift + 4.0 * kUnit * (std::abs(middle.value) + root);
  const bool real = delta.value >= 0.0;
  const std::array<MultiplierSum, 2> sums{
      MultiplierSum{{middle.value + (real ? root : 0.0), real ? 0.0 : root}, error},
      MultiplierSum{{middle.value - (real ? root : 0.0), real ? 0.0 : -root}, error}};
  return stability_of(sums, collision, exponent, half_damping);
}

}  // namespace strutt
