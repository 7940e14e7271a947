#pragma once

#include "strutt/chart/stability_margin.hpp"

namespace strutt {

/// False for a parameter without influence, and for one that takes a system with reciprocal multipliers out
/// of that class: stability could not be proved on any side of the design.
bool keeps_structure(const Scene& scene, const std::string& path);

/// JointMargin of a design with that verdict, stable or unstable; `alone` are the margins of its parameters.
JointMargin joint_margin(const Scene& scene, Verdict verdict, const std::vector<ParameterMargin>& alone,
                         const MarginOptions& options);

}  // namespace strutt
