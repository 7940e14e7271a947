#pragma once

#include <span>
#include <vector>

#include "strutt/integrate/hill_family.hpp"

namespace strutt {

/// Discriminants by the million: D = trace N, 2 - |D| > 0 is stability, of
///   Y'' + W_l Y = 0,   W_l(theta) = mean[l] + sum_j weights[j][l] cos(orders[j] theta),   l = 0 ... lanes -
///   1,
/// over the period 2 pi, from half of it: D = 2 (u1 u2' + u1' u2) at pi. Everything but the choice of the
/// steps is vectorised; a point has the same bits whatever stands beside it. Not thread-safe.
class HillDiscriminants {
 public:
  /// Orders >= 1, each once; 1e-13 <= tolerance <= 1e-2. Throws InvalidInput.
  HillDiscriminants(std::vector<int> orders, double tolerance);

  /// value[l] = D (infinite beyond the range of double) and error[l], a bound of |value - D| divided by
  /// max(1, largest |entry| of N in the state (Y, Y'/kappa)), kappa = max(1, sqrt|mean|). It is tightened
  /// until it is at most the tolerance or rounding is all that is left; +inf where there is no value. The
  /// doubles in `batch` are taken as exact. Throws InvalidInput when the lengths do not agree.
  void compute(const HillBatch& batch, std::span<double> value, std::span<double> error);

 private:
  HillFamily& family(std::size_t rung);
  void combine(const HillGroup& group);
  /// The lanes whose error is above the tolerance.
  std::vector<std::size_t> attempt(std::size_t rung, const HillBatch& batch, std::span<double> value,
                                   std::span<double> error);

  double tolerance_;
  double coefficient_error_;  // of evaluating the cosines
  std::vector<PeriodicFunction> basis_;
  std::vector<double> local_tolerances_;  // falling
  std::vector<HillFamily> families_;      // of the first of them; made when first needed
  std::vector<double> value_, error_;
};

}  // namespace strutt
