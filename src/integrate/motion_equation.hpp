#pragma once

#include <vector>

#include "strutt/integrate/motion.hpp"

namespace strutt::detail {

/// A phase as whole turns and a rest of twice the working precision: 2 pi turns + high + low, 0 <= high < 2
/// pi.
struct Phase {
  double turns = 0.0;
  double high = 0.0;
  double low = 0.0;
};

/// An angle as half_turns * pi + rest; half_turns is an integer.
struct SplitAngle {
  double half_turns = 0.0;
  double rest = 0.0;
};

SplitAngle split_angle(double angle, double half_turns);  ///< with these half turns
SplitAngle split_angle(double angle);                     ///< with the nearest ones
double joined(const SplitAngle& angle);                   ///< rounded once

/// A stretch of phase without jumps of the coefficient, about a radian of motion long.
struct Segment {
  double turn = 0.0;
  std::size_t piece = 0;
  double part = 0.0;
  double begin = 0.0;  ///< phase within the turn
  double length = 0.0;
};

/// Equation (7) in the phase theta = frequency t and the scaled state (x, v), x = angle - half_turns pi,
/// dx/dtheta = kappa v:
///   dv/dtheta = [F(theta) - s W(theta) S(x)]/kappa - d v,   S(x) = sin x or x,   s = +-1 with the parity of
///   half_turns.
class MotionEquation {
 public:
  MotionEquation(const PhysicalPendulum& pendulum, const Excitation* support, const Excitation* moment,
                 bool linear);

  double frequency() const { return frequency_; }
  double kappa() const { return kappa_; }
  bool linear() const { return linear_; }
  int highest_order() const { return highest_order_; }
  double coefficient_bound() const { return coefficient_bound_; }  ///< of |W|
  double forcing_bound() const { return forcing_.bound(); }        ///< of |F|

  Phase phase(double t) const;
  Segment first_segment() const { return segment(0.0, 0, 0.0); }
  Segment next(const Segment& segment) const;
  /// How far the phase lies behind the beginning of the segment.
  double offset(const Segment& segment, const Phase& phase) const;

  /// Lower bound of the number of segments in `phase` radians; a whole number of turns is exact.
  double segments_in(double phase) const;

  /// Upper bound, in radians, of how far the motion turns in a segment.
  double radians(const Segment& segment) const;

  /// Time derivative of (x, v), and with 6 components that of (x, v, first column, second column) of the
  /// variational equation, at `offset` behind the beginning of the segment.
  void derivative(const Segment& segment, double half_turns, double offset, StateView y, StateOut dydt) const;

 private:
  struct Piece {
    double begin, length;  // phase
    double parts;          // segments in it
    PeriodicFunction coefficient;
  };

  Segment segment(double turn, std::size_t piece, double part) const;

  bool linear_;
  double frequency_ = 1.0;
  double damping_ = 0.0;  // per radian of phase
  double kappa_ = 1.0;
  double coefficient_bound_ = 1.0;
  int highest_order_ = 1;
  PeriodicFunction forcing_;
  std::vector<Piece> pieces_;  // of one turn
};

}  // namespace strutt::detail
