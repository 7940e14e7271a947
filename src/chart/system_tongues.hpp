#pragma once

#include <vector>

#include "chart/evaluations.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/monodromy.hpp"

namespace strutt {

/// tongues() of a system that is no equation of second order: where the line enters and leaves what is
/// unstable, as seen from kSystemSteps + 1 points, with the multiplier that leaves the unit circle there.
std::vector<TongueEdge> system_tongues(MonodromyEngine& engine, const Scene& scene, const TongueLine& line,
                                       const TongueOptions& options, Evaluations* evaluations = nullptr);

}  // namespace strutt
