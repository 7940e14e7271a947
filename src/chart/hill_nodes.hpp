#pragma once

#include <vector>

#include "chart/hill_model.hpp"
#include "floquet/series_propagators.hpp"
#include "strutt/base/parallel.hpp"

namespace strutt {

/// Propagators of Hill equations at many points at once, by power series. The same bits for any number of
/// threads.
class HillNodes {
 public:
  HillNodes(const Scene& scene, const Axis& x, const Axis& y, const std::optional<double>& even_phase,
            const ParallelOptions& parallel);

  /// result[i] at the parameter values points[i], to a truncation of about `tolerance` (any, also below what
  /// rounding allows; the bounds in the result count). False: cancelled.
  bool sample(const std::vector<std::array<double, 2>>& points, double tolerance,
              std::vector<PropagatorSample>& result);

 private:
  ParallelOptions parallel_;
  HillModel model_;
  double length_;                               // of the phase: half a period or a whole one
  std::vector<SeriesPropagators> propagators_;  // of each thread
};

}  // namespace strutt
