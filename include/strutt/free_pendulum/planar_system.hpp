#pragma once

#include <Eigen/Core>
#include <functional>

#include "strutt/free_pendulum/jet.hpp"

namespace strutt {

/// Quadratic and cubic part of a function of two variables: sum of c_jk y1^j y2^k, plain monomial
/// coefficients (no factorials).
struct NonlinearTerms {
  double c20 = 0.0, c11 = 0.0, c02 = 0.0;
  double c30 = 0.0, c21 = 0.0, c12 = 0.0, c03 = 0.0;
};

/// x' = A x + f(x) + O(|x|^4) about an equilibrium at x = 0 (paper, eq. 12 for the pendulum).
struct PlanarSystem {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Zero();  ///< A, rows are equations
  NonlinearTerms f1 = {}, f2 = {};
};

/// y1' = alpha y2 + f1(y), y2' = -alpha y1 + f2(y) (paper, eq. 14), alpha > 0 in rad per unit of time.
struct PlanarCoefficients {
  double alpha = 1.0;
  NonlinearTerms f1 = {}, f2 = {};
};

/// The real Jordan form and the transformation x = T y, T = [u v], A u = -alpha v, A v = alpha u.
struct JordanForm {
  Eigen::Matrix2d transformation;  ///< T
  PlanarCoefficients system;       ///< in y
};

/// Paper, eqs. 12-14, for any A whose eigenvalues are +-i alpha. The vectors are fixed by u = (1, 0), so
/// v = -(a11, a21)/alpha: for the pendulum T = diag(1, alpha), and y1 = x1 on the axis x2 = 0. (Another
/// length s of u changes y to y/s, and delta, beta by s^2.) f becomes T^-1 f(T y). Throws InvalidInput unless
/// all entries are finite, det A > 0 and |trace A| <= 8 eps (|a11| + |a22|), eps = 2^-52.
JordanForm jordan_form(const PlanarSystem& system);

/// A smooth right-hand side written with Jets, e.g.
/// `[](const Jet& x1, const Jet& x2) { return JetPair{x2, -sin(x1)}; }`.
using PlanarField = std::function<JetPair(const Jet& x1, const Jet& x2)>;

/// Taylor coefficients to third order about `equilibrium`, by automatic differentiation: no step, no
/// truncation error. Throws InvalidInput if a coefficient is not finite, or if the field does not vanish
/// there: |field_i| must be at most 64 eps (1 + |x1| + |x2|) times the largest entry of A, eps = 2^-52 (a
/// rounded pi is an equilibrium of the pendulum).
PlanarSystem taylor_expansion(const PlanarField& field, const Eigen::Vector2d& equilibrium);

}  // namespace strutt
