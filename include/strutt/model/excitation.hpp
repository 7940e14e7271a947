#pragma once

#include "strutt/model/periodic_function.hpp"

namespace strutt {

/// A periodic quantity of time, value(t) = function(frequency * t): the height r of the support (m) or the
/// moment (N m).
struct Excitation {
  double frequency = 1.0;  ///< rad/s, > 0
  PeriodicFunction function;

  double value(double t) const { return function(frequency * t); }
};

/// r(t) = amplitude sin(frequency t + phase).
Excitation sinusoidal_support(double amplitude, double frequency, double phase = 0.0);

/// r'' = -amplitude frequency^2 sign(sin(frequency t + phase)) with the means of r and r' zero: the support
/// that makes (7) a Meissner equation. The largest |r| is amplitude pi^2/8.
Excitation square_acceleration_support(double amplitude, double frequency, double phase = 0.0);

}  // namespace strutt
