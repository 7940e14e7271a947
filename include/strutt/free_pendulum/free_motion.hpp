#pragma once

#include <atomic>
#include <memory>
#include <span>

#include "strutt/free_pendulum/eigenfrequency.hpp"
#include "strutt/free_pendulum/energy.hpp"
#include "strutt/integrate/motion.hpp"

namespace strutt {

/// A state of a free motion.
struct FreeState {
  double angle = 0.0;     ///< rad, unwrapped; NaN where the phase is beyond double
  double velocity = 0.0;  ///< phi', rad/s; NaN likewise
  /// Bound of |angle - true angle| for the inputs taken as exact, rad. From pi on the phase is unresolved:
  /// any point of the orbit is as good; +inf where nothing is known.
  double error = 0.0;
};

/// The motion of the free pendulum phi'' + alpha^2 sin(phi) = 0 through (phi0, phi0') at t = 0, in closed
/// form:
///   libration:  sin(phi/2) = k sn, cos(phi/2) = dn, phi'/alpha = 2 k cn at u = alpha (t - t0),
///   rotation:   sin(phi/2) = sn, cos(phi/2) = cn, |phi'|/alpha = w dn at u = w alpha (t - t0)/2, k = 2/w,
///   separatrix: phi = 2 gd(alpha (t - t0)),
/// with w = sqrt(4 + E) the velocity at the bottom. The phase is kept in turns in twice the working
/// precision: neither late times (1e-13 rad at 1e16 periods, beyond 2^53 turns) nor small amplitudes nor a
/// start next to the separatrix cost digits (numerical extremes N27-N31). The error is that of the last
/// roundings, 4 2^-53 |phi| and the like, as long as the orbit is told from the separatrix; it grows where an
/// excess that is only known to 1e-30 begins to matter.
class FreeMotion {
 public:
  /// angle in rad, |angle| <= 1e9; velocity phi0' in rad/s, finite. Throws InvalidInput.
  FreeMotion(const Eigenfrequency& alpha, double angle, double velocity);

  const EnergyIntegral& energy() const;

  /// Any finite time, also negative (throws InvalidInput for the others). About 3 microseconds.
  FreeState at(double t) const;

 private:
  struct Orbit;
  std::shared_ptr<const Orbit> orbit_;
};

/// The motion at every one of `times` (s, >= 0, finite, any order), with method `exact` and no cost: the
/// counterpart of integrate_motion. Points whose error is above `tolerance` (rad, > 0) are
/// `tolerance_not_reached`. Throws InvalidInput.
Motion free_motion(const Eigenfrequency& alpha, const MotionStart& start, std::span<const double> times,
                   double tolerance = 1e-9, const std::atomic<bool>* cancel = nullptr);

}  // namespace strutt
