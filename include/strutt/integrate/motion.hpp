#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/integrate/integrator.hpp"
#include "strutt/model/excitation.hpp"
#include "strutt/model/linearisation.hpp"
#include "strutt/model/pendulum.hpp"

namespace strutt {

/// Where a motion starts, at t = 0.
struct MotionStart {
  double angle = 0.0;     ///< rad, from the hanging position, |angle| <= 1e9
  double velocity = 0.0;  ///< rad/s
};

/// What is wanted of a motion.
struct MotionOptions {
  double tolerance = 1e-9;                   ///< largest `error` wanted, rad, 1e-13 <= tolerance <= 1e-2
  Method method = Method::automatic;         ///< automatic (= arkode), arkode, cvode
  bool linear = false;                       ///< sin(angle) becomes angle (hanging) or pi - angle (inverted)
  Equilibrium about = Equilibrium::hanging;  ///< for `linear`
  long max_steps = 20'000'000;               ///< budget of integration steps, all runs together, >= 1
  const std::atomic<bool>* cancel = nullptr;

  void validate() const;  ///< throws InvalidInput
};

/// The state at one time. Where nothing was reached the values are NaN and `error` is +inf.
struct MotionPoint {
  double t = 0.0;         ///< s, as asked for
  double angle = 0.0;     ///< rad, unwrapped
  double velocity = 0.0;  ///< rad/s
  /// (phi'/alpha)^2 - 4 cos^2(phi/2), the paper's first integral (9) less 2: negative libration, positive
  /// rotation.
  double energy = 0.0;
  double error = 0.0;  ///< bound of |angle - true angle| for the inputs as given, rad
  Outcome outcome = Outcome::converged;
};

/// A time series and what it cost.
struct Motion {
  std::vector<MotionPoint> points;  ///< in the order of the times asked for
  Method method = Method::automatic;
  IntegrationCost cost;           ///< of the runs that gave the values
  IntegrationCost estimate_cost;  ///< of those that gave the errors
  bool cancelled = false;
};

/// Integrates (7),
///   phi'' + c phi' + alpha^2 (1 + r''(t)/g) sin(phi) = M(t)/Theta,
/// from `start` at t = 0 to every one of `times` (s, >= 0, finite, any order).
///
/// Time is the phase of the excitation (alpha t without one), counted in whole turns and a rest, and the
/// angle is the nearest multiple of pi and a rest: neither a late time nor many rotations nor a start next to
/// the upper equilibrium costs digits. The error bound adds up, piece by piece of the phase, the difference
/// to a second run by another formula and the rounding, carried along by the variational equation (numerical
/// extremes N16, N20, N34); it becomes +inf where the motion is too sensitive for any bound. The local
/// tolerance is tightened while a bound is above the tolerance. `support` and `moment` may be null; if both
/// are given (and the moment is not constant) their frequencies must be equal. Throws InvalidInput for
/// misuse; numerical trouble, an exhausted budget and cancellation are outcomes of the points.
Motion integrate_motion(const PhysicalPendulum& pendulum, const Excitation* support, const Excitation* moment,
                        const MotionStart& start, std::span<const double> times,
                        const MotionOptions& options = {});

}  // namespace strutt
