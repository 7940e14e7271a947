#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>

#include "strutt/floquet/multipliers.hpp"

namespace strutt {

/// rho = lambda + 1/lambda of a pair of multipliers, in units of 2^exponent, with a bound.
struct MultiplierSum {
  std::complex<double> value;
  double error = 0.0;
};

/// Margin and growth as in reciprocal_stability, from all rho. `collision`: whether two of them cannot be
/// told apart, so that a complex pair may be two real ones, and the other way round.
SystemStability stability_of(std::span<const MultiplierSum> sums, bool collision, long exponent,
                             double half_damping);

/// A propagator with four states in canonical coordinates (q, mass q'), blocks of two rows and columns, with
/// bounds; in units of 2^exponent.
struct SymplecticBlocks {
  Eigen::Matrix2d a, b, c, d, a_error, b_error, c_error, d_error;
};

/// reciprocal_stability in closed form. N + N^-1 = [P, beta J; gamma J, P^T] with P = A + D^T, beta J = B -
/// B^T, gamma J = C - C^T has the two eigenvalues rho = (p11 + p22)/2 +- sqrt(Delta),
///   Delta = ((p11 - p22)/2)^2 + p12 p21 - beta gamma,
/// which are the roots of rho^2 - a rho + b - 2 for the characteristic polynomial x^4 - a x^3 + b x^2 - a x +
/// 1, without its cancellation.
SystemStability reciprocal_stability(const SymplecticBlocks& n, long exponent, double half_damping);

}  // namespace strutt
