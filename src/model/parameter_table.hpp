#pragma once

#include <vector>

#include "strutt/model/scene.hpp"

namespace strutt {

/// One numeric parameter of a scene: what it is, and where it stands.
struct ParameterEntry {
  ParameterInfo info;
  double* value;
};

/// Every parameter of the scene, in the order of the scene file. The pointers live as long as the scene is
/// not moved and no list in it changes its length.
std::vector<ParameterEntry> parameter_table(Scene& scene);

}  // namespace strutt
