#include "integrate/motion_equation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"

namespace strutt::detail {
namespace {

using std::numbers::pi;

// pi = pi + kPiLow, 2 pi likewise: the part of pi that a double leaves out.
constexpr double kPiLow = 1.2246467991473532e-16;

// A motion turns at most about this far in one segment: the linear estimate of its sensitivity then holds.
constexpr double kSegmentRadians = 3.0;

// Jumps closer to each other, or to the end of the turn, than this are one.
constexpr double kSamePhase = 4e-15;

double checked_frequency(const PhysicalPendulum& pendulum, const Excitation* support,
                         const Excitation* moment) {
  const bool beats = moment != nullptr && !moment->function.is_constant();
  const auto valid = [](const char* name, double value) {
    require(value > 0.0 && std::isfinite(value), name, value, "a finite number > 0");
    return value;
  };
  if (support != nullptr && beats && moment->frequency != support->frequency) {
    throw InvalidInput("moment.frequency", to_text(moment->frequency), "that of the support");
  }
  if (support != nullptr) return valid("support.frequency", support->frequency);
  if (beats) return valid("moment.frequency", moment->frequency);
  return valid("alpha", pendulum.alpha());
}

}  // namespace

SplitAngle split_angle(double angle, double half_turns) {
  return {half_turns, std::fma(-half_turns, pi, angle) - half_turns * kPiLow};
}

SplitAngle split_angle(double angle) { return split_angle(angle, std::nearbyint(angle / pi)); }

double joined(const SplitAngle& angle) {
  const double product = angle.half_turns * pi;
  const double low = std::fma(angle.half_turns, pi, -product) + angle.half_turns * kPiLow;
  return product + (angle.rest + low);
}

MotionEquation::MotionEquation(const PhysicalPendulum& pendulum, const Excitation* support,
                               const Excitation* moment, bool linear)
    : linear_(linear) {
  pendulum.validate();
  frequency_ = checked_frequency(pendulum, support, moment);
  const double square = frequency_ * frequency_;
  damping_ = pendulum.damping / frequency_;
  PeriodicFunction coefficient = PeriodicFunction::constant(pendulum.alpha_squared() / square);
  if (support != nullptr) {
    const auto acceleration = support->function.derivative().derivative();  // per radian^2
    coefficient = acceleration.scaled(pendulum.alpha_squared() / pendulum.gravity).plus(coefficient.mean());
  }
  if (moment != nullptr) forcing_ = moment->function.scaled(1.0 / (pendulum.inertia * square));
  coefficient_bound_ = coefficient.bound();
  kappa_ = std::sqrt(coefficient_bound_);
  highest_order_ = std::max({1, coefficient.highest_order(), forcing_.highest_order()});

  std::vector<double> ends;
  for (const double jump : coefficient.breakpoints(0.0, 2.0 * pi)) {
    const double last = ends.empty() ? 0.0 : ends.back();
    if (jump - last > kSamePhase && 2.0 * pi - jump > kSamePhase) ends.push_back(jump);
  }
  ends.push_back(2.0 * pi);
  double begin = 0.0;
  for (const double end : ends) {
    const double parts = std::max(1.0, std::ceil((end - begin) * kappa_ / kSegmentRadians));
    pieces_.push_back({begin, end - begin, parts, coefficient.piece(0.5 * (begin + end))});
    begin = end;
  }
}

Phase MotionEquation::phase(double t) const {
  const double product = frequency_ * t;
  const double error = std::fma(frequency_, t, -product);
  const double turns = std::floor(product / (2.0 * pi));
  const double whole = turns * (2.0 * pi);
  const double whole_error = std::fma(turns, 2.0 * pi, -whole) + turns * (2.0 * kPiLow);
  const double low = error - whole_error;
  const double high = (product - whole) + low;
  return {turns, high, ((product - whole) - high) + low};
}

Segment MotionEquation::segment(double turn, std::size_t piece, double part) const {
  const double length = pieces_[piece].length / pieces_[piece].parts;
  return {turn, piece, part, pieces_[piece].begin + part * length, length};
}

Segment MotionEquation::next(const Segment& s) const {
  if (s.part + 1.0 < pieces_[s.piece].parts) return segment(s.turn, s.piece, s.part + 1.0);
  if (s.piece + 1 < pieces_.size()) return segment(s.turn, s.piece + 1, 0.0);
  return segment(s.turn + 1.0, 0, 0.0);
}

double MotionEquation::offset(const Segment& s, const Phase& phase) const {
  const double turns = (phase.turns - s.turn) * (2.0 * pi);
  const double product = s.part * s.length;
  const double low = phase.low - std::fma(s.part, s.length, -product);
  return turns + (((phase.high - pieces_[s.piece].begin) - product) + low);
}

double MotionEquation::segments_in(double phase) const {
  double in_a_turn = 0.0;
  for (const auto& piece : pieces_) in_a_turn += piece.parts;
  return std::floor(phase / (2.0 * pi)) * in_a_turn;
}

double MotionEquation::radians(const Segment& s) const { return s.length * (kappa_ + damping_); }

void MotionEquation::derivative(const Segment& s, double half_turns, double offset, StateView y,
                                StateOut dydt) const {
  const double theta = s.begin + offset;
  const double sign = std::fmod(half_turns, 2.0) == 0.0 ? 1.0 : -1.0;
  const double stiffness = sign * pieces_[s.piece].coefficient(theta) / kappa_;
  const double restoring = linear_ ? y[0] : std::sin(y[0]);
  dydt[0] = kappa_ * y[1];
  dydt[1] = forcing_(theta) / kappa_ - stiffness * restoring - damping_ * y[1];
  if (y.size() == 2) return;
  const double slope = stiffness * (linear_ ? 1.0 : std::cos(y[0]));
  for (const Eigen::Index column : {2, 4}) {
    dydt[column] = kappa_ * y[column + 1];
    dydt[column + 1] = -slope * y[column] - damping_ * y[column + 1];
  }
}

}  // namespace strutt::detail
