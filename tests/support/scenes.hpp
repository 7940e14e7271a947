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

/// Mathieu's equation in delta and epsilon, or in a and q.
inline Scene mathieu_scene(double delta, double epsilon, double damping = 0.0, bool mathieu_form = false) {
  Scene scene;
  scene.mathieu = MathieuTable{mathieu_form, delta, epsilon, damping};
  return scene;
}

/// A rod of one metre.
inline Scene rod(Equilibrium about, double amplitude, double frequency, double damping = 0.0) {
  Scene scene;
  scene.pendulum = PendulumTable{.length = 1.0, .damping = damping, .about = about};
  scene.support = SupportTable{.amplitude = amplitude, .frequency = frequency};
  return scene;
}

}  // namespace strutt::test
