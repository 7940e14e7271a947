#pragma once

#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "chart/hill_model.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/integrate/hill_propagator.hpp"

namespace strutt {

/// Propagators of Hill equations at many points at once: the splitting of integrate/hill_propagator over all
/// points that need the same number of steps, checked by a run with half of them. The same bits for any
/// number of threads.
class HillNodes {
 public:
  HillNodes(const Scene& scene, const Axis& x, const Axis& y, const std::optional<double>& even_phase,
            const ParallelOptions& parallel);

  /// result[i] at the parameter values points[i], to a truncation of about `tolerance` (any, also below what
  /// rounding allows; the bounds in the result count). False: cancelled.
  bool sample(const std::vector<std::array<double, 2>>& points, double tolerance,
              std::vector<PropagatorSample>& result);

 private:
  const HillPropagator& table(const HillStepPlan& plan, const std::vector<int>& harmonics);

  ParallelOptions parallel_;
  HillModel model_;
  double length_;  // of the phase: half a period or a whole one
  std::map<std::tuple<int, int, std::vector<int>>, HillPropagator>
      tables_;  // order, steps; k: cos(k theta), -k: sin
};

}  // namespace strutt
