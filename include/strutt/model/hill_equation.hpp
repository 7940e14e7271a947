#pragma once

#include "strutt/model/periodic_function.hpp"

namespace strutt {

/// Hill's equation with damping, x'' + c x' + w(t) x = 0 with period T, held in canonical time theta = Omega
/// t, Omega = 2 pi/T:
///   X'' + (c/Omega) X' + W(theta) X = 0,   W = w/Omega^2,   W of period 2 pi.
/// For one harmonic W = delta + epsilon cos(theta - theta0). docs/conventions.md has the map to Mathieu's (a,
/// q).
struct HillEquation {
  double angular_frequency = 1.0;  ///< Omega > 0, in radians per unit of time
  double damping = 0.0;            ///< c >= 0, per unit of time
  PeriodicFunction coefficient;    ///< W(theta)
  /// Bound of the relative error of each coefficient of W against the inputs as given, from the roundings
  /// made on the way (0: the doubles are the inputs). Enters every error bound.
  double coefficient_error = 0.0;
  bool plain_kappa = false;  ///< kappa = Omega whatever the coefficient, as for systems

  double period() const;   ///< T = 2 pi/Omega
  double delta() const;    ///< mean of W
  double epsilon() const;  ///< amplitude of the first harmonic of W (square form: largest |W - delta|), >= 0
  double canonical_damping() const;  ///< c/Omega
  /// kappa/Omega with kappa = max(2 pi/T, sqrt|mean of w|), the frequency by which x' is made comparable with
  /// x; 1 with plain_kappa.
  double canonical_kappa() const;

  void validate() const;  ///< throws InvalidInput
};

/// x'' + damping x' + (delta + epsilon cos t) x = 0.
HillEquation mathieu_delta_epsilon(double delta, double epsilon, double damping = 0.0);

/// x'' + damping x' + (a - 2 q cos 2t) x = 0, period pi: Omega = 2, W = a/4 - (q/2) cos(theta).
HillEquation mathieu_a_q(double a, double q, double damping = 0.0);

/// x'' + damping x' + w(t) x = 0 with w as a function of the phase, in the same unit of time as `period`.
HillEquation hill_equation(double period, const PeriodicFunction& w, double damping = 0.0);

}  // namespace strutt
