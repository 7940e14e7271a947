#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "base/constants.hpp"
#include "floquet/lapack.hpp"
#include "floquet/reciprocal_sums.hpp"
#include "strutt/floquet/multipliers.hpp"

namespace strutt {
namespace {

constexpr double kSafety = 4.0;

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// J x with J = [0, I; -I, 0].
VectorXd rotate(const VectorXd& x) {
  const Eigen::Index d = x.size() / 2;
  VectorXd result(x.size());
  result << x.tail(d), -x.head(d);
  return result;
}

/// N + N^-1 for symplectic N: N^-1 = -J N^T J.
MatrixXd sum_with_inverse(const MatrixXd& n) {
  const Eigen::Index d = n.rows() / 2;
  MatrixXd inverse(2 * d, 2 * d);
  inverse << n.bottomRightCorner(d, d).transpose(), -n.topRightCorner(d, d).transpose(),
      -n.bottomLeftCorner(d, d).transpose(), n.topLeftCorner(d, d).transpose();
  return n + inverse;
}

/// Removes from x its parts along the columns of v and of J v, twice (once leaves a remainder of rounding).
void project_out(const MatrixXd& v, VectorXd& x) {
  for (int pass = 0; pass < 2; ++pass) {
    for (Eigen::Index j = 0; j < v.cols(); ++j) {
      x -= v.col(j).dot(x) * v.col(j);
      const VectorXd jv = rotate(v.col(j));
      x -= jv.dot(x) * jv;
    }
  }
}

/// A unit vector orthogonal to the columns of v and of J v: the best of the coordinate directions, mixed a
/// little.
VectorXd fresh_direction(const MatrixXd& v, Eigen::Index size) {
  VectorXd best = VectorXd::Zero(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    VectorXd x = VectorXd::LinSpaced(size, 0.3, 0.7);
    x[j] += 2.0;
    project_out(v, x);
    if (x.norm() > best.norm()) best = x;
  }
  return best.normalized();
}

/// The restriction of a skew-Hamiltonian S (every eigenvalue double) to an isotropic invariant subspace of
/// half the dimension, by the isotropic Arnoldi process (Mehrmann, Watkins 2001): its eigenvalues are those
/// of S, each once.
MatrixXd isotropic_restriction(const MatrixXd& s) {
  const Eigen::Index size = s.rows(), d = size / 2;
  const double negligible = 1e-13 * s.norm();
  MatrixXd v(size, 0), h = MatrixXd::Zero(d, d);
  VectorXd next = fresh_direction(v, size);
  for (Eigen::Index j = 0; j < d; ++j) {
    v.conservativeResize(Eigen::NoChange, j + 1);
    v.col(j) = next;
    next = s * v.col(j);
    h.col(j).head(j + 1) = v.transpose() * next;
    project_out(v, next);
    const double rest = next.norm();
    if (j + 1 == d) break;
    if (rest > negligible) {
      h(j + 1, j) = rest;
      next /= rest;
    } else {
      next = fresh_direction(v, size);
    }
  }
  return h;
}

/// Whether two of them cannot be told apart: a complex pair may then be two real ones, and the other way
/// round.
bool any_collision(const std::vector<MultiplierSum>& rho) {
  for (std::size_t j = 0; j < rho.size(); ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      if (!(std::abs(rho[j].value - rho[k].value) > rho[j].error + rho[k].error)) return true;
    }
  }
  return false;
}

}  // namespace

SystemStability reciprocal_stability(const BoundedMatrix& undamped, const MatrixXd& mass,
                                     double half_damping) {
  const Eigen::Index n = undamped.value.mantissa.rows(), d = n / 2;
  // canonical coordinates (q, mass q'/kappa)
  MatrixXd to = MatrixXd::Identity(n, n), from = to;
  to.bottomRightCorner(d, d) = mass;
  from.bottomRightCorner(d, d) = mass.inverse();
  const MatrixXd canonical = to * undamped.value.mantissa * from;
  const MatrixXd size =
      to.cwiseAbs() *
      (undamped.error + 8.0 * static_cast<double>(n) * kUnit * undamped.value.mantissa.cwiseAbs()) *
      from.cwiseAbs();
  const long exponent = undamped.value.exponent;
  if (d == 2) {
    return reciprocal_stability(
        {canonical.topLeftCorner<2, 2>(), canonical.topRightCorner<2, 2>(),
         canonical.bottomLeftCorner<2, 2>(), canonical.bottomRightCorner<2, 2>(), size.topLeftCorner<2, 2>(),
         size.topRightCorner<2, 2>(), size.bottomLeftCorner<2, 2>(), size.bottomRightCorner<2, 2>()},
        exponent, half_damping);
  }
  const double perturbation = 2.0 * size.norm();
  const auto eigen = lapack::eigenvalues(isotropic_restriction(sum_with_inverse(canonical)));
  std::vector<MultiplierSum> rho;
  for (Eigen::Index j = 0; j < d; ++j)
    rho.push_back({eigen.values[j], kSafety * perturbation / eigen.condition[j]});
  return stability_of(rho, any_collision(rho), exponent, half_damping);
}

}  // namespace strutt
