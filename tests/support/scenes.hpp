#pragma once

#include <numbers>

#include "strutt/model/scene.hpp"

namespace strutt::test {

/// A damped rod on a support that moves like a cosine, with no parameter at its default but gravity.
inline Scene rod_scene(Equilibrium about = Equilibrium::hanging) {
  Scene scene;
  scene.pendulum = PendulumTable{.mass = 1.2, .length = 0.8, .damping = 0.25, .about = about};
  scene.support = SupportTable{.amplitude = 0.06, .frequency = 12.0, .phase = std::numbers::pi / 2.0};
  return scene;
}

}  // namespace strutt::test
