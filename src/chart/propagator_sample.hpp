#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// What is interpolated, at one point: the propagator of y, value * 2^exponent with bounds in the same unit.
/// State (q, q') in canonical time, n x n; over half a period from the even point, or over a whole one from
/// the phase 0.
struct PropagatorSample {
  Eigen::MatrixXd value, error;
  long exponent = 0;
  double half_damping = 0.0, kappa = 1.0;  ///< of the point
  bool shifted = false;                    ///< seen from another phase than 0
  long right_hand_sides = 0;
  bool valid = false;
};

/// Integrates many points: fills result[i] at the parameter values points[i]. False: cancelled.
using Sampling = std::function<bool(const std::vector<std::array<double, 2>>& points,
                                    std::vector<PropagatorSample>& result)>;

/// A propagator with bounds in the state (q, q'/kappa): of another kappa, its off-diagonal blocks are `ratio`
/// times as large (upper right) and small (lower left). Adds the rounding.
struct PointPropagator {
  Eigen::MatrixXd value, error;
};
PointPropagator at_kappa(const Eigen::MatrixXd& value, const Eigen::MatrixXd& error, double ratio);

/// Monodromy::error of M at the point of `sample`, if its propagator (in the state scaled by its kappa) times
/// 2^exponent is this one.
double error_of_monodromy(SurrogateKind kind, const PointPropagator& propagator, long exponent,
                          const PropagatorSample& sample);

/// The same as a monodromy. `angular_frequency`: of canonical time.
HillMonodromy hill_monodromy_of(SurrogateKind kind, const PointPropagator& propagator, long exponent,
                                const PropagatorSample& sample, double angular_frequency, double tolerance);
Monodromy system_monodromy_of(const PointPropagator& propagator, long exponent,
                              const PropagatorSample& sample, double angular_frequency, double tolerance);

}  // namespace strutt
