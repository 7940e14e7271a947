#include "chart/system_nodes.hpp"

#include <algorithm>

#include "strutt/base/error.hpp"

namespace strutt {

/// Pointers into the scene let a point set its two parameters in place.
struct SystemNodes::Worker {
  Worker(const Scene& its_scene, const Axis& x_axis, const Axis& y_axis)
      : scene(its_scene), x(&parameter(scene, x_axis.parameter)), y(&parameter(scene, y_axis.parameter)) {}

  PropagatorSample sample(const std::array<double, 2>& point, const MonodromyOptions& options,
                          SystemDamping refused) {
    PropagatorSample result;
    *x = point[0];
    *y = point[1];
    try {
      const auto model = linear_model(scene);
      const auto& system = std::get<LinearPeriodicSystem>(model);
      if (damping_of(system) == refused) return result;
      const auto found = engine.compute(system, options);
      result.right_hand_sides = found.cost.right_hand_sides + found.estimate_cost.right_hand_sides;
      if (found.outcome != Outcome::converged && found.outcome != Outcome::tolerance_not_reached)
        return result;
      result.value = found.undamped.value.mantissa;
      result.error = found.undamped.error;
      result.exponent = found.undamped.value.exponent;
      result.half_damping = found.half_damping;
      result.valid = true;
    } catch (const InvalidInput&) {
      return result;
    }
    return result;
  }

  Scene scene;
  double* x;
  double* y;
  MonodromyEngine engine;
};

SystemNodes::SystemNodes(const Scene& scene, const Axis& x, const Axis& y, bool splits_damping,
                         const ParallelOptions& parallel)
    : splits_damping_(splits_damping), parallel_(parallel) {
  for (int slot = 0; slot < thread_count(parallel); ++slot)
    workers_.push_back(std::make_shared<Worker>(scene, x, y));
}

bool SystemNodes::sample(const std::vector<std::array<double, 2>>& points, double tolerance,
                         std::vector<PropagatorSample>& result) {
  result.assign(points.size(), {});
  const MonodromyOptions options{.tolerance = std::max(tolerance, 1e-13), .cancel = parallel_.cancel};
  const auto refused = splits_damping_ ? SystemDamping::inside : SystemDamping::split_off;
  const bool complete = parallel_for(points.size(), parallel_, [&](std::size_t i, int slot) {
    result[i] = workers_[static_cast<std::size_t>(slot)]->sample(points[i], options, refused);
  });
  return complete && !(parallel_.cancel != nullptr && parallel_.cancel->load());
}

}  // namespace strutt
