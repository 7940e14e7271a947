#pragma once

#include "chart/surrogate_source.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {

inline constexpr int kChecks = 16;  ///< scattered points in each box

struct SurrogateBuild {
  SurrogateData data;
  bool cancelled = false;
};

/// Cuts the chart into boxes, fits and checks them; see Surrogate. For axes that are not refused.
SurrogateBuild build_surrogate(const Scene& scene, const Axis& x, const Axis& y,
                               const SurrogateOptions& options, const SurrogateScope& scope,
                               const SurrogateSource& source);

}  // namespace strutt
