#pragma once

#include "strutt/chart/surrogate.hpp"

namespace strutt {

struct SurrogateBuild {
  SurrogateData data;
  bool cancelled = false;
};

/// Cuts the chart into boxes, fits and checks them; see Surrogate. For axes that are not refused.
SurrogateBuild build_surrogate(const Scene& scene, const Axis& x, const Axis& y,
                               const SurrogateOptions& options);

}  // namespace strutt
