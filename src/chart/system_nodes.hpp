#pragma once

#include <memory>
#include <vector>

#include "chart/propagator_sample.hpp"
#include "chart/surrogate_scope.hpp"
#include "strutt/base/parallel.hpp"

namespace strutt {

/// Propagators over a period of systems with n states at many points, each by the engine.
class SystemNodes {
 public:
  SystemNodes(const Scene& scene, const Axis& x, const Axis& y, bool splits_damping,
              const ParallelOptions& parallel);

  /// result[i] at the parameter values points[i], each with an error of at most about `tolerance` where that
  /// can be reached. False: cancelled.
  bool sample(const std::vector<std::array<double, 2>>& points, double tolerance,
              std::vector<PropagatorSample>& result);

 private:
  struct Worker;
  std::vector<std::shared_ptr<Worker>> workers_;  // one per thread
  bool splits_damping_;
  ParallelOptions parallel_;
};

}  // namespace strutt
