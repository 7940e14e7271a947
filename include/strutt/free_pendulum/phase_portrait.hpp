#pragma once

#include <numbers>
#include <string_view>
#include <vector>

namespace strutt {

/// What a curve of a phase portrait is.
enum class CurveKind : signed char {
  libration,    ///< closed about a hanging position (at the edge of a window of even width: the half inside)
  rotation,     ///< from one end of the window to the other
  separatrix,   ///< from one inverted position to the next (or to the edge of the window)
  equilibrium,  ///< one point
  section,      ///< stroboscopic sections of an excited motion (stroboscopic_portrait.hpp)
};

inline constexpr int kCurveKindCount = 5;

/// The name as written to files: `libration`, `rotation`, ...
std::string_view to_string(CurveKind kind);

/// A point of the phase plane.
struct PhasePoint {
  double angle = 0.0;     ///< phi, rad, from the hanging position
  double velocity = 0.0;  ///< phi', rad/s
};

struct PhaseCurve {
  CurveKind kind = CurveKind::libration;
  /// E = C1 - 2 = (phi'/alpha)^2 - 4 cos^2(phi/2), C1 the paper's first integral (9). Of a section curve: at
  /// its start.
  double separatrix_excess = 0.0;
  std::vector<PhasePoint> points;  ///< in order of time
};

/// Which level curves, over which window.
struct PortraitOptions {
  double alpha = 1.0;  ///< eigenfrequency of small oscillations, rad/s, > 0 and finite
  int cells = 3;       ///< width of the window |phi| <= cells pi in periods of 2 pi, 1 <= cells <= 1000
  /// Of a whole closed curve, and of a period of 2 pi of the others, both ends counted; rounded up to 4 n
  /// + 1. >= 9.
  int points = 201;
  /// Amplitudes of librations, rad, 0 < amplitude < pi.
  std::vector<double> amplitudes = default_amplitudes();
  /// Further levels by their excess, finite: -4 < E < 0 librations, E > 0 rotations in both directions.
  std::vector<double> excesses = default_excesses();

  static std::vector<double> default_amplitudes();  ///< j pi/8, j = 1 ... 7
  static std::vector<double> default_excesses();  ///< (j/2)^2, j = 1 ... 3: |phi'/alpha| = j/2 when inverted

  void validate() const;  ///< throws InvalidInput
};

/// Half the width of a window, rad.
inline double window_half_width(int cells) { return cells * std::numbers::pi; }

/// Level curves of the free pendulum phi'' = -alpha^2 sin(phi) (paper, eqs. 8 and 9, Fig. 2) in the window:
/// the equilibria k pi, both branches of the separatrix, the librations about every 2 pi k (smallest
/// amplitude first) and the rotations of every level, in this order.
///
/// The points come from closed forms without differences of near numbers. With k = sin(A/2), k' = cos(A/2)
/// and s the distance from the turning point in the auxiliary angle,
///   libration:  phi/2 = atan2(k cos s, sqrt(k'^2 + k^2 sin^2 s)),  phi'/alpha = 2 k sin s;
///   rotation:   phi'/alpha = +-sqrt(E + 4 sin^2(x/2)), x the distance from the inverted position;
///   separatrix: phi'/alpha = +-2 sin(x/2).
/// They lie on their level within the rounding of the angle (2 ulp) and of the velocity (4 ulp).
///
/// On every curve the points follow each other at equal arc length in the plane (phi, phi'/alpha), to 1e-14
/// of the length of the curve within a period of 2 pi. Closed curves repeat their first point bit by bit; a
/// rotation repeats itself from period to period, shifted by 2 pi. Cost: some microseconds for a point of one
/// cell. Throws InvalidInput.
std::vector<PhaseCurve> phase_portrait(const PortraitOptions& options = {});

}  // namespace strutt
