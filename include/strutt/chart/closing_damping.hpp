#pragma once

#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/chart/tongues.hpp"

namespace strutt {

/// The damping that closes a tongue on a line.
struct ClosingDamping {
  int tongue = 0;
  int crossing = 0;       ///< which time the line meets this tongue, from 0
  double damping = 0.0;   ///< c of x'' + c x' + ...: with less, somewhere there the tongue is open
  double error = 0.0;     ///< bound of the relative error of `damping`, as far as the growth is known
  double position = 0.0;  ///< where the tongue stays open longest: its tip, or an end of the line
  Method method = Method::propagator;
  Outcome outcome = Outcome::converged;
};

/// For each crossing of a tongue n >= 1 with both edges on the line: the largest c at which some point of the
/// line, next to it, is marginal in this tongue, whatever damping the scene has. With c the multipliers of
/// the undamped Y'' + (W - (c/Omega)^2/4) Y = 0, whose winding is n/2, are divided by exp(cT/2); the point is
/// marginal where growth = cT/2. From each maximum of the growth between the undamped edges, 15 points of
/// which are looked at, two steps follow each other: to the place next to it where the tongue stands most
/// more damping, which may lie beyond these edges, and to the damping that closes it there. Either squares
/// the distance from the tip; the error is that of the margin. Where it is smaller, the error is that of
///   c = 2 growth/T
/// with the growth of the undamped tongue in its middle (narrow_tongue_growth): for tongues narrower than
/// some 1e-5 of the distance to the next one. The worst error, between both, is about 1e-9; under excitation
/// so strong that tongues follow each other within a rounding (epsilon = 100 of Mathieu's equation) it is
/// larger. `outcome` is converged up to 1e-8 or the tolerance. No damping closes tongue 0. `options` as of
/// tongues(), whose `count` counts tongue 0. Throws as tongues(), and for a line along the damping.
std::vector<ClosingDamping> closing_damping(const Scene& scene, const TongueLine& line,
                                            const TongueOptions& options = {});

}  // namespace strutt
