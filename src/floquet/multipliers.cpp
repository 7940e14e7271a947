#include "strutt/floquet/multipliers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"
#include "floquet/lapack.hpp"

namespace strutt {
namespace {

constexpr double kFirstOrderSafety = 4.0;  // for perturbations of eigenvalues beyond first order

}  // namespace

std::vector<Multiplier> hill_multipliers(const DiscriminantGap& d, double half_damping) {
  const double sign = d.sign;
  if (d.gap > 0.0) {
    const double cosine = sign * (1.0 - 0.5 * d.gap), sine = std::sqrt(0.5 * d.gap * (2.0 - 0.5 * d.gap));
    return {{-half_damping, {cosine, sine}, 0.0}, {-half_damping, {cosine, -sine}, 0.0}};
  }
  const double undamped = hill_growth(d, 0.0);  // acosh(|D|/2)
  const double slope = undamped > 0.0 ? 1.0 / std::tanh(undamped) : std::numeric_limits<double>::infinity();
  const double error = d.gap == 0.0 && d.gap_error == 0.0 ? 0.0 : d.log_abs_error * slope;
  return {{undamped - half_damping, sign, error}, {-undamped - half_damping, sign, error}};
}

std::vector<Multiplier> system_multipliers(const BoundedMatrix& matrix) {
  const auto eigen = lapack::eigenvalues(matrix.value.mantissa);
  const auto n = static_cast<double>(eigen.values.size());
  const double perturbation = matrix.error.norm() + 4.0 * n * kUnit * matrix.value.mantissa.norm();
  std::vector<Multiplier> result;
  for (Eigen::Index j = 0; j < eigen.values.size(); ++j) {
    const auto value = eigen.values[j];
    const double modulus = std::abs(value);
    const double error = kFirstOrderSafety * perturbation / (eigen.condition[j] * modulus);
    const auto direction = modulus > 0.0 ? value / modulus : std::complex<double>(1.0);
    const double log_modulus =
        std::log(modulus) + static_cast<double>(matrix.value.exponent) * std::numbers::ln2;
    result.push_back({log_modulus, direction, error});
  }
  std::stable_sort(result.begin(), result.end(), [](const Multiplier& a, const Multiplier& b) {
    if (a.log_modulus != b.log_modulus) return a.log_modulus > b.log_modulus;
    return a.direction.imag() > b.direction.imag();
  });
  return result;
}

SystemStability general_stability(const std::vector<Multiplier>& multipliers) {
  const Multiplier& largest = multipliers.front();
  // any of the others may turn out to be the largest within its error
  double upper = largest.log_modulus + largest.log_modulus_error;
  for (const auto& m : multipliers) {
    if (m.log_modulus_error < 1.0) upper = std::max(upper, m.log_modulus + m.log_modulus_error);
  }
  return {{-largest.log_modulus, upper - largest.log_modulus}, largest.log_modulus};
}

}  // namespace strutt
