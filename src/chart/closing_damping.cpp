#include "strutt/chart/closing_damping.hpp"

#include <algorithm>

#include "chart/closing_tip.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

constexpr double kPromise = 1e-8;  // no smaller error is asked for

/// By the route with the smaller error.
ClosingDamping tip_of(DampedLine& damped, LineEquation& equation, const TongueLine& line,
                      const TongueEdge& low, const TongueEdge& high, const std::atomic<bool>* cancel) {
  const auto thin = tip_by_width(damped, equation, line, low, high);
  if (thin && thin->error <= kPromise) return *thin;
  const ClosingDamping wide = tip_by_multipliers(damped, line, low, high, cancel);
  return thin && !(wide.error < thin->error) ? *thin : wide;
}

}  // namespace

std::vector<ClosingDamping> closing_damping(const Scene& scene, const TongueLine& line,
                                            const TongueOptions& options) {
  const DefaultFloatingPoint environment;
  DampedLine damped(scene, line.parameter);
  LineEquation equation(damped.undamped(), line);
  std::vector<ClosingDamping> result;
  const auto edges = tongues(Scene(damped.undamped()), line, options);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const TongueEdge &low = edges[i], &high = edges[i + 1];
    const bool pair = low.order == high.order && low.crossing == high.crossing && !low.upper && high.upper;
    if (!pair || low.order == 0 || low.width == 0.0 || low.width_relative_error >= 1.0) continue;
    if (options.cancel != nullptr && *options.cancel) break;
    ClosingDamping row = tip_of(damped, equation, line, low, high, options.cancel);
    row.tongue = low.order;
    row.crossing = low.crossing;
    if (!(row.error <= std::max(options.tolerance, kPromise))) row.outcome = Outcome::tolerance_not_reached;
    result.push_back(row);
  }
  return result;
}

}  // namespace strutt
