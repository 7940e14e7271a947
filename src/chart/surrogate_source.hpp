#pragma once

#include "chart/propagator_sample.hpp"
#include "chart/surrogate_scope.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// Where propagators come from: those of the nodes, and those to check with. Points are parameter values.
struct SurrogateSource {
  Sampling nodes, referee;
};

/// Nodes by power series; Hill equations are checked with the engine at a tighter tolerance.
SurrogateSource surrogate_source(const SurrogateScope& scope, const Scene& scene, const Axis& x,
                                 const Axis& y, const SurrogateOptions& options);

}  // namespace strutt
