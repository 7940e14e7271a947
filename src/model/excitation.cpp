#include "strutt/model/excitation.hpp"

#include <cmath>
#include <numbers>

namespace strutt {

Excitation sinusoidal_support(double amplitude, double frequency, double phase) {
  return {frequency,
          PeriodicFunction::fourier(0.0, {{1, amplitude * std::sin(phase), amplitude * std::cos(phase)}})};
}

Excitation square_acceleration_support(double amplitude, double frequency, double phase) {
  // -amplitude sign(sin(theta + phase)) = -amplitude sign(cos(theta - shift)) is d^2 r/dtheta^2
  const double shift = std::numbers::pi / 2.0 - phase;
  return {frequency, PeriodicFunction::square(0.0, -amplitude, shift, 2)};
}

}  // namespace strutt
