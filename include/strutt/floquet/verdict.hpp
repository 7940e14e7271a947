#pragma once

#include <string_view>

#include "strutt/floquet/monodromy.hpp"

namespace strutt {

/// Whether all solutions stay bounded. `boundary` only where equality is proved; `unresolved` exactly when
/// |margin| <= margin_error without such a proof.
enum class Verdict : signed char { stable, unstable, boundary, unresolved };
inline constexpr int kVerdictCount = 4;

/// The name as written to files.
std::string_view to_string(Verdict verdict);

/// Signed distance from the edge of stability: positive stable, negative unstable.
struct Margin {
  double value = 0.0;
  double error = 0.0;  ///< bound of |value - true margin|; 0 with value 0: equality is proved
};

/// unresolved if |value| <= error (unless both are 0: boundary) or the margin is NaN.
Verdict verdict_of(const Margin& margin);

/// The margins never go below this; their error is then 0.
inline constexpr double kLowestMargin = -1e300;

/// Half the distance of the discriminant D = trace N (det N = 1) from 2: 2 - |D|, with the sign of D, formed
/// so that nothing cancels at the edge |D| = 2:
///   even coefficient   2 - |D| = -4 u1' u2 (D > 0),  4 u1 u2' (D < 0): simple zeros of single factors,
///   otherwise          2 - |D| = -4 [((n11 - n22)/2)^2 + n12 n21]/(2 + |D|) where that is sharper than 2 -
///   |trace|.
struct DiscriminantGap {
  double gap = 0.0;  ///< 2 - |D|, possibly -inf
  double gap_error = 0.0;
  int sign = 1;          ///< of D
  double log_abs = 0.0;  ///< ln |D|
  double log_abs_error = 0.0;
};
DiscriminantGap discriminant_gap(const HillMonodromy& monodromy);

/// margin = 1 - |D|/(2 cosh h) of a 2 x 2 monodromy with det N = 1 and h = cT/2 >= 0:
/// (2 - |D| + 4 sinh^2(h/2))/(2 cosh h), in logarithms where these overflow. Bounds: those of
/// discriminant_gap, the rounding of h included.
Margin hill_margin(const DiscriminantGap& discriminant, double half_damping);

/// ln of the spectral radius of M per period, acosh(|D|/2) - h (or -h for |D| <= 2), with the sign of
/// -margin.
double hill_growth(const DiscriminantGap& discriminant, double half_damping);

}  // namespace strutt
