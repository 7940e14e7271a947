#pragma once

#include <memory>

#include "strutt/base/bounded_matrix.hpp"
#include "strutt/model/linear_system.hpp"

namespace strutt {

/// How an interval is integrated: with series cut after `order`, in so many equal steps.
struct TaylorStepPlan {
  int order = 16;      ///< even, kLowestTaylorOrder to kHighestTaylorOrder
  int steps = 0;       ///< 0: more than kMostTaylorSteps would be needed
  double decay = 0.0;  ///< expected ratio of a term of the series to the one two before it, (tau/R)^2
};
inline constexpr int kLowestTaylorOrder = 6, kHighestTaylorOrder = 22;
inline constexpr int kMostTaylorSteps = 100'000;

/// The equation Q'' + C(theta) Q' + K(theta) Q = 0, d x d matrices; C with an empty mean where there is none.
struct TaylorEquation {
  const PeriodicMatrix& damping;
  const PeriodicMatrix& stiffness;
  /// Bound of what wrong coefficients change in a solution, relative, per unit of theta: their relative error
  /// times the rate of the solution.
  double error_rate = 0.0;
};

/// The cheapest plan whose truncation estimate over [0, half_periods pi] is expected to be at most
/// `tolerance`, relative to the largest entry of the propagator. Solutions are entire, and grow over a
/// complex distance R by at most exp(G(R)), G being the integral of a(r) = sqrt|K|(r) + |C|(r) from 0 to R,
/// |K|(r) = |K_0| + sum_k |K_k| cosh(k r). Hence (Cauchy) for n steps with half a step tau
///   estimate ~ kTaylorTruncationSafety n min_R exp(G(R)) (tau/R)^(p+1) / sqrt(2 pi (p+1)),
/// which is x^(p+1)/(p+1)!, x = tau a, for constant coefficients; besides, x <= 2 and tau <= 0.3 R. What was
/// reached is in the bounds of the propagator.
TaylorStepPlan plan_taylor_steps(const TaylorEquation& equation, int half_periods, double tolerance);

/// A step is compared with that of the series cut two terms earlier. The next two terms are to the last two
/// as these are to the two before them, or as those are to their predecessors, or as the plan expects: the
/// difference times the largest of these ratios times this safety bounds the truncation of the step.
inline constexpr double kTaylorTruncationSafety = 3.0;

/// Propagators of Q'' + C Q' + K Q = 0 over [0, half_periods pi] by centred Taylor series: the solutions are
/// expanded about the middle m of each step of length 2 tau,
///   Phi(m + s tau) = sum_{k <= p} Y_k s^k,   Y_0 = I,
///   (k+1) Q_{k+1} = tau Q'_k,   (k+1) Q'_{k+1} = -tau sum_j (C_j Q'_{k-j} + K_j Q_{k-j}),
/// C_j and K_j being the coefficients of C and K about m times tau^j. The step is the quotient
///   Phi(m + tau) Phi(m - tau)^-1:
/// symmetric, of order p. Expanding to both sides makes a step twice as long as a one-sided series of the
/// same cost does. Any d; for d = 2 and 3 the compiler knows the size. Not thread-safe.
class TaylorPropagator {
 public:
  /// Throws InvalidInput for another order than the ones above, steps < 1, or half_periods not 1 or 2.
  TaylorPropagator(const TaylorEquation& equation, const TaylorStepPlan& plan, int half_periods);
  ~TaylorPropagator();
  TaylorPropagator(TaylorPropagator&&) noexcept;
  TaylorPropagator& operator=(TaylorPropagator&&) noexcept;

  /// Over the steps first, ..., last - 1, first < last; state (Q, Q'). The error bounds the rounding and
  /// what error_rate says, and `with_truncation` the truncation: both step by step, so that errors of steps
  /// which happen to cancel do not hide each other.
  BoundedMatrix propagate(int first, int last, bool with_truncation = true);

  /// Products K_j Q_{k-j} in a step, of which a right-hand side has one. (Those with C_j, if any, are as
  /// many.)
  long products_per_step() const;

  class Steps;  ///< of one size

 private:
  std::unique_ptr<Steps> steps_;
  int count_;
};

}  // namespace strutt
