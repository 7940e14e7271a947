#pragma once

#include <span>
#include <vector>

#include "strutt/model/periodic_function.hpp"

namespace strutt {

namespace detail {
enum class Parity : unsigned char;
}

/// How an interval is crossed: in so many equal steps, by power series with so many terms.
struct HillSeriesPlan {
  int steps = 0;  ///< 1 ... kMostHillSteps; 0: no plan
  int terms = 0;  ///< of each series, 4 ... 20; the order of the method is 2 terms - 4
};
inline constexpr int kMostHillSteps = 20'000;

/// Hill equations that share their functions of the phase:
///   Y'' + W_l Y = 0,   W_l(theta) = mean[l] + sum_j weights[j][l] basis[j](theta),   l = 0 ... lanes - 1.
struct HillBatch {
  std::span<const double> mean;
  std::vector<std::span<const double>> weights;  ///< one per basis function, each as long as `mean`

  void validate(std::size_t functions) const;  ///< throws InvalidInput when the lengths do not agree
};

/// The propagators of (Y, Y') of a batch, [u1, u2; u1', u2'] times 2^exponent, and bounds of their errors,
/// one array per entry.
struct HillPropagators {
  std::vector<double> u1, u2, du1, du2;
  std::vector<double> u1_error, u2_error, du1_error, du2_error;  ///< times 2^exponent, too
  std::vector<long> exponent;
};

/// Power series with fixed steps over [from, to], r half a step. About each of their ends, the nodes, both
/// solutions are expanded,
///   (k+1)(k+2) a_(k+2) = -sum_(j <= k) w_j a_(k-j),   w_j the coefficients of W there,
/// and neighbours are joined by Darboux's relation (two-point Taylor, Hermite-Obreshkov) of order 2 q,
///   sum_(k <= q) c_k r^k a_k at one node = sum_(k <= q) (-1)^k c_k r^k a_k at the next,
///   c_k = prod_(i < k) 2 (q-i)/(2q-i),
/// for Y with q = terms - 1 and for Y' with q = terms - 2. It needs half the terms that a sum of a series of
/// that order needs. Written as Q+ y at one = Q- y at the next, the propagator is the product of Q+ (Q-)^-1
/// over the nodes, of Q+ at the first and (Q-)^-1 at the last. Where W is even or odd about a node, half the
/// coefficients vanish. The coefficients of the basis are tabulated once for any number of batches; the lanes
/// are vectorised with the instruction set of base/instruction_set.hpp, and every lane has the same bits
/// whatever stands beside it.
///
/// The error bounds hold the truncation, from the tails that the caller gives, the rounding of the series,
/// from its majorant cosh(r sqrt|W|), and that of inverses and products, each node's carried through the
/// nodes before and after it; they are infinite where r sqrt|W| > 8. They take the doubles of the batch as
/// exact, and the functions as evaluated.
class HillSeries {
 public:
  /// Throws InvalidInput for a plan out of range.
  HillSeries(const HillSeriesPlan& plan, std::span<const PeriodicFunction> basis, double from, double to);

  /// Integrates all lanes; results are resized. `tails`: for each lane tail() of numbers as large as its own,
  /// or more. Throws InvalidInput when the lengths do not agree.
  void propagate(const HillBatch& batch, std::span<const double> tails, HillPropagators& result) const;

  /// t such that the relation for r Y' leaves out at most t (|Y| + |r Y'|/2), and that for Y an eighth of
  /// this, Y and Y' in the middle of the step, for all means and weights up to these in size: Darboux's
  /// remainder of the majorant that has |w_j| for -w_j there. Infinite where it falls too slowly. Throws
  /// InvalidInput unless there is a weight for each function.
  double tail(double mean, std::span<const double> weights) const;

  const HillSeriesPlan& plan() const { return plan_; }

  /// Bound of the relative error of W from its functions, of harmonics up to `highest_order` and over phases
  /// within
  /// [-2 pi, 2 pi]: of their coefficients in the table, and of pi itself.
  static double evaluation_error(int highest_order) { return (3.0 + 2.5 * highest_order) * 0x1p-53; }

 private:
  HillSeriesPlan plan_;
  std::vector<PeriodicFunction> basis_;
  double from_, to_;
  int highest_order_ = 0;
  std::vector<double> series_;          // node by node, function by function: r^(j+2) f^(j)/j!
  std::vector<detail::Parity> parity_;  // node by node
  std::vector<double> largest_;         // of each function within r of the real axis
};

}  // namespace strutt
