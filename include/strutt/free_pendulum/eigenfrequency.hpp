#pragma once

#include "strutt/model/pendulum.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// alpha, the angular frequency of small free oscillations, as an unevaluated sum of two doubles: over 1e9
/// periods the rounding of one double alone would turn the phase by 1e-6.
struct Eigenfrequency {
  double value = 1.0;  ///< alpha, rad/s, > 0, rounded
  double rest = 0.0;   ///< alpha - value

  /// Throws InvalidInput unless value is finite and > 0 and |rest| <= 2^-52 value.
  void validate() const;
};

/// alpha^2 = 3 g/(2 l) (rod), g/l (point mass), m g s/Theta (body) from the numbers of the scene taken as
/// exact, to a relative error of 2^-98. The table must be valid (strutt::validate).
Eigenfrequency eigenfrequency(const PendulumTable& pendulum);

}  // namespace strutt
