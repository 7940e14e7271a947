#pragma once

#include <string>

#include "strutt/floquet/stability.hpp"

namespace strutt {

/// A scene with a parameter and the damping to be set.
class DampedLine {
 public:
  /// Throws InvalidInput for a scene without such a damping, and for the damping as the parameter.
  DampedLine(const Scene& scene, const std::string& path);
  DampedLine(const DampedLine&) = delete;

  const Scene& undamped() const { return scene_; }

  Stability at(double p, double damping);
  /// The damping that takes so much per period: 2 growth/T.
  double rate_of(double growth, double p);
  /// What the error of the margin is in damping, relative.
  double error(double p, double damping);

 private:
  MonodromyEngine engine_;
  Scene scene_;
  double *value_, *damping_;
};

}  // namespace strutt
