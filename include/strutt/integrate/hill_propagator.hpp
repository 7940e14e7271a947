#pragma once

#include <span>
#include <vector>

#include "strutt/base/bounded_matrix.hpp"
#include "strutt/model/periodic_function.hpp"

namespace strutt {

/// How a smooth piece of the phase is integrated: with a splitting of this order, in so many equal steps.
struct HillStepPlan {
  int order = 6;  ///< 4 or 6
  int steps = 0;  ///< even; 0: more than kMostHillSteps would be needed
};
inline constexpr int kMostHillSteps = 100'000;

/// Plans for equations Y'' + W Y = 0 over an interval of the given length, W with harmonics up to
/// `highest_order`: the cheaper of the orders p for an expected error of `tolerance` in the propagator,
/// relative to its largest entry in the state (Y, Y'/kappa):
///   error ~ c_p h^p length B (sqrt B + k)^(p-1),   B >= |W|,   k = 0.7 highest_order.
/// The formula was found by trial (delta to 1e4, epsilon to 1e3, harmonics to order 20) and is no bound: what
/// was reached is known from a second run with half the steps. A plan depends on its equation only, never on
/// what it is computed together with.
class HillStepPlanner {
 public:
  HillStepPlanner(int highest_order, double length, double tolerance);

  /// For W with |W| <= `bound`.
  HillStepPlan plan(double bound) const;

 private:
  std::vector<double> limits_;  // ascending: the largest bounds for which the plans serve
  std::vector<HillStepPlan> plans_;
};

/// The error of n steps seen in a run of n/2 is their difference divided by 2^p - 1; this bound of it, as a
/// share of the difference, leaves room for steps at which the next order still counts.
double halving_share(int order);

/// Hill equations that share their functions of the phase:
///   Y'' + W_l Y = 0,   W_l(theta) = mean[l] + sum_j weights[j][l] basis[j](theta),   l = 0 ... lanes - 1.
struct HillBatch {
  std::span<const double> mean;
  std::vector<std::span<const double>> weights;  ///< one per basis function, each as long as `mean`
};

/// The propagators of (Y, Y') of a batch, [u1, u2; u1', u2'] times 2^exponent, one array per entry.
struct HillPropagators {
  std::vector<double> u1, du1, u2, du2;
  std::vector<long> exponent;
};

/// Runge-Kutta-Nystroem splittings (Blanes, Moan, J. Comput. Appl. Math. 142 (2002) 313-330, the methods SRKN
/// 6b of order 4 and SRKN 11b of order 6) with fixed steps over [from, to], tabulated once for any number of
/// batches: drifts Y += a h Y' and kicks Y' -= b h W Y, so that det = 1 up to rounding. The lanes are
/// vectorised with the instruction set of base/instruction_set.hpp; every lane has the same bits whatever
/// stands beside it.
class HillPropagator {
 public:
  /// steps >= 1; order 4 or 6. Throws InvalidInput.
  HillPropagator(const HillStepPlan& plan, std::span<const PeriodicFunction> basis, double from, double to);

  /// Integrates all lanes; results are resized. Throws InvalidInput when the lengths in `batch` do not agree.
  void propagate(const HillBatch& batch, HillPropagators& result) const;

  /// Bound of the rounding of a propagator, relative to its largest entry, state (Y, Y'/kappa): the roundings
  /// of the stages add up like a random walk, of which this is about 7 standard deviations. (The rounding of
  /// the coefficients is not in it.)
  double rounding() const;

  long evaluations() const { return static_cast<long>(kick_.size()); }  ///< of W, for one lane

 private:
  std::vector<double> drift_;  // a h, one per stage
  std::vector<double> kick_;   // b h, one per kick; stages + 1
  std::vector<double> basis_;  // b h f_j at the time of the kick, kick by kick
  int functions_ = 0;
};

}  // namespace strutt
