#pragma once

#include "chart/propagator_sample.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {

struct SurrogateBuild {
  SurrogateData data;
  bool cancelled = false;
};

/// Where propagators come from: those of the nodes, and those to check with.
struct SurrogateSource {
  Sampling nodes, referee;
};

/// Cuts the chart into boxes, fits and checks them; see Surrogate. For axes that are not refused.
SurrogateBuild build_surrogate(const Scene& scene, const Axis& x, const Axis& y,
                               const SurrogateOptions& options);
SurrogateBuild build_surrogate(const Scene& scene, const Axis& x, const Axis& y,
                               const SurrogateOptions& options, const SurrogateSource& source);

}  // namespace strutt
