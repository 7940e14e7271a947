#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "strutt/integrate/hill_propagator.hpp"

namespace strutt {

/// Lanes of a batch that were integrated with the same steps.
struct HillGroup {
  std::span<const std::uint32_t> lanes;  ///< their places in the batch
  HillBatch batch;                       ///< their coefficients
  HillStepPlan plan;                     ///< steps 0: more would be needed than kMostHillSteps; no result
  const HillPropagator* full = nullptr;  ///< what integrated them
  const HillPropagator* half = nullptr;  ///< the same with half the steps
  const HillPropagators& result;
  const HillPropagators& check;  ///< with half the steps; empty unless asked for
};

/// Equations Y'' + W Y = 0 over [from, to] with W = mean + sum_j weight_j f_j, whose functions f_j and tolerance
/// are the same and whose numbers are not. Each is integrated with the steps planned for its own size,
/// |W| <= |mean| + sum_j |weight_j| max|f_j|, those with equal steps side by side; so a result depends on its own
/// numbers only. Tables are made when first needed and kept. Not thread-safe.
class HillFamily {
 public:
  /// Smooth functions (Fourier form). Throws InvalidInput for an empty interval or a tolerance that is not
  /// positive.
  HillFamily(std::vector<PeriodicFunction> basis, double from, double to, double tolerance);

  /// Integrates the batch and gives it, group by group, to `receive`; what that is shown lives until it returns.
  /// With `with_check`, a second time with half the steps: see halving_share. Throws InvalidInput when the
  /// lengths in `batch` do not agree.
  void propagate(const HillBatch& batch, bool with_check, const std::function<void(const HillGroup&)>& receive);

 private:
  struct Tables {
    std::unique_ptr<HillPropagator> full, half;
  };

  void sort_by_plan(const HillBatch& batch, std::size_t first, std::size_t count);
  const Tables& tables_of(std::size_t plan, bool with_check);
  void run(const HillBatch& batch, std::size_t plan, std::span<const std::uint32_t> lanes, bool with_check,
           const std::function<void(const HillGroup&)>& receive);

  std::vector<PeriodicFunction> basis_;
  double from_, to_;
  HillStepPlanner planner_;
  std::vector<Tables> tables_;  // one per plan
  long stored_steps_ = 0;
  std::vector<std::uint32_t> plan_, sorted_, begin_;
  std::vector<double> mean_, weights_;
  HillPropagators result_, check_;
};

}  // namespace strutt
