#pragma once

#include "strutt/base/outcome.hpp"
#include "strutt/free_pendulum/planar_system.hpp"

namespace strutt {

/// The third-order normal form of a planar centre (paper, eq. 15)
///
///     z' = J z + |z|^2 [[delta, beta], [-beta, delta]] z + O(|z|^4),   J = [[0, alpha], [-alpha, 0]],
///
/// reached by y = z + g(z), g = g2 + g3 (eq. 18). In polar coordinates z = r (cos th, -sin th):
/// r' = delta r^3 and th' = alpha + beta r^2 (eqs. 16, 17). delta and beta in 1/time for dimensionless y.
struct NormalForm {
  double alpha = 0.0, delta = 0.0, beta = 0.0;
  double delta_error = 0.0, beta_error = 0.0;  ///< bounds of the rounding error (absolute)
  NonlinearTerms g1 = {}, g2 = {};             ///< the two components of g; the resonant part of g3 is zero
  Outcome outcome = Outcome::converged;        ///< non_finite if a result does not fit into double
};

/// Solves the homological equations order by order in w = z1 - i z2, where J is multiplication by i alpha: a
/// term w^j conj(w)^k is removed by h_jk = F_jk / (i alpha (j - k - 1)); only j = 2, k = 1 cannot be, and its
/// coefficient is delta + i beta. Coefficients are scaled first, so that nothing overflows on the way.
/// docs/normal-form.md. Throws InvalidInput unless alpha > 0 and all coefficients are finite.
NormalForm normal_form(const PlanarCoefficients& system);

/// The normal form of x' = A x + f(x) by way of jordan_form. The error bounds start from its rounded
/// coefficients.
NormalForm normal_form(const PlanarSystem& system);

/// Period in a normal form without decay: T = 2 pi/(alpha + beta r^2), r the amplitude of z (paper, eq. 22).
/// Infinite where the frequency is not positive: there the formula has no meaning. Throws InvalidInput unless
/// r >= 0.
double normal_form_period(const NormalForm& form, double r);

}  // namespace strutt
