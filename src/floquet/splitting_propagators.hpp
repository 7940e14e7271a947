#pragma once

#include <compare>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "floquet/segments.hpp"
#include "strutt/base/bounded_matrix.hpp"
#include "strutt/integrate/hill_propagator.hpp"
#include "strutt/integrate/integrator.hpp"

namespace strutt {

/// Y'' + W Y = 0 over a piece on which W is smooth, wanted with a truncation of about `tolerance`.
struct SplittingJob {
  PeriodicFunction w;
  Segment piece;
  double kappa = 1.0;
  double coefficient_error = 0.0;  ///< bound of the relative error of W
};

/// The propagator of one smooth piece by a splitting, and the same with half the steps.
struct SplittingPropagation {
  BoundedMatrix2 matrix;  ///< state (Y, Y'/kappa); `error` bounds its rounding only
  ScaledMatrix2 check;
  double truncation_share = 0.0;     ///< bound of the truncation as a share of |matrix - check|
  IntegrationCost cost, check_cost;  ///< no steps: the tolerance needs too many
};

/// Propagates equations, those with the same steps and harmonics side by side in one batch. The tables of
/// cosines are kept, since the cells of a chart share them. A result does not depend on the other jobs.
class SplittingPropagators {
 public:
  /// One result for each job. Without `with_check` the second run is left out.
  std::vector<SplittingPropagation> propagate(std::span<const SplittingJob> jobs, double tolerance,
                                              bool with_check);

 private:
  /// What equations in one batch have in common. The harmonics: positive the order of a cosine, negative that
  /// of a sine.
  struct Group {
    int order = 0, steps = 0;
    double from = 0.0, to = 0.0;
    std::vector<int> harmonics;
    auto operator<=>(const Group&) const = default;
  };

  HillStepPlan plan(const SplittingJob& job, double tolerance);
  const HillPropagator& table(const Group& group);
  void run(const Group& group, std::span<const SplittingJob> jobs, std::span<const std::size_t> members,
           bool with_check, std::vector<SplittingPropagation>& results);

  std::map<std::tuple<int, double, double>, HillStepPlanner> planners_;  // highest order, length, tolerance
  std::map<Group, HillPropagator> tables_;
};

}  // namespace strutt
