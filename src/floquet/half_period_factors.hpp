#pragma once

#include <array>

#include "strutt/floquet/verdict.hpp"

namespace strutt {

/// The propagator of Y'' + W Y = 0 over half a period from a point about which W is even, [u1, u2; u1', u2']
/// times 2^exponent, with bounds. Order: u1, u2, u1', u2'.
struct HalfPeriodFactors {
  std::array<double, 4> value{}, error{};
  long exponent = 0;
};

/// As for a Monodromy with `half`. The unit of u2 and 1/u1' does not matter.
DiscriminantGap discriminant_gap(const HalfPeriodFactors& factors);

/// The quadrant 0 ... 3 of the angle of (v, y), counted from the v axis.
inline int sign_quadrant(double y, double v) {
  if (y > 0.0) return v > 0.0 ? 0 : 1;
  return v < 0.0 ? 2 : 3;
}

/// floor(q) of the angle q of (u2', u2) in quarter turns, from an estimate of q that is less than two quarter
/// turns away: the signs of u2 and u2' tell the rest.
double quadrant(const HalfPeriodFactors& factors, double quarter_turns);

/// The winding number (floquet/winding.hpp). The quadrant counts the edges b_n of tongues that lie below,
/// which is n between the tongues n and n + 1, and n or n - 1 inside tongue n, where the sign of D gives the
/// parity. Between tongues sin^2(pi winding) = -u1' u2 and cos^2(pi winding) = u1 u2'.
double winding_number(const HalfPeriodFactors& factors, const DiscriminantGap& discriminant, double quadrant);

}  // namespace strutt
