#include "strutt/floquet/winding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace strutt {
namespace {

using std::numbers::pi;
constexpr double kMostSteps = 4e6;

/// Angle, in the plane (V, Y) from the V axis towards Y, through which (Y, V = Y'/kappa) turns from (0, 1) in one period,
/// with W replaced by its values at the middle of `steps` equal parts.
double turned_angle(const PeriodicFunction& w, double kappa, int steps) {
  const double h = 2.0 * pi / steps;
  double y = 0.0, v = 1.0, angle = 0.0;
  for (int j = 0; j < steps; ++j) {
    const double value = w((j + 0.5) * h);
    const double s = std::sqrt(std::abs(value)), x = s * h;
    // w > 0 turns by x < pi; w < 0 turns by less than half a turn, whatever x: overflow is avoided by leaving out exp(x)
    const double c = value > 0.0 ? std::cos(x) : 0.5 * (1.0 + std::exp(-2.0 * x));
    const double z = s == 0.0 ? h : (value > 0.0 ? std::sin(x) : -0.5 * std::expm1(-2.0 * x)) / s;
    const double next_y = c * y + kappa * z * v;
    const double next_v = -value * z / kappa * y + c * v;
    angle += std::atan2(next_y * v - next_v * y, next_y * y + next_v * v);
    const double size = std::hypot(next_y, next_v);
    y = next_y / size;
    v = next_v / size;
  }
  return angle;
}

/// The angle of N (0, 1) without its ambiguity of whole turns, or NaN.
double lifted_angle(const PeriodicFunction& w, const BoundedMatrix2& undamped, double kappa) {
  const auto& n = undamped.value.mantissa;
  const double end = std::atan2(n(0, 1), n(1, 1));
  double steps = std::max(64.0, std::max(32.0 * w.highest_order(), std::ceil(2.0 * pi * std::sqrt(w.bound()))));
  for (; steps <= kMostSteps; steps *= 4.0) {
    const double estimate = turned_angle(w, kappa, static_cast<int>(steps));
    const double lifted = end + 2.0 * pi * std::round((estimate - end) / (2.0 * pi));
    if (std::abs(lifted - estimate) < pi / 2.0) return lifted;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double winding_number(const PeriodicFunction& w, const BoundedMatrix2& undamped, const DiscriminantGap& d,
                      double kappa) {
  const double half_turns = lifted_angle(w, undamped, kappa) / pi;
  if (!std::isfinite(half_turns)) return std::numeric_limits<double>::quiet_NaN();
  if (d.gap <= 0.0) {  // in tongue n the vector is less than a half turn away from n half turns; the sign of D gives the parity
    const double parity = d.sign > 0 ? 0.0 : 1.0;
    return 0.5 * (parity + 2.0 * std::round((half_turns - parity) / 2.0));
  }
  // stable: no direction is invariant, so all vectors, and the mean, lie between the same two half turns
  const double whole = std::floor(half_turns);
  const double cosine = d.sign * (1.0 - 0.5 * d.gap);  // D/2
  const double sine = std::sqrt(0.5 * d.gap * (2.0 - 0.5 * d.gap));
  const double direction = std::fmod(whole, 2.0) == 0.0 ? 1.0 : -1.0;
  return 0.5 * whole + std::atan2(sine, direction * cosine) / (2.0 * pi);
}

}  // namespace strutt
