#include "strutt/free_pendulum/energy.hpp"

#include <cmath>

#include "base/constants.hpp"
#include "free_pendulum/orbit_start.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

// Relative error of a cosine of sin_cos, with reserve.
constexpr double kCosineError = 0x1p-100;

MotionKind kind_of(const OrbitStart& start) {
  if (start.reach.hi == 0.0) return MotionKind::equilibrium;
  if (start.gap.hi == 0.0 && start.gap_error == 0.0) return MotionKind::separatrix;
  if (std::abs(start.gap.hi) <= start.gap_error) return MotionKind::unresolved;
  return start.gap.hi < 0.0 ? MotionKind::libration : MotionKind::rotation;
}

/// Turning points of 2 sin(phi/2) = reach, 2 cos(phi/2) = top, the distance of the separatrix.
void set_turning_points(EnergyIntegral& integral, DoubleDouble reach, DoubleDouble top) {
  integral.amplitude = 2.0 * atan2(reach, top).hi;
  integral.from_top = 2.0 * atan2(top, reach).hi;
}

void set_derived(EnergyIntegral& integral, DoubleDouble reach, DoubleDouble top) {
  integral.maximal_velocity = reach.hi;
  switch (integral.kind) {
    case MotionKind::rotation:
      integral.minimal_velocity = top.hi;
      [[fallthrough]];
    case MotionKind::unresolved:
      integral.amplitude = kNaN;
      break;
    case MotionKind::separatrix:
      integral.amplitude = kPi.hi;
      break;
    case MotionKind::equilibrium:
      integral.from_top = kPi.hi;
      break;
    case MotionKind::libration:
      set_turning_points(integral, reach, top);
      break;
  }
}

}  // namespace

std::string_view to_string(MotionKind kind) {
  switch (kind) {
    case MotionKind::equilibrium:
      return "equilibrium";
    case MotionKind::libration:
      return "libration";
    case MotionKind::separatrix:
      return "separatrix";
    case MotionKind::rotation:
      return "rotation";
    case MotionKind::unresolved:
      break;
  }
  return "unresolved";
}

OrbitStart orbit_start(double angle, DoubleDouble velocity, double velocity_error) {
  constexpr double kFurthest = 1e9;
  require(std::abs(angle) <= kFurthest, "angle", angle, "from -1e9 to 1e9");
  require(std::isfinite(velocity.hi), "velocity", velocity.hi, "finite");
  OrbitStart start;
  const HalfTurns half = half_turns(0.5 * angle);
  start.turns = half.count;
  start.half_sine = half.rest.sine;
  start.half_cosine = half.rest.cosine;
  start.velocity = velocity;
  const DoubleDouble speed = abs(velocity), top = ldexp(start.half_cosine, 1);
  start.gap = speed - top;
  start.sum = speed + top;
  start.gap_error = (angle == 0.0 ? 0.0 : kCosineError * top.hi) + velocity_error * speed.hi;
  start.reach = hypot(velocity, ldexp(start.half_sine, 1));
  start.kind = kind_of(start);
  return start;
}

EnergyIntegral energy_integral(const OrbitStart& start) {
  EnergyIntegral integral;
  integral.kind = start.kind;
  integral.separatrix_excess = start.gap.hi * start.sum.hi;
  if (std::isfinite(integral.separatrix_excess)) integral.separatrix_excess = (start.gap * start.sum).hi;
  integral.error = start.gap_error * start.sum.hi + kUnit * std::abs(integral.separatrix_excess);
  set_derived(integral, start.reach, sqrt(abs(start.gap)) * sqrt(start.sum));
  return integral;
}

EnergyIntegral energy_integral(double angle, double velocity) {
  const DefaultFloatingPoint environment;
  return energy_integral(orbit_start(angle, velocity, 0.0));
}

EnergyIntegral energy_integral(double separatrix_excess) {
  const DefaultFloatingPoint environment;
  const double e = separatrix_excess;
  require(e >= -4.0 && std::isfinite(e), "separatrix_excess", e, "finite and >= -4");
  EnergyIntegral integral{.separatrix_excess = e};
  integral.kind = e == -4.0  ? MotionKind::equilibrium
                  : e < 0.0  ? MotionKind::libration
                  : e == 0.0 ? MotionKind::separatrix
                             : MotionKind::rotation;
  set_derived(integral, sqrt(two_sum(4.0, e)), sqrt(DoubleDouble(std::abs(e))));
  return integral;
}

EquilibriumPoint equilibrium_point(int index, double alpha) {
  const DefaultFloatingPoint environment;
  require(alpha > 0.0 && std::isfinite(alpha), "alpha", alpha, "finite and > 0");
  EquilibriumPoint point;
  point.angle = index * kPi.hi;
  const bool saddle = index % 2 != 0;
  point.type = saddle ? EquilibriumPoint::Type::saddle : EquilibriumPoint::Type::centre;
  const std::complex<double> lambda = saddle ? std::complex(alpha, 0.0) : std::complex(0.0, alpha);
  point.eigenvalues = {lambda, -lambda};
  point.eigenvectors << 1.0, 1.0, lambda, -lambda;
  return point;
}

double separatrix_angle(double tau) {
  const DefaultFloatingPoint environment;
  return 2.0 * std::atan(std::sinh(tau));
}

double separatrix_velocity(double tau) {
  const DefaultFloatingPoint environment;
  const double decay = std::exp(-std::abs(tau));
  return 4.0 * decay / (1.0 + decay * decay);
}

double separatrix_time(double angle) {
  const DefaultFloatingPoint environment;
  require(std::abs(angle) <= kPi.hi, "angle", angle, "between -pi and pi");
  return std::asinh(std::tan(0.5 * angle));
}

}  // namespace strutt
