#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "floquet/lapack.hpp"
#include "strutt/floquet/multipliers.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;
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

/// A unit vector orthogonal to the columns of v and of J v: the best of the coordinate directions, mixed a little.
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

/// The restriction of a skew-Hamiltonian S (every eigenvalue double) to an isotropic invariant subspace of half the
/// dimension, by the isotropic Arnoldi process (Mehrmann, Watkins 2001): its eigenvalues are those of S, each once.
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

/// ln|lambda| >= 0 and its error from rho = (mantissa) 2^exponent = lambda + 1/lambda.
struct LogModulus {
  double value, error;
};
LogModulus log_modulus(std::complex<double> mantissa, double error, long exponent) {
  const double log_rho = std::log(std::abs(mantissa)) + static_cast<double>(exponent) * std::numbers::ln2;
  if (log_rho > 30.0) return {log_rho, error / std::abs(mantissa) + kUnit * log_rho};
  const double scale = std::ldexp(1.0, static_cast<int>(std::max(exponent, -2000L)));
  const std::complex<double> half = 0.5 * scale * mantissa;
  const std::complex<double> root = std::sqrt((half - 1.0) * (half + 1.0));
  const double modulus = std::max(std::abs(half + root), std::abs(half - root));
  const double shift = 0.5 * scale * error;
  return {std::log(modulus), std::min(shift / std::abs(root), std::sqrt(2.0 * shift) + shift) + 4.0 * kUnit};
}

/// 1 - |rho|/(2 cosh h).
Margin real_margin(double mantissa, double error, long exponent, double h) {
  const double log_cosh = h + std::log1p(std::exp(-2.0 * h));
  const double log_scale = static_cast<double>(exponent) * std::numbers::ln2 - log_cosh;
  if (std::log(std::abs(mantissa)) + log_scale > 690.0) return {kLowestMargin, 0.0};
  const double scale = std::exp(log_scale);
  return {1.0 - std::abs(mantissa) * scale, error * scale + 8.0 * kUnit * (1.0 + h) * (1.0 + std::abs(mantissa) * scale)};
}

struct Rho {
  std::complex<double> value;
  double error;
};

/// Whether two of them cannot be told apart: a complex pair may then be two real ones, and the other way round.
bool any_collision(const std::vector<Rho>& rho) {
  for (std::size_t j = 0; j < rho.size(); ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      if (!(std::abs(rho[j].value - rho[k].value) > rho[j].error + rho[k].error)) return true;
    }
  }
  return false;
}

}  // namespace

SystemStability reciprocal_stability(const BoundedMatrix& undamped, const MatrixXd& mass, double half_damping) {
  const Eigen::Index n = undamped.value.mantissa.rows(), d = n / 2;
  // canonical coordinates (q, mass q'/kappa)
  MatrixXd to = MatrixXd::Identity(n, n), from = to;
  to.bottomRightCorner(d, d) = mass;
  from.bottomRightCorner(d, d) = mass.inverse();
  const MatrixXd canonical = to * undamped.value.mantissa * from;
  const MatrixXd size = to.cwiseAbs() * (undamped.error + 8.0 * static_cast<double>(n) * kUnit * undamped.value.mantissa.cwiseAbs()) *
                        from.cwiseAbs();
  const double perturbation = 2.0 * size.norm();
  const auto eigen = lapack::eigenvalues(isotropic_restriction(sum_with_inverse(canonical)));
  const long exponent = undamped.value.exponent;

  std::vector<Rho> rho;
  for (Eigen::Index j = 0; j < d; ++j) rho.push_back({eigen.values[j], kSafety * perturbation / eigen.condition[j]});
  bool all_real = true;
  Margin least{1.0, 0.0};
  LogModulus largest{0.0, 0.0};
  for (const auto& r : rho) {
    all_real = all_real && r.value.imag() == 0.0;
    const auto margin = real_margin(r.value.real(), r.error, exponent, half_damping);
    if (margin.value < least.value) least = margin;
    least.error = std::max(least.error, margin.value == least.value ? margin.error : 0.0);
    const bool on_circle = r.value.imag() == 0.0 && std::ldexp(std::abs(r.value.real()), static_cast<int>(exponent)) <= 2.0;
    const auto modulus = on_circle ? LogModulus{0.0, 0.0} : log_modulus(r.value, r.error, exponent);
    if (modulus.value > largest.value) largest = modulus;
  }
  SystemStability result;
  result.growth = largest.value - half_damping;
  const Margin by_growth{-result.growth, largest.error + 4.0 * kUnit * half_damping};
  if (!any_collision(rho)) {
    result.margin = all_real ? least : by_growth;
    return result;
  }
  // Real or complex cannot be told: the margin lies between the two formulas.
  const double a = least.value, b = by_growth.value;
  result.margin = {0.5 * (a + b), 0.5 * std::abs(a - b) + std::max(least.error, by_growth.error)};
  if (half_damping == 0.0 && result.margin.value > -result.margin.error) {
    result.margin.error = std::max(result.margin.error, std::abs(result.margin.value));  // growth 0 proves nothing
  }
  return result;
}

}  // namespace strutt
