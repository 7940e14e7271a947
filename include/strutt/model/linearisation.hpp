#pragma once

#include <optional>

#include "strutt/model/excitation.hpp"
#include "strutt/model/hill_equation.hpp"
#include "strutt/model/pendulum.hpp"

namespace strutt {

/// Equation (7) linearised about an equilibrium, with x the deviation from it:
///   x'' + c x' + w(t) x = f(t),   w = +-alpha^2 (1 + r''/g)  (+ hanging, - inverted),   f = M/Theta.
struct LinearisedPendulum {
  HillEquation equation;                    ///< the homogeneous part, which decides stability
  std::optional<PeriodicFunction> forcing;  ///< f as a function of the phase, 1/s^2; absent without a moment
};

/// Without `support` the phase is alpha t (period T0); otherwise it is that of the support, whatever its
/// amplitude. In canonical time, W = +-(alpha^2/omega^2 + (alpha^2/g) d^2 r/dtheta^2): formed term by term,
/// without cancellation for fast and slow supports (numerical extremes N12, N13). `moment` must have the
/// frequency of the support if both are given. Throws InvalidInput.
LinearisedPendulum linearise(const PhysicalPendulum& pendulum, Equilibrium about, const Excitation* support,
                             const Excitation* moment = nullptr);

}  // namespace strutt
