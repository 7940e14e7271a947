#include "strutt/free_pendulum/free_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/constants.hpp"
#include "free_pendulum/agm.hpp"
#include "free_pendulum/orbit_start.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

// Relative error of what is computed in twice the working precision, with reserve.
constexpr double kDouble = 0x1p-97;

/// phi0'/alpha and its relative error, 0 if the quotient is exact.
struct Quotient {
  DoubleDouble value;
  double error;
};
Quotient divide(double velocity, DoubleDouble alpha) {
  if (velocity == 0.0) return {0.0, 0.0};
  const DoubleDouble value = DoubleDouble(velocity) / alpha;
  const bool exact =
      value.lo == 0.0 && alpha.lo == 0.0 && two_product(value.hi, alpha.hi) == DoubleDouble(velocity);
  // Next to 0 the low part is lost by underflow.
  return {value, exact ? 0.0 : 0x1p-100 + 0x1p-1070 / std::abs(value.hi)};
}

}  // namespace

/// Everything that does not depend on the time. States are those of the mirrored motion where v < 0.
struct FreeMotion::Orbit {
  DoubleDouble alpha;
  OrbitStart start;
  EnergyIntegral energy;
  MotionKind kind = MotionKind::equilibrium;
  double sign = 1.0;            ///< -1: the motion is computed mirrored
  double relative_error = 0.0;  ///< of the distance from the separatrix, and of v
  std::optional<AgmSteps> agm;  ///< of (1, k')
  DoubleDouble rate;            ///< turns (of 4K) per unit of tau
  DoubleDouble phase;           ///< turns at t = 0, or tau since the bottom on the separatrix

  void prepare();
  void prepare_libration();
  void prepare_rotation();
  FreeState local_state(DoubleDouble tau) const;
  FreeState libration_state(DoubleDouble turns) const;
  FreeState rotation_state(DoubleDouble turns, DoubleDouble& revolutions) const;
  FreeState separatrix_state(DoubleDouble tau) const;
  double exact_error(DoubleDouble tau) const;
};

void FreeMotion::Orbit::prepare() {
  kind = start.kind;
  if (kind == MotionKind::unresolved) {
    kind = start.gap.hi < 0.0 ? MotionKind::libration : MotionKind::rotation;
    if (start.gap.hi == 0.0) kind = MotionKind::separatrix;
  }
  if (kind != MotionKind::libration && start.velocity.hi < 0.0) sign = -1.0;
  if (start.gap.hi != 0.0) relative_error += start.gap_error / std::abs(start.gap.hi);
  if (kind == MotionKind::libration) prepare_libration();
  if (kind == MotionKind::rotation) prepare_rotation();
  // tan(phi/2) = sinh(tau)
  if (kind == MotionKind::separatrix) {
    const DoubleDouble tangent = start.half_sine / start.half_cosine;
    phase = sign * std::asinh(tangent.hi);
  }
}

/// sin(psi) = sin(phi/2)/k, cos(psi) = v/(2k): the quadrant is told by the signs.
void FreeMotion::Orbit::prepare_libration() {
  agm.emplace(1.0, ldexp(sqrt(-start.gap) * sqrt(start.sum), -1));
  rate = agm->mean() / kTwoPi;
  // Scaled, so that no low part underflows.
  const int scale = -std::ilogb(start.reach.hi);
  const DoubleDouble sine = ldexp(abs(start.half_sine), scale + 1),
                     velocity = ldexp(abs(start.velocity), scale);
  phase = sine.hi == 0.0 ? DoubleDouble() : agm->turns_of(velocity / sine);
  if (start.velocity.hi < 0.0) phase = DoubleDouble(0.5) - phase;
  if (start.half_sine.hi < 0.0) phase = -phase;
}

void FreeMotion::Orbit::prepare_rotation() {
  agm.emplace(1.0, sqrt(start.gap) * sqrt(start.sum) / start.reach);
  rate = agm->mean() * start.reach / ldexp(kTwoPi, 1);
  const DoubleDouble sine = abs(start.half_sine);
  phase = sine.hi == 0.0 ? DoubleDouble() : agm->turns_of(start.half_cosine / sine);
  if (sign * start.half_sine.hi < 0.0) phase = -phase;
}

FreeState FreeMotion::Orbit::libration_state(DoubleDouble turns) const {
  const auto a = agm->amplitude(turns);
  const DoubleDouble k = ldexp(start.reach, -1);
  return {2.0 * std::atan2((k * a.sn).hi, a.dn.hi), (start.reach * a.cn).hi, 0.0};
}

FreeState FreeMotion::Orbit::rotation_state(DoubleDouble turns, DoubleDouble& revolutions) const {
  // Beyond 2^53 turns the low part holds whole turns, too.
  const double high = std::round(turns.hi), low = std::round((turns - DoubleDouble(high)).hi);
  const auto a = agm->amplitude((turns - DoubleDouble(high)) - DoubleDouble(low));
  revolutions = ldexp(DoubleDouble(high) + DoubleDouble(low), 1);
  return {2.0 * std::atan2(a.sn.hi, a.cn.hi), (start.reach * a.dn).hi, 0.0};
}

FreeState FreeMotion::Orbit::separatrix_state(DoubleDouble tau) const {
  const double velocity = separatrix_velocity(tau.hi);
  return {separatrix_angle(tau.hi) + velocity * tau.lo, velocity, 0.0};
}

/// What the errors of the double-double quantities do to the angle after tau: an error of the phase moves the
/// state along the orbit, at most with the velocity at the bottom; so does a relative error of the excess,
/// through the period and the phase at the start. While the orbit is not told from the separatrix, the growth
/// e^tau of any perturbation is the bound.
double FreeMotion::Orbit::exact_error(DoubleDouble tau) const {
  const double elapsed = std::abs(tau.hi);
  if (kind == MotionKind::equilibrium) return 0.0;
  const double growing = 1.5 * (start.gap_error + kDouble * start.reach.hi) * std::exp(elapsed);
  if (kind == MotionKind::separatrix) {
    const double rounding = 4.0 * kUnit * separatrix_velocity((phase + tau).hi) * (std::abs(phase.hi) + 1.0);
    return start.gap_error == 0.0 ? rounding : rounding + growing;
  }
  const double period = 1.0 / rate.hi;
  const double along = (elapsed + period + 8.0) * (relative_error + kDouble) * start.reach.hi;
  return std::min(growing, relative_error < 0.25 ? along : kInfinity);
}

FreeState FreeMotion::Orbit::local_state(DoubleDouble tau) const {
  FreeState state;
  DoubleDouble revolutions = 0.0;
  if (kind == MotionKind::libration) {
    const DoubleDouble turns = phase + tau * rate;
    const double high = std::round(turns.hi), low = std::round((turns - DoubleDouble(high)).hi);
    state = libration_state((turns - DoubleDouble(high)) - DoubleDouble(low));
  }
  if (kind == MotionKind::rotation) state = rotation_state(phase + tau * rate, revolutions);
  if (kind == MotionKind::separatrix) state = separatrix_state(phase + tau);
  const DoubleDouble whole = kTwoPi * (DoubleDouble(start.turns) + DoubleDouble(sign) * revolutions);
  const double local = sign * state.angle;
  state.angle = (whole + DoubleDouble(local)).hi;
  state.velocity *= sign;
  state.error = exact_error(tau) + kUnit * (4.0 * std::abs(local) + std::abs(state.angle));
  state.error += 4.0 * std::numeric_limits<double>::denorm_min();  // roundings below the least normal number
  return state;
}

FreeMotion::FreeMotion(const Eigenfrequency& alpha, double angle, double velocity) {
  const DefaultFloatingPoint environment;
  alpha.validate();
  require(std::isfinite(velocity), "velocity", velocity, "finite");
  auto orbit = std::make_shared<Orbit>();
  orbit->alpha = {alpha.value, alpha.rest};
  const Quotient quotient = divide(velocity, orbit->alpha);
  orbit->start = orbit_start(angle, quotient.value, quotient.error);
  orbit->relative_error = quotient.error;
  orbit->energy = energy_integral(orbit->start);
  orbit->prepare();
  orbit_ = std::move(orbit);
}

const EnergyIntegral& FreeMotion::energy() const { return orbit_->energy; }

FreeState FreeMotion::at(double t) const {
  const DefaultFloatingPoint environment;
  require(std::isfinite(t), "t", t, "finite");
  const DoubleDouble tau = orbit_->alpha * DoubleDouble(t);
  // The phase itself must be finite.
  if (!std::isfinite((tau * DoubleDouble(std::max(1.0, orbit_->start.reach.hi))).hi))
    return {kNaN, kNaN, kInfinity};
  FreeState state = orbit_->local_state(tau);
  state.velocity *= orbit_->alpha.hi;
  return state;
}

Motion free_motion(const Eigenfrequency& alpha, const MotionStart& start, std::span<const double> times,
                   double tolerance, const std::atomic<bool>* cancel) {
  const DefaultFloatingPoint environment;
  require(tolerance > 0.0, "tolerance", tolerance, "> 0");
  for (const double t : times) require(t >= 0.0 && std::isfinite(t), "t", t, "finite and >= 0");
  const FreeMotion motion(alpha, start.angle, start.velocity);
  Motion result;
  result.method = Method::exact;
  result.points.reserve(times.size());
  for (const double t : times) {
    result.cancelled = cancel != nullptr && cancel->load(std::memory_order_relaxed);
    if (result.cancelled) break;
    const FreeState state = motion.at(t);
    const Outcome outcome = state.error <= tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
    result.points.push_back(
        {t, state.angle, state.velocity, motion.energy().separatrix_excess, state.error, outcome});
  }
  return result;
}

}  // namespace strutt
