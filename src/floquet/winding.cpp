#include "strutt/floquet/winding.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "floquet/turned_angle.hpp"

namespace strutt {

using std::numbers::pi;

double winding_number(const PeriodicFunction& w, const BoundedMatrix2& undamped, const DiscriminantGap& d,
                      double kappa) {
  const auto& n = undamped.value.mantissa;
  const double half_turns = lifted_angle(w, 2.0 * pi, n(0, 1), n(1, 1), kappa) / pi;
  if (!std::isfinite(half_turns)) return std::numeric_limits<double>::quiet_NaN();
  if (d.gap <= 0.0) {  // in tongue n the vector is less than a half turn away from n half turns; the sign of
                       // D gives the parity
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
