#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>

#include "strutt/base/bounded_matrix.hpp"
#include "strutt/integrate/integrator.hpp"

namespace strutt {

/// How one propagator is integrated.
struct PropagatorOptions {
  double local_tolerance = 1e-11;  ///< of each step, relative and absolute, in [1e-14, 1e-4]
  double highest_frequency = 0.0;  ///< of the harmonics of A, in radians per unit of t: bounds the first step
  bool estimate_error = true;      ///< make the second run
  long max_steps = 10'000'000;
  double max_seconds = std::numeric_limits<double>::infinity();
  const std::atomic<bool>* cancel = nullptr;
};

/// A propagator integrated twice, how the runs ended, and what they cost.
struct Propagation {
  BoundedMatrix matrix;  ///< the main run; `error` bounds its rounding only
  ScaledMatrix check;    ///< the second run; a copy of the main one where none was asked for
  Outcome outcome = Outcome::converged;
  IntegrationCost cost;           ///< of the main run
  IntegrationCost estimate_cost;  ///< of the second run
};

/// Adds to `error` the truncation seen in a second, more accurate run: kTruncationSafety times the largest
/// entry of |matrix - check|, for every entry. Compare results as far down the line as possible: errors of
/// single propagators that cancel in a product then do so in the estimate as well.
inline constexpr double kTruncationSafety = 6.0;
template <typename Matrix>
void add_truncation(BasicBoundedMatrix<Matrix>& matrix, const BasicScaledMatrix<Matrix>& check);

/// Fundamental matrices of y' = A(t) y with n states, integrated from the identity by SUNDIALS, and a second
/// time for the error: ARKODE at 3/100 of the tolerance of an ARKODE run, or at the tolerance of a CVODE run,
/// which is far less accurate. The rounding bound grows with the number of steps and with `radians`, the
/// phase the solution passes: each step rounds the state and, by half an ulp, the time. Not thread-safe;
/// reusable without allocation inside the steppers.
class LinearPropagator {
 public:
  /// `backend` cvode_adams or arkode_erk.
  LinearPropagator(int states, Backend backend);

  /// `f` gives d/dt of the n x n matrix, column by column (n^2 components). `radians`: an upper estimate of
  /// the integral of sqrt|A^2| over [from, to]; `coefficient_error`: bound of the relative error of the
  /// coefficients behind A.
  Propagation propagate(const RightHandSide& f, double from, double to, double radians,
                        double coefficient_error, const PropagatorOptions& options);

 private:
  int states_;
  Backend backend_;
  Integrator main_;
  Integrator check_;
};

}  // namespace strutt
