#include "floquet/undamped_system.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numbers>

#include "base/constants.hpp"
#include "floquet/assembly.hpp"

namespace strutt {
namespace {

using Eigen::MatrixXd;
using std::numbers::pi;

/// factor * inverse_mass * matrix.
PeriodicMatrix times(const Eigen::PartialPivLU<MatrixXd>& mass, const PeriodicMatrix& matrix, double factor) {
  const auto solved = [&](const MatrixXd& m) {
    return m.size() > 0 ? MatrixXd(factor * mass.solve(m)) : MatrixXd();
  };
  PeriodicMatrix result{solved(matrix.mean), {}};
  for (const auto& h : matrix.harmonics)
    result.harmonics.push_back({h.order, solved(h.cosine), solved(h.sine)});
  return result;
}

bool is_even(const PeriodicMatrix& matrix) {
  return std::all_of(matrix.harmonics.begin(), matrix.harmonics.end(),
                     [](const MatrixHarmonic& h) { return h.sine.size() == 0 || h.sine.isZero(0.0); });
}

}  // namespace

UndampedSystem::UndampedSystem(const LinearPeriodicSystem& system)
    : unit(system.period / (2.0 * pi)), mass(system.mass), inverse_mass(system.mass.inverse()) {
  const Eigen::PartialPivLU<MatrixXd> factored(mass);
  const auto proportional = system.proportional_damping();
  if (proportional && *proportional > 0.0) c = *proportional * unit;
  const bool general = system.has_damping() && c == 0.0;
  if (general) damping = times(factored, system.damping, unit);
  stiffness = times(factored, system.stiffness, unit);
  stiffness.mean *= unit;
  for (auto& h : stiffness.harmonics) h.cosine *= unit, h.sine *= unit;
  rate = std::sqrt(stiffness.bound() + 0.25 * c * c) + (general ? damping.bound() : 0.0);
  stiffness.mean.diagonal().array() -= 0.25 * c * c;

  for (const auto* matrix : {&stiffness, &damping}) {
    for (const auto& h : matrix->harmonics) highest_order = std::max(highest_order, h.order);
  }
  // Solving with the mass matrix is exact up to a change of it by some roundings.
  const double condition = (inverse_mass.cwiseAbs() * mass.cwiseAbs()).rowwise().sum().maxCoeff();
  coefficient_error = 8.0 * kUnit * std::max(1.0, condition);
  even_symmetric =
      !general && is_even(system.stiffness) && system.stiffness.is_symmetric() && mass == mass.transpose();
}

BoundedMatrix UndampedSystem::mirrored(const BoundedMatrix& propagator) const {
  const auto d = mass.rows();
  const auto adjoint = [d](const MatrixXd& p, const MatrixXd& left, const MatrixXd& right) {
    MatrixXd result(2 * d, 2 * d);
    result << left * p.bottomRightCorner(d, d).transpose() * right,
        left * p.topRightCorner(d, d).transpose() * right,
        left * p.bottomLeftCorner(d, d).transpose() * right, left * p.topLeftCorner(d, d).transpose() * right;
    return result;
  };
  BoundedMatrix result;
  result.value = {adjoint(propagator.value.mantissa, inverse_mass, mass), propagator.value.exponent};
  if (propagator.error.size() > 0) {
    const auto n = static_cast<double>(2 * d);
    const MatrixXd rounding = 2.0 * n * kUnit * propagator.value.mantissa.cwiseAbs();
    result.error = adjoint(propagator.error + rounding, inverse_mass.cwiseAbs(), mass.cwiseAbs());
  }
  result.normalise();
  return result;
}

Monodromy UndampedSystem::put_together(const std::vector<BoundedMatrix>& factors, bool half) const {
  Monodromy result;
  result.kappa = 1.0 / unit;
  result.half_damping = c * pi;
  const int n = static_cast<int>(2 * mass.rows());
  result.undamped = ordered_product(factors, n);
  if (half) {
    result.half = result.undamped;
    result.undamped = ordered_product<MatrixXd>({*result.half, mirrored(*result.half)}, n);
  }
  result.matrix = restore_damping(result.undamped, result.half_damping, 0.5 * c);
  return result;
}

Monodromy UndampedSystem::assembled(const Propagators<MatrixXd>& found, bool half) const {
  Monodromy result = combined(found, [&](const auto& factors) { return put_together(factors, half); });
  result.error = scaled_error(result.matrix);
  return result;
}

}  // namespace strutt
