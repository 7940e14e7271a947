#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"
#include "floquet/hill_sensitivity.hpp"
#include "floquet/lapack.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kSameModulus =
    1e-9;  // relative: multipliers of a group that stays together or has no derivative

PeriodicMatrix scaled(PeriodicMatrix matrix, double factor) {
  matrix.mean *= factor;
  for (auto& h : matrix.harmonics) {
    h.cosine *= factor;
    h.sine *= factor;
  }
  return matrix;
}

void add(Eigen::MatrixXd& to, const Eigen::MatrixXd& x, double factor) {
  if (x.size() == 0) return;
  if (to.size() == 0) to = Eigen::MatrixXd::Zero(x.rows(), x.cols());
  to += factor * x;
}

/// to + factor x; `to` is a derivative with the orders of x.
void add(PeriodicMatrix& to, const PeriodicMatrix& x, double factor) {
  if (factor == 0.0) return;
  add(to.mean, x.mean, factor);
  for (const auto& h : x.harmonics) {
    auto found = std::ranges::find(to.harmonics, h.order, &MatrixHarmonic::order);
    if (found == to.harmonics.end()) found = to.harmonics.insert(found, {h.order, {}, {}});
    add(found->cosine, h.cosine, factor);
    add(found->sine, h.sine, factor);
  }
}

/// M q'' + (C/Omega) q' + (K/Omega^2) q = 0 in the phase, of period 2 pi.
LinearPeriodicSystem in_phase(const LinearPeriodicSystem& system) {
  const double unit = system.period / (2.0 * pi);
  LinearPeriodicSystem result = system;
  result.period = 2.0 * pi;
  result.damping = scaled(system.damping, unit);
  result.stiffness = scaled(system.stiffness, unit * unit);
  return result;
}

SystemDerivative in_phase(const LinearPeriodicSystem& system, SystemDerivative by) {
  const double unit = system.period / (2.0 * pi), stretch = by.period / system.period;
  add(by.damping, system.damping, stretch);
  add(by.stiffness, system.stiffness, 2.0 * stretch);
  by.period = 0.0;
  by.damping = scaled(by.damping, unit);
  by.stiffness = scaled(by.stiffness, unit * unit);
  return by;
}

/// Rows and columns of the block (i, j) of the augmented matrix of state (q, S, q', S').
Eigen::MatrixXd part(const Eigen::MatrixXd& m, Eigen::Index i, Eigen::Index j, Eigen::Index d) {
  Eigen::MatrixXd result(2 * d, 2 * d);
  for (Eigen::Index a = 0; a < 2; ++a)
    for (Eigen::Index b = 0; b < 2; ++b)
      result.block(a * d, b * d, d, d) = m.block((2 * a + i) * d, (2 * b + j) * d, d, d);
  return result;
}

/// How fast ln|lambda| changes, of every multiplier with the largest modulus.
Derivative leading_rate(const Eigen::MatrixXd& m, const Eigen::MatrixXd& dm, double m_error,
                        double dm_error) {
  if (!m.allFinite() || !dm.allFinite()) return {};
  const auto [eigenvalues, left, right] = lapack::eigensystem(m);
  const Eigen::VectorXcd& lambda = eigenvalues.values;
  // of the matrix of right eigenvectors, whose inverse has rows of length 1/condition(j)
  const double condition =
      std::sqrt(static_cast<double>(m.rows())) * eigenvalues.condition.cwiseInverse().norm();
  const double most = lambda.cwiseAbs().maxCoeff();
  Derivative result{0.0, 0.0};
  double least = HUGE_VAL, largest = -HUGE_VAL;
  for (Eigen::Index j = 0; j < lambda.size(); ++j) {
    if (std::abs(lambda(j)) < most * (1.0 - kSameModulus)) continue;
    double separation = HUGE_VAL;
    for (Eigen::Index k = 0; k < lambda.size(); ++k)
      if (k != j) separation = std::min(separation, std::abs(lambda(k) - lambda(j)));
    const std::complex<double> change = left.col(j).dot(dm * right.col(j)) / left.col(j).dot(right.col(j));
    const double rate = (change / lambda(j)).real();
    const double error = condition *
                         (dm_error + 2.0 * condition * dm.norm() * m_error / separation +
                          8.0 * kUnit * static_cast<double>(m.rows()) * dm.norm()) /
                         std::abs(lambda(j));
    least = std::min(least, rate);
    largest = std::max(largest, rate);
    result.error = std::max(result.error, error);
  }
  if (largest - least > 4.0 * result.error || !std::isfinite(result.error)) return {};
  result.value = 0.5 * (least + largest);
  return result;
}

}  // namespace

Sensitivity system_sensitivity(MonodromyEngine& engine, const LinearPeriodicSystem& system,
                               const SystemDerivative& derivative, const MonodromyOptions& options) {
  const Monodromy augmented =
      augmented_monodromy(engine, in_phase(system), in_phase(system, derivative), options);
  Sensitivity result;
  result.outcome = augmented.outcome;
  if (augmented.outcome != Outcome::converged && augmented.outcome != Outcome::tolerance_not_reached)
    return result;
  const auto d = system.mass.rows();
  const auto &value = augmented.matrix.value.mantissa, &error = augmented.matrix.error;
  const Eigen::MatrixXd m = part(value, 0, 0, d), dm = part(value, 1, 0, d);
  const double rounding = 16.0 * kUnit * static_cast<double>(value.rows());
  result.growth = leading_rate(m, dm, part(error, 0, 0, d).norm() + rounding * m.norm(),
                               part(error, 1, 0, d).norm() + rounding * dm.norm());
  const double growth = std::log(lapack::eigenvalues(m).values.cwiseAbs().maxCoeff()) +
                        static_cast<double>(augmented.matrix.value.exponent) * std::numbers::ln2;
  const double by_period = growth * derivative.period / (system.period * system.period);
  result.growth_per_time = {result.growth.value / system.period - by_period,
                            result.growth.error / system.period + 1e-12 * std::abs(by_period)};
  result.edge = {-result.growth.value, result.growth.error};
  return result;
}

}  // namespace strutt
