#include "chart/propagator_sample.hpp"

#include <numbers>

#include "base/constants.hpp"
#include "chart/factor_error.hpp"
#include "floquet/assembly.hpp"

namespace strutt {
namespace {

double error_from_half_period(const PointPropagator& p, long exponent, const PropagatorSample& sample) {
  const auto row_by_row = [](const Eigen::MatrixXd& m) {
    return std::array<double, 4>{m(0, 0), m(0, 1), m(1, 0), m(1, 1)};
  };
  return monodromy_error(row_by_row(p.value), row_by_row(p.error),
                         {exponent, sample.half_damping, sample.kappa, sample.shifted});
}

/// From N to M.
template <typename Matrix>
void finish(BasicMonodromy<Matrix>& result, const PropagatorSample& sample, double angular_frequency,
            double tolerance) {
  result.half_damping = sample.half_damping;
  result.kappa = sample.kappa * angular_frequency;
  result.matrix = restore_damping(result.undamped, sample.half_damping,
                                  0.5 * sample.half_damping / (std::numbers::pi * sample.kappa));
  result.error = scaled_error(result.matrix);
  result.method = Method::surrogate;
  result.outcome = result.error <= tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
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
  return system_monodromy_of(propagator, exponent, sample, 1.0, 1.0).error;
}

HillMonodromy hill_monodromy_of(SurrogateKind kind, const PointPropagator& propagator, long exponent,
                                const PropagatorSample& sample, double angular_frequency, double tolerance) {
  BoundedMatrix2 bounded{{Eigen::Matrix2d(propagator.value), exponent}, Eigen::Matrix2d(propagator.error)};
  bounded.normalise();
  HillMonodromy result;
  if (kind == SurrogateKind::half_period) {
    result.undamped = period_from_half({bounded}, 0);
    result.half = bounded;
  } else {
    result.undamped = bounded;
  }
  finish(result, sample, angular_frequency, tolerance);
  return result;
}

Monodromy system_monodromy_of(const PointPropagator& propagator, long exponent,
                              const PropagatorSample& sample, double angular_frequency, double tolerance) {
  Monodromy result;
  result.undamped = BoundedMatrix{{propagator.value, exponent}, propagator.error};
  result.undamped.normalise();
  finish(result, sample, angular_frequency, tolerance);
  return result;
}

}  // namespace strutt
