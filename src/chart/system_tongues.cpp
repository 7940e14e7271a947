#include "chart/system_tongues.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"
#include "chart/half_period_edge.hpp"
#include "chart/stability_line.hpp"

namespace strutt {
namespace {

constexpr int kSystemGrowthSteps = 32;

Mechanism mechanism_of(std::complex<double> leading) {
  if (leading.imag() != 0.0) return Mechanism::complex_pair;
  return leading.real() > 0.0 ? Mechanism::plus_one : Mechanism::minus_one;
}

TongueEdge edge_of(StabilityLine& line, const StabilityChange& change, int crossing,
                   const TongueOptions& options) {
  const auto& unstable = line.at(change.unstable_at);
  TongueEdge edge{.order = kNoOrder,
                  .upper = !change.begins,
                  .crossing = crossing,
                  .position = change.position,
                  .error = change.error / std::max(1.0, std::abs(change.position)),
                  .mechanism = mechanism_of(unstable.leading),
                  .method = unstable.method};
  if (!(edge.error <= options.tolerance)) edge.outcome = Outcome::tolerance_not_reached;
  return edge;
}

/// From the errors of both positions.
void add_width(TongueEdge& low, TongueEdge& high, double errors) {
  const double width = high.position - low.position;
  low.width = high.width = width;
  low.width_relative_error = high.width_relative_error = std::min(1.0, errors / width + 2.0 * kUnit);
}

}  // namespace

std::vector<TongueEdge> system_tongues(MonodromyEngine& engine, const Scene& scene, const TongueLine& along,
                                       const TongueOptions& options, Evaluations* evaluations) {
  StabilityLine line(engine, scene, along.parameter, true, evaluations);
  auto changes = stability_changes(line, along.from, along.to,
                                   {.steps = options.system_steps, .cancel = options.cancel});
  for (StabilityChange& change : changes)
    if (!(change.error <= options.tolerance * std::max(1.0, std::abs(change.position))))
      sharpen(line, change, mechanism_of(line.at(change.unstable_at).leading));
  std::vector<TongueEdge> edges;
  int crossing = 0;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    edges.push_back(edge_of(line, changes[i], crossing, options));
    if (changes[i].begins) continue;
    ++crossing;
    if (i == 0) continue;  // the line begins in an unstable region
    TongueEdge &low = edges[i - 1], &high = edges[i];
    add_width(low, high, changes[i - 1].error + changes[i].error);
    if (!options.growth) continue;
    const GrowthPeak peak = largest_growth(line, low.position, high.position, kSystemGrowthSteps);
    low.growth = high.growth = peak.growth;
    low.growth_position = high.growth_position = peak.position;
  }
  return edges;
}

}  // namespace strutt
