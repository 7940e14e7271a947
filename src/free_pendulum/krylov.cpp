#include "strutt/free_pendulum/krylov.hpp"

#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/free_pendulum/elliptic.hpp"

namespace strutt {
namespace {

constexpr double kSqrt8 = 2.0 * std::numbers::sqrt2;
// sqrt(6) = high + low to more than 100 bits.
constexpr double kSqrt6 = 2.449489742783178;
constexpr double kSqrt6Low = 2.168616518103246e-16;

void require_in_range(KrylovVariant variant, double amplitude) {
  const double limit = krylov_limit(variant);
  require(std::abs(amplitude) < limit, "amplitude", amplitude,
          variant == KrylovVariant::frequency ? "|mu| < 4" : "|mu| < sqrt(8)");
}

}  // namespace

double krylov_limit(KrylovVariant variant) { return variant == KrylovVariant::frequency ? 4.0 : kSqrt8; }

double krylov_frequency_ratio(KrylovVariant variant, double amplitude) {
  const DefaultFloatingPoint environment;
  require_in_range(variant, amplitude);
  // 1 - mu^2/16 as a product: no cancellation at the limit.
  if (variant == KrylovVariant::frequency) return (1.0 - amplitude / 4.0) * (1.0 + amplitude / 4.0);
  return std::sqrt(std::fma(-amplitude / 8.0, amplitude, 1.0));
}

double krylov_period_ratio(KrylovVariant variant, double amplitude) {
  const DefaultFloatingPoint environment;
  return 1.0 / krylov_frequency_ratio(variant, amplitude);
}

KrylovMotion::KrylovMotion(KrylovVariant variant, double alpha, double amplitude) : amplitude_(amplitude) {
  const DefaultFloatingPoint environment;
  require(alpha > 0.0 && std::isfinite(alpha), "alpha", alpha, "a positive number");
  const double ratio = krylov_frequency_ratio(variant, amplitude);
  frequency_ = alpha * ratio;
  third_harmonic_ = amplitude * amplitude * amplitude / (192.0 * ratio * ratio);
}

double KrylovMotion::period() const {
  const DefaultFloatingPoint environment;
  return 2.0 * std::numbers::pi / frequency_;
}

double KrylovMotion::angle(double time) const {
  const DefaultFloatingPoint environment;
  const double phase = frequency_ * time;
  return amplitude_ * std::cos(phase) + third_harmonic_ * (std::cos(phase) - std::cos(3.0 * phase));
}

double KrylovMotion::velocity(double time) const {
  const DefaultFloatingPoint environment;
  const double phase = frequency_ * time;
  return -frequency_ *
         (amplitude_ * std::sin(phase) + third_harmonic_ * (std::sin(phase) - 3.0 * std::sin(3.0 * phase)));
}

double cubic_separatrix() { return kSqrt6; }

double cubic_period_ratio(double amplitude) {
  const DefaultFloatingPoint environment;
  // The double nearest to sqrt(6) is below it.
  require(amplitude >= 0.0 && amplitude <= kSqrt6, "amplitude", amplitude, "0 <= A < sqrt(6)");
  const double gap = (kSqrt6 - amplitude) + kSqrt6Low;
  const double a = std::sqrt(std::fma(-amplitude / 12.0, amplitude, 1.0));
  const double b = std::sqrt(gap * (kSqrt6 + amplitude) / 6.0);
  return 1.0 / arithmetic_geometric_mean(a, b);
}

double linear_amplitude(double alpha, double angle, double velocity) {
  const DefaultFloatingPoint environment;
  require(alpha > 0.0 && std::isfinite(alpha), "alpha", alpha, "a positive number");
  require(std::isfinite(angle), "angle", angle, "a finite number");
  require(std::isfinite(velocity), "velocity", velocity, "a finite number");
  return std::hypot(angle, velocity / alpha);
}

}  // namespace strutt
