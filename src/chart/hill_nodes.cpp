#include "chart/hill_nodes.hpp"

#include <cmath>
#include <numbers>

namespace strutt {
namespace {

using std::numbers::pi;

constexpr std::size_t kLanes = 512;  // of a job

PropagatorSample sample_of(const PointEquation& point, const SeriesPropagation& found) {
  PropagatorSample result;
  result.exponent = found.matrix.value.exponent;
  result.half_damping = point.half_damping;
  result.kappa = point.kappa;
  result.shifted = point.shifted;
  result.right_hand_sides = found.cost.right_hand_sides;
  auto canonical = at_kappa(found.matrix.value.mantissa, found.matrix.error, 1.0 / point.kappa);
  result.value = std::move(canonical.value);
  result.error = std::move(canonical.error);
  result.valid = result.error.allFinite() && result.value.allFinite();
  return result;
}

}  // namespace

HillNodes::HillNodes(const Scene& scene, const Axis& x, const Axis& y,
                     const std::optional<double>& even_phase, const ParallelOptions& parallel)
    : parallel_(parallel),
      model_(scene, x, y, even_phase),
      length_(even_phase ? pi : 2.0 * pi),
      propagators_(static_cast<std::size_t>(thread_count(parallel))) {}

bool HillNodes::sample(const std::vector<std::array<double, 2>>& values, double tolerance,
                       std::vector<PropagatorSample>& result) {
  result.assign(values.size(), {});
  std::vector<std::optional<PointEquation>> points;
  std::vector<SeriesJob> jobs;
  std::vector<std::size_t> places;
  for (const auto& value : values) {
    const auto& point = points.emplace_back(model_.at(value[0], value[1]));
    if (!point) continue;
    jobs.push_back(
        {point->equation.coefficient, {0.0, length_}, point->kappa, point->equation.coefficient_error});
    places.push_back(points.size() - 1);
  }
  const bool complete =
      parallel_for_ranges(jobs.size(), kLanes, parallel_, [&](std::size_t first, std::size_t last, int slot) {
        const auto some = std::span(jobs).subspan(first, last - first);
        const auto found = propagators_[static_cast<std::size_t>(slot)].propagate(some, tolerance);
        for (std::size_t l = 0; l < found.size(); ++l) {
          if (found[l].cost.steps == 0) continue;
          const std::size_t place = places[first + l];
          result[place] = sample_of(*points[place], found[l]);
        }
      });
  return complete && !(parallel_.cancel != nullptr && parallel_.cancel->load());
}

}  // namespace strutt
