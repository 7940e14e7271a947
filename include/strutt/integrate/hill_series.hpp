#pragma once

#include <span>
#include <vector>

#include "strutt/model/periodic_function.hpp"

namespace strutt {

/// How an interval is crossed: in so many equal steps, by power series with so many terms.
struct HillSeriesPlan {
  int steps = 0;  ///< 1 ... kMostHillSteps; 0: no plan
  int terms = 0;  ///< of each series, even, 6 ... 48; the order of the method is terms - 2
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

/// Power series with fixed steps over [from, to]. In each step both solutions are expanded about its middle,
///   (k+1)(k+2) a_(k+2) = -sum_(j <= k) w_j a_(k-j),   w_j the coefficients of W there,
/// so that one expansion serves its whole length: P = A(r) A(-r)^-1, r half a step, the inverse by det A = 1.
/// The coefficients of the basis are tabulated once for any number of batches; the lanes are vectorised with
/// the instruction set of base/instruction_set.hpp, and every lane has the same bits whatever stands beside
/// it.
///
/// The error bounds hold the truncation, from the last terms kept, the rounding of the series, from its
/// majorant cosh(r sqrt|W|), and that of the products, each step's carried through the steps before and after
/// it. They take the doubles of the batch as exact, and the functions as evaluated.
class HillSeries {
 public:
  /// Throws InvalidInput for a plan out of range.
  HillSeries(const HillSeriesPlan& plan, std::span<const PeriodicFunction> basis, double from, double to);

  /// Integrates all lanes; results are resized. Throws InvalidInput when the lengths in `batch` do not agree.
  void propagate(const HillBatch& batch, HillPropagators& result) const;

  const HillSeriesPlan& plan() const { return plan_; }

  /// Bound of the relative error of W from its functions, of harmonics up to `highest_order` and over phases within
  /// [-2 pi, 2 pi]: of their coefficients in the table, and of pi itself.
  static double evaluation_error(int highest_order) { return (3.0 + 2.5 * highest_order) * 0x1p-53; }

 private:
  HillSeriesPlan plan_;
  double radius_;
  std::size_t functions_;
  std::vector<double> series_;           // step by step, function by function: r^(j+2) f^(j)/j!
  std::vector<unsigned char> odd_only_;  // step by step
  std::vector<double> largest_;          // of each function within r of the real axis
};

}  // namespace strutt
