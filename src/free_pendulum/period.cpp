#include "strutt/free_pendulum/period.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/constants.hpp"
#include "free_pendulum/agm.hpp"
#include "free_pendulum/period_table.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

// What twice the working precision leaves to a rounding.
constexpr double kRounded = 1.001 * kUnit;
// 0.8 ulp are at most 1.6 units of 2^-53.
constexpr double kTableError = 1.6 * kUnit;

DoubleDouble sum_of(const Eigenfrequency& alpha) { return {alpha.value, alpha.rest}; }

/// `ratio_error` is relative.
/// Relative error of a number whose last parts may lie below the subnormal doubles; 4 for 0.
double underflow_error(double value) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  return value < 1e-290 ? 4.0 * kLeast / std::max(value, kLeast) : 0.0;
}

Period period_of(double ratio, double ratio_error, const Eigenfrequency& alpha) {
  alpha.validate();
  if (std::isinf(ratio)) return {ratio, ratio, ratio, 0.0, PeriodMethod::separatrix};
  double period = (DoubleDouble(ratio) * kTwoPi / sum_of(alpha)).hi;
  if (!std::isfinite(period)) period = std::numeric_limits<double>::infinity();  // alpha below 1e-307
  return {ratio, period, 0.25 * period, ratio_error + kRounded + underflow_error(0.25 * period),
          PeriodMethod::elliptic};
}

BoundedNumber rounded(DoubleDouble value) { return {value.hi, kRounded + underflow_error(value.hi)}; }

/// sqrt(4 + E).
DoubleDouble bottom_velocity(double excess) { return sqrt(two_sum(4.0, excess)); }

/// Solves R(m) = ratio, m = k^2, by Newton's method; R is convex and the start too large, so that it descends
/// to m.
DoubleDouble squared_modulus_of(double ratio) {
  constexpr double kMost = 0.95;  // R = 1.85
  constexpr int kSteps = 12;      // quadratic from the first one on; 7 are needed
  DoubleDouble m = std::fmin(4.0 * (ratio - 1.0), kMost);
  for (int i = 0; i < kSteps && m.hi > 0.0; ++i) {
    const DoubleDouble k_prime = sqrt(DoubleDouble(1.0) - m);
    const AgmSteps agm(1.0, k_prime);
    const DoubleDouble value = DoubleDouble(1.0) / agm.mean();
    const DoubleDouble slope = value * (DoubleDouble(0.5) - agm.gap_sum()) / (DoubleDouble(1.0) - m);
    m = m - (value - DoubleDouble(ratio)) / ldexp(slope, -1);
  }
  return m;
}

/// Solves R(k') = ratio for ln k', in which R is nearly straight: R = (2/pi) ln(4/k') + O(k'^2 ln k').
DoubleDouble complementary_modulus_of(double ratio) {
  constexpr int kSteps = 8;
  DoubleDouble k_prime = 4.0 * std::exp(-0.5 * kPi.hi * ratio);
  for (int i = 0; i < kSteps; ++i) {
    const AgmSteps agm(1.0, k_prime);
    const DoubleDouble value = DoubleDouble(1.0) / agm.mean();
    const DoubleDouble slope = value * (DoubleDouble(0.5) - agm.gap_sum());
    const double step = ((value - DoubleDouble(ratio)) / slope).hi;
    k_prime = k_prime + k_prime * DoubleDouble(std::expm1(step));
  }
  return k_prime;
}

void check_amplitude(double amplitude) {
  require(amplitude >= 0.0 && amplitude <= kPi.hi, "amplitude", amplitude, "from 0 to 3.141592653589793");
}

}  // namespace

std::string_view to_string(PeriodMethod method) {
  constexpr std::array<std::string_view, 6> names{"elliptic", "separatrix",     "normal_form",
                                                  "krylov",   "krylov_squared", "series"};
  return names[static_cast<std::size_t>(method)];
}

Period period_of_amplitude(double amplitude, const Eigenfrequency& alpha) {
  const DefaultFloatingPoint environment;
  check_amplitude(amplitude);
  return period_of(period_ratio(amplitude), kTableError, alpha);
}

Period period_of_from_top(double from_top, const Eigenfrequency& alpha) {
  const DefaultFloatingPoint environment;
  require(from_top >= 0.0 && from_top <= kPi.hi, "from_top", from_top, "from 0 to pi");
  return period_of(period_ratio_from_top(from_top), kTableError, alpha);
}

Period period_of_excess(double separatrix_excess, const Eigenfrequency& alpha) {
  const DefaultFloatingPoint environment;
  const double e = separatrix_excess;
  require(e >= -4.0 && std::isfinite(e), "separatrix_excess", e, "finite and >= -4");
  if (e == 0.0) return period_of(std::numeric_limits<double>::infinity(), 0.0, alpha);
  const DoubleDouble top = sqrt(DoubleDouble(std::abs(e)));
  const AgmSteps agm = e < 0.0 ? AgmSteps(1.0, ldexp(top, -1)) : AgmSteps(bottom_velocity(e), top);
  return period_of((DoubleDouble(1.0) / agm.mean()).hi, kRounded, alpha);
}

BoundedNumber period_ratio_slope_magnitude(double separatrix_excess) {
  const DefaultFloatingPoint environment;
  const double e = separatrix_excess;
  require(e >= -4.0 && e != 0.0 && std::isfinite(e), "separatrix_excess", e, "finite, >= -4 and not 0");
  const DoubleDouble top = sqrt(DoubleDouble(std::abs(e)));
  if (e < 0.0) {
    const AgmSteps agm(1.0, ldexp(top, -1));
    const DoubleDouble bracket = DoubleDouble(0.5) - agm.gap_sum();
    return rounded(bracket / agm.mean() / ldexp(top, 1) / top);  // -E = top^2 = 4 k'^2
  }
  const DoubleDouble bottom = bottom_velocity(e);
  const AgmSteps agm(1.0, top / bottom);
  const DoubleDouble k_squared = DoubleDouble(4.0) / bottom / bottom;
  const DoubleDouble second = DoubleDouble(1.0) - k_squared * (DoubleDouble(0.5) + agm.gap_sum());
  return rounded(second / agm.mean() / bottom / top / ldexp(top, 1));
}

LibrationOfPeriod libration_of_period_ratio(double ratio) {
  const DefaultFloatingPoint environment;
  constexpr double kLongest = 440.0;  // from_top = 4e-300
  require(ratio >= 1.0 && ratio <= kLongest, "ratio", ratio, "from 1 to 440");
  constexpr double kStraight = 1.5;
  constexpr double kError = 0x1p-52;
  const bool near_top = ratio > kStraight;
  const DoubleDouble one = 1.0;
  const DoubleDouble m = near_top ? DoubleDouble() : squared_modulus_of(ratio);
  const DoubleDouble k_prime = near_top ? complementary_modulus_of(ratio) : sqrt(one - m);
  const DoubleDouble k = near_top ? sqrt((one - k_prime) * (one + k_prime)) : sqrt(m);
  return {2.0 * atan2(k, k_prime).hi, 2.0 * atan2(k_prime, k).hi, kError};
}

namespace {

constexpr double kShort = 1e-150;

/// Time to an angle below kShort, passed with the velocity at the bottom: F(psi) = psi. Scaled, so that no
/// low part underflows.
BoundedNumber short_flight(double angle, DoubleDouble bottom, const Eigenfrequency& alpha) {
  constexpr int kScale = 500;
  const DoubleDouble scaled = std::ldexp(angle, kScale);
  return rounded(ldexp(scaled / bottom / sum_of(alpha), -kScale));
}

}  // namespace

BoundedNumber libration_time_of_flight(double amplitude, double angle, const Eigenfrequency& alpha) {
  const DefaultFloatingPoint environment;
  check_amplitude(amplitude);
  require(angle >= 0.0 && angle <= amplitude, "angle", angle, "from 0 to the amplitude");
  alpha.validate();
  if (angle == 0.0) return {0.0, 0.0};
  constexpr double kSmall = 1e-100;
  if (amplitude < kSmall) {  // no matter how small: the oscillation is harmonic
    const int scale = -std::ilogb(amplitude) - 300;
    return libration_time_of_flight(std::ldexp(amplitude, scale), std::ldexp(angle, scale), alpha);
  }
  const auto turning = sin_cos(0.5 * amplitude);
  if (angle < kShort) return short_flight(angle, ldexp(turning.sine, 1), alpha);
  const AgmSteps agm(1.0, turning.cosine);
  // sin^2(A/2) - sin^2(phi/2) = sin((A - phi)/2) sin((A + phi)/2)
  const DoubleDouble below = sin_cos(ldexp(two_sum(amplitude, -angle), -1)).sine;
  const DoubleDouble above = sin_cos(ldexp(two_sum(amplitude, angle), -1)).sine;
  const DoubleDouble cotangent = sqrt(below) * sqrt(above) / sin_cos(0.5 * angle).sine;
  return rounded(kTwoPi / agm.mean() / sum_of(alpha) * agm.turns_of(cotangent));
}

BoundedNumber rotation_time_of_flight(double separatrix_excess, double angle, const Eigenfrequency& alpha) {
  const DefaultFloatingPoint environment;
  const double e = separatrix_excess;
  constexpr double kFurthest = 1e9;
  require(e > 0.0 && std::isfinite(e), "separatrix_excess", e, "finite and > 0");
  require(angle >= 0.0 && angle <= kFurthest, "angle", angle, "from 0 to 1e9");
  alpha.validate();
  if (angle == 0.0) return {0.0, 0.0};
  const DoubleDouble bottom = bottom_velocity(e);
  if (angle < kShort) return short_flight(angle, bottom, alpha);
  const AgmSteps agm(1.0, sqrt(DoubleDouble(e)) / bottom);
  const auto [count, half] = half_turns(0.5 * angle);
  const double sign = half.sine.hi < 0.0 ? -1.0 : 1.0;
  const DoubleDouble rest = DoubleDouble(sign) * agm.turns_of(half.cosine / abs(half.sine));
  const DoubleDouble phase = DoubleDouble(0.5 * count) + rest;
  return rounded(ldexp(kTwoPi, 1) / agm.mean() / bottom / sum_of(alpha) * phase);
}

}  // namespace strutt
