#include "chart/surrogate_source.hpp"

#include <algorithm>
#include <memory>

#include "chart/hill_nodes.hpp"
#include "chart/system_nodes.hpp"
#include "strutt/base/parallel.hpp"

namespace strutt {
namespace {

// Of the tolerance, for the engine: the errors at the nodes that have the largest factors count where they
// are small too.
constexpr double kNodeShare = 1e-6, kCheckShare = 1e-4;
constexpr double kSystemShare = 1e-2;  // the same for systems, whose nodes are dear
constexpr double kLowestNodeTolerance = 1e-16, kLowestTolerance = 1e-13;

/// The engine at scattered points of Hill equations, one model per thread.
class HillReferee {
 public:
  HillReferee(const Scene& scene, const Axis& x, const Axis& y, const std::optional<double>& even_phase,
              const ParallelOptions& parallel)
      : parallel_(parallel) {
    for (int slot = 0; slot < thread_count(parallel_); ++slot)
      models_.push_back(std::make_unique<HillModel>(scene, x, y, even_phase));
  }

  bool sample(const std::vector<std::array<double, 2>>& points, double tolerance,
              std::vector<PropagatorSample>& result) {
    result.assign(points.size(), {});
    const bool complete = parallel_for(points.size(), parallel_, [&](std::size_t i, int slot) {
      result[i] = models_[static_cast<std::size_t>(slot)]->sample(points[i][0], points[i][1], tolerance,
                                                                  parallel_.cancel);
    });
    return complete && !(parallel_.cancel != nullptr && parallel_.cancel->load());
  }

 private:
  ParallelOptions parallel_;
  std::vector<std::unique_ptr<HillModel>> models_;
};

}  // namespace

SurrogateSource surrogate_source(const SurrogateScope& scope, const Scene& scene, const Axis& x,
                                 const Axis& y, const SurrogateOptions& options) {
  const ParallelOptions parallel{.threads = options.threads, .cancel = options.cancel};
  if (scope.is_system) {
    const auto systems = std::make_shared<SystemNodes>(scene, x, y, scope.splits_damping, parallel);
    const auto sample = [systems, tolerance = kSystemShare * options.tolerance](const auto& points,
                                                                                auto& result) {
      return systems->sample(points, tolerance, result);
    };
    return {sample, sample};
  }
  const auto nodes = std::make_shared<HillNodes>(scene, x, y, scope.even_phase, parallel);
  const auto referee = std::make_shared<HillReferee>(scene, x, y, scope.even_phase, parallel);
  return {[nodes, tolerance = std::max(kNodeShare * options.tolerance, kLowestNodeTolerance)](
              const auto& points, auto& result) { return nodes->sample(points, tolerance, result); },
          [referee, tolerance = std::max(kCheckShare * options.tolerance, kLowestTolerance)](
              const auto& points, auto& result) { return referee->sample(points, tolerance, result); }};
}

}  // namespace strutt
