#include "chart/propagator_sample.hpp"

#include <numbers>

#include "chart/factor_error.hpp"
#include "floquet/assembly.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;

double error_from_half_period(const PointPropagator& p, long exponent, const PropagatorSample& sample) {
  const auto row_by_row = [](const Eigen::MatrixXd& m) {
    return std::array<double, 4>{m(0, 0), m(0, 1), m(1, 0), m(1, 1)};
  };
  return monodromy_error(row_by_row(p.value), row_by_row(p.error),
                         {exponent, sample.half_damping, sample.kappa, sample.shifted});
}

}  // namespace

PointPropagator at_kappa(const Eigen::MatrixXd& value, const Eigen::MatrixXd& error, double ratio) {
  const Eigen::Index d = value.rows() / 2;
  PointPropagator result{value, error};
  for (auto* m : {&result.value, &result.error}) {
    m->topRightCorner(d, d) *= ratio;
    m->bottomLeftCorner(d, d) /= ratio;
  }
  result.error.topRightCorner(d, d) += 2.0 * kUnit * result.value.topRightCorner(d, d).cwiseAbs();
  result.error.bottomLeftCorner(d, d) += 2.0 * kUnit * result.value.bottomLeftCorner(d, d).cwiseAbs();
  return result;
}

double error_of_monodromy(SurrogateKind kind, const PointPropagator& propagator, long exponent,
                          const PropagatorSample& sample) {
  if (kind == SurrogateKind::half_period) return error_from_half_period(propagator, exponent, sample);
  return monodromy_of(kind, propagator, exponent, sample, 1.0, 1.0).error;
}

Monodromy monodromy_of(SurrogateKind kind, const PointPropagator& propagator, long exponent,
                       const PropagatorSample& sample, double angular_frequency, double tolerance) {
  BoundedMatrix bounded{{propagator.value, exponent}, propagator.error};
  bounded.normalise();
  Monodromy result;
  result.half_damping = sample.half_damping;
  result.kappa = sample.kappa * angular_frequency;
  if (kind == SurrogateKind::half_period) {
    result.undamped = period_from_half({bounded}, 0);
    result.half = std::move(bounded);
  } else {
    result.undamped = std::move(bounded);
  }
  result.matrix = restore_damping(result.undamped, sample.half_damping,
                                  0.5 * sample.half_damping / (std::numbers::pi * sample.kappa));
  result.error = scaled_error(result.matrix);
  result.method = Method::surrogate;
  result.outcome = result.error <= tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
  return result;
}

}  // namespace strutt
