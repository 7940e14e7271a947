#pragma once

#include <complex>
#include <vector>

#include "strutt/floquet/verdict.hpp"

namespace strutt {

/// A Floquet multiplier lambda = direction * exp(log_modulus), |direction| = 1: never overflows.
struct Multiplier {
  double log_modulus = 0.0;
  std::complex<double> direction = 1.0;
  double log_modulus_error = 0.0;  ///< first-order bound; +inf where multipliers collide
};

/// The two multipliers of a 2 x 2 monodromy in closed form, exp(-h) times those of N: on the unit circle
/// where |D| < 2, otherwise sign(D) exp(+-acosh(|D|/2)); the small one from Liouville's formula, never as a
/// difference (N2). By falling modulus, then positive imaginary part first.
std::vector<Multiplier> hill_multipliers(const DiscriminantGap& discriminant, double half_damping);

/// The multipliers of an n x n monodromy by LAPACK, same order. Those below 2^-53 of the largest have no
/// digit right; their log_modulus_error says so. Throws NumericalFailure if LAPACK does not converge.
std::vector<Multiplier> system_multipliers(const BoundedMatrix& matrix);

/// Margin and growth of an n-state system.
struct SystemStability {
  Margin margin;
  double growth = 0.0;
};

/// Reciprocal multipliers (mass and stiffness symmetric, damping c mass with c >= 0): with rho_j = lambda_j +
/// 1/lambda_j of y = exp(ct/2) q, margin = min_j [1 - |rho_j|/(2 cosh h)] if all rho_j are real, else
/// -growth; the margin is unresolved (value 0, error > 0) where two rho_j collide within their error. The
/// rho_j are the eigenvalues, each once, of N + N^-1 on an isotropic invariant subspace: well conditioned
/// where multipliers collide at +-1.
SystemStability reciprocal_stability(const BoundedMatrix& undamped, const Eigen::MatrixXd& mass,
                                     double half_damping);

/// Every other system: margin = -growth, growth = ln of the spectral radius.
SystemStability general_stability(const std::vector<Multiplier>& multipliers);

}  // namespace strutt
