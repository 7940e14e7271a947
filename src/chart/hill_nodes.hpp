#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "chart/hill_model.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/integrate/hill_family.hpp"

namespace strutt {

/// Propagators of Hill equations at many points at once: the power series of integrate/hill_family, the
/// points with the same plan side by side. The same bits for any number of threads.
class HillNodes {
 public:
  HillNodes(const Scene& scene, const Axis& x, const Axis& y, const std::optional<double>& even_phase,
            const ParallelOptions& parallel);

  /// result[i] at the parameter values points[i], to a truncation of about `tolerance` (any, also below what
  /// rounding allows; the bounds in the result count). False: cancelled.
  bool sample(const std::vector<std::array<double, 2>>& points, double tolerance,
              std::vector<PropagatorSample>& result);

 private:
  HillFamily& family(std::size_t slot, double tolerance, const std::vector<int>& harmonics);

  ParallelOptions parallel_;
  HillModel model_;
  double length_;  // of the phase: half a period or a whole one
  // of each thread, by tolerance and harmonics; k: cos(k theta), -k: sin
  std::vector<std::map<std::pair<double, std::vector<int>>, HillFamily>> families_;
};

}  // namespace strutt
