#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "strutt/integrate/hill_series.hpp"

namespace strutt {

/// Lanes of a batch that were integrated by the same plan.
struct HillGroup {
  std::span<const std::uint32_t> lanes;  ///< their places in the batch
  HillBatch batch;                       ///< their coefficients
  HillSeriesPlan plan;                   ///< steps 0: they need more than kMostHillSteps; no result
  std::span<const double> tails;         ///< that HillSeries::propagate was given
  const HillPropagators& result;
};

/// Equations Y'' + W Y = 0 over [from, to] with W = mean + sum_j weight_j f_j, whose functions f_j and
/// tolerance are the same and whose numbers are not. Each is integrated by the cheapest plan that serves it,
/// those with the same plan side by side; so a result depends on its own numbers only. Tables are made when
/// first needed and kept. Not thread-safe.
class HillFamily {
 public:
  /// Smooth functions (Fourier form). The truncation stays below about `tolerance` of the largest entry.
  /// Throws InvalidInput for an empty interval or a tolerance that is not positive.
  HillFamily(std::vector<PeriodicFunction> basis, double from, double to, double tolerance);
  ~HillFamily();
  HillFamily(HillFamily&&) noexcept;
  HillFamily& operator=(HillFamily&&) noexcept;

  /// Integrates the batch and gives it, group by group, to `receive`; what that is shown lives until it
  /// returns. Throws InvalidInput when the lengths in `batch` do not agree.
  void propagate(const HillBatch& batch, const std::function<void(const HillGroup&)>& receive);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace strutt
