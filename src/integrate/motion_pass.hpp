#pragma once

#include <vector>

#include "integrate/error_box.hpp"
#include "integrate/motion_equation.hpp"
#include "strutt/integrate/integrator.hpp"

namespace strutt::detail {

/// One integration of all times, in ascending order of them, at one local tolerance.
class MotionPass {
 public:
  MotionPass(const MotionEquation& equation, const MotionOptions& options, double alpha,
             double local_tolerance);

  /// `order`: indices into `points` by ascending time. Improves the points where its bound is the smaller
  /// one.
  Outcome run(const MotionStart& start, const std::vector<std::size_t>& order,
              std::vector<MotionPoint>& points, long max_steps);

  const IntegrationCost& cost() const { return cost_; }
  const IntegrationCost& estimate_cost() const { return estimate_cost_; }

 private:
  Outcome cross(const Segment& segment, const std::vector<double>& offsets,
                const std::vector<MotionPoint*>& targets);
  Trajectory integrate(Integrator& integrator, const Segment& segment, const Eigen::VectorXd& state,
                       const std::vector<double>& offsets, double size, bool is_check);
  /// Bound of what the moment adds to v in a segment.
  double gained(const Segment& s) const { return equation_.forcing_bound() / equation_.kappa() * s.length; }
  double rounding(const Segment& segment, double size, long steps) const;
  double remainder(const Segment& segment, const Eigen::Matrix2d& propagator, double added) const;
  void record(MotionPoint& point, double half_turns, const Eigen::Vector2d& state, double error) const;
  Eigen::Vector2d slope(const Segment& segment) const;
  void rebase();
  /// Whether the steps left can lead to t, so that no minute is spent on the way to where none can.
  bool within_reach(const Segment& segment, double t) const;
  long steps_left() const { return max_steps_ - cost_.steps - estimate_cost_.steps; }

  const MotionEquation& equation_;
  const MotionOptions& options_;
  double alpha_;
  double tolerance_;
  Integrator main_;
  Integrator check_;
  long max_steps_ = 0;
  double half_turns_ = 0.0;
  Eigen::Vector2d state_;
  ErrorBox errors_{Eigen::Vector2d::Zero()};
  IntegrationCost cost_;
  IntegrationCost estimate_cost_;
};

}  // namespace strutt::detail
