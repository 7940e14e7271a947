#include "floquet/turned_angle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace strutt {
namespace {

using std::numbers::pi;
constexpr double kMostAngleSteps = 4e6;

/// The angle with W replaced by its values at the middle of `steps` equal parts. Y passes zero at most once a
/// step and only forwards, so that half turns are sign changes.
double turned_angle(const PeriodicFunction& w, double length, double kappa, int steps) {
  const double h = length / steps;
  double y = 0.0, v = 1.0, half_turns = 0.0, sign = 1.0;
  for (int j = 0; j < steps; ++j) {
    const double value = w((j + 0.5) * h);
    const double s = std::sqrt(std::abs(value)), x = s * h;
    // w > 0 turns by x < pi; w < 0 turns by less than half a turn, whatever x: overflow is avoided by leaving
    // out exp(x)
    const double c = value > 0.0 ? std::cos(x) : 0.5 * (1.0 + std::exp(-2.0 * x));
    const double z = s == 0.0 ? h : (value > 0.0 ? std::sin(x) : -0.5 * std::expm1(-2.0 * x)) / s;
    const double next_y = c * y + kappa * z * v;
    const double next_v = -value * z / kappa * y + c * v;
    if (next_y * sign < 0.0) {
      half_turns += 1.0;
      sign = -sign;
    }
    const double size = std::abs(next_y) + std::abs(next_v);
    y = next_y / size;
    v = next_v / size;
  }
  return pi * half_turns + std::atan2(sign * y, sign * v);
}

}  // namespace

double lifted_angle(const PeriodicFunction& w, double length, double y, double v, double kappa) {
  const double end = std::atan2(y, v);
  const double share = length / (2.0 * pi);
  double steps =
      std::ceil(std::max({64.0 * share, 32.0 * share * w.highest_order(), length * std::sqrt(w.bound())}));
  for (; steps <= kMostAngleSteps; steps *= 4.0) {
    const double estimate = turned_angle(w, length, kappa, static_cast<int>(steps));
    const double lifted = end + 2.0 * pi * std::round((estimate - end) / (2.0 * pi));
    if (std::abs(lifted - estimate) < pi / 2.0) return lifted;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace strutt
