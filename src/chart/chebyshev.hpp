#pragma once

#include <Eigen/Core>
#include <span>

/// Chebyshev interpolation on [-1, 1] in the extreme points t_j = cos(pi j/n), j = 0 ... n.
namespace strutt::chebyshev {

double point(int j, int n);
double point(int j, int n, double low, double high);  ///< of [low, high]

/// (n + 1) x (n + 1): from values at the points to the coefficients of T_0 ... T_n (a discrete cosine
/// transform).
Eigen::MatrixXd transform(int n);

/// points x (degree + 1): T_k(t_i), by the three-term recurrence, whose error is at most about k^2 units in
/// the last place.
void polynomials(std::span<const double> t, int degree, Eigen::MatrixXd& result);

/// (n + 1) x (n + 1): from the coefficients of a polynomial on [-1, 1] to those of the same on [low, high],
/// each row to about n^2 units in the last place of the largest. n > 0.
Eigen::MatrixXd restriction(int n, double low, double high);

}  // namespace strutt::chebyshev
