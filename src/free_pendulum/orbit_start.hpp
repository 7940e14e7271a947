#pragma once

#include "free_pendulum/double_double.hpp"
#include "strutt/free_pendulum/energy.hpp"

namespace strutt {

/// A state (phi, v) in the terms the closed forms need, in twice the working precision.
struct OrbitStart {
  double turns = 0.0;        ///< phi = 2 pi turns + the angle whose half has this sine and cosine
  DoubleDouble half_sine;    ///< sin(phi/2)
  DoubleDouble half_cosine;  ///< cos(phi/2) >= 0
  DoubleDouble velocity;     ///< v
  DoubleDouble gap;          ///< |v| - 2 cos(phi/2): negative libration, positive rotation
  DoubleDouble sum;          ///< |v| + 2 cos(phi/2)
  double gap_error = 0.0;    ///< bound of the error of `gap`
  DoubleDouble reach;        ///< sqrt(v^2 + 4 sin^2(phi/2)), the velocity at the bottom
  MotionKind kind = MotionKind::equilibrium;
};

/// `velocity_error`: relative error of v (0: exact).
OrbitStart orbit_start(double angle, DoubleDouble velocity, double velocity_error);

EnergyIntegral energy_integral(const OrbitStart& start);

}  // namespace strutt
