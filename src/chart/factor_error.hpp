#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"

namespace strutt {

/// How factors at a point turn into the error of M there: the size 2^(2 exponent) of M's unit, and the
/// point's damping.
struct FactorScale {
  double square = 1.0;  ///< 2^(2 exponent), possibly inf
  double half_damping = 0.0;
  double decay = 1.0;  ///< exp(-half_damping)
  double slope = 0.0;  ///< c/(2 kappa) in canonical time, see restore_damping
  /// The factors are seen from another phase than 0: M from there is not the one from 0, of which only the
  /// trace is known, and that its entries are at least half as large.
  bool shifted = false;

  FactorScale(long exponent, double h, double kappa, bool from_elsewhere)
      : square(std::ldexp(1.0, static_cast<int>(std::clamp(2 * exponent, -5000L, 5000L)))),
        half_damping(h),
        decay(h == 0.0 ? 1.0 : std::exp(-h)),
        slope(0.5 * h / (std::numbers::pi * kappa)),
        shifted(from_elsewhere) {}
};

/// Monodromy::error of M = exp(-h) L N L^-1, N = [u1 u2' + u1' u2, 2 u2 u2'; 2 u1 u1', same], from factors
/// with bounds, in the state scaled by the point's kappa. Order: u1, u2, u1', u2'. If shifted, not less than
/// the same of the trace alone, relative to M from 0.
inline double monodromy_error(const std::array<double, 4>& f, const std::array<double, 4>& e,
                              const FactorScale& scale) {
  const auto product_error = [&](std::size_t i, std::size_t j) {
    return std::abs(f[i]) * e[j] + std::abs(f[j]) * e[i] + e[i] * e[j] + 2.0 * kUnit * std::abs(f[i] * f[j]);
  };
  const double a = f[0] * f[3] + f[2] * f[1], b = 2.0 * f[1] * f[3], g = 2.0 * f[0] * f[2];
  const double ea = product_error(0, 3) + product_error(2, 1), eb = 2.0 * product_error(1, 3),
               eg = 2.0 * product_error(0, 2);
  const double s = scale.slope;
  double largest_error = std::max({2.0 * ea, eb, eg}),
         largest = std::max({std::abs(a), std::abs(b), std::abs(g)});
  if (s != 0.0) {
    largest_error = std::max({2.0 * (ea + s * eb), eb, eg + 2.0 * s * ea + s * s * eb});
    const double size = std::max({std::abs(a) + s * std::abs(b), std::abs(g) + s * s * std::abs(b)});
    largest_error += (8.0 + 4.0 * scale.half_damping) * kUnit * std::max(size, std::abs(b));
    largest = std::max({std::abs(a + s * b), std::abs(b), std::abs(g - s * s * b), std::abs(a - s * b)});
  }
  const double unit = scale.square * scale.decay;
  const auto relative = [unit](double error, double size) {
    return size * unit > 1.0 ? error / size : error * unit;
  };
  const double error = relative(largest_error, largest) + 4.0 * kUnit;
  if (!scale.shifted) return error;
  return std::max(error, relative(2.0 * ea, std::abs(a)) + (8.0 + 4.0 * scale.half_damping) * kUnit);
}

}  // namespace strutt
