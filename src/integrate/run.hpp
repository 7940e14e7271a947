#pragma once

#include <chrono>
#include <span>

#include "integrate/events.hpp"

namespace strutt::detail {

/// The budgets of one call.
class Budget {
 public:
  explicit Budget(const IntegratorOptions& options);
  /// Why no further step may be taken; `converged`: one may.
  Outcome spend_step();

 private:
  using Clock = std::chrono::steady_clock;

  const IntegratorOptions& options_;
  bool timed_;
  Clock::time_point begin_;
  long steps_ = 0;
};

/// Fills the columns of a trajectory in the order of their times.
class Recorder {
 public:
  Recorder() = default;
  Recorder(std::span<const double> times, Eigen::MatrixXd& states) : times_(times), states_(&states) {}

  bool pending() const { return next_ < times_.size(); }
  double time() const { return times_[next_]; }
  /// The column of time(), which is done with that.
  StateOut take_column() { return states_->col(static_cast<Eigen::Index>(next_++)); }

 private:
  std::span<const double> times_;
  Eigen::MatrixXd* states_ = nullptr;
  std::size_t next_ = 0;
};

/// One call of advance() or trajectory(): from where it is to one time after the other.
class Run {
 public:
  Run(Stepper& stepper, EventLocator& locator, const IntegratorOptions& options, const EventRequest* events,
      double t0, StateView state0);

  void set_recorder(Recorder recorder) { recorder_ = recorder; }
  /// Integrates one smooth piece, up to t1 or to a terminal event. False: the run is over.
  bool cross(const RightHandSide& f, double t1);

  const Eigen::VectorXd& state() const { return state_; }
  IntegrationResult take_result() { return std::move(result_); }

 private:
  bool going() const { return result_.outcome == Outcome::converged && !terminated_; }
  void hop(const RightHandSide& f, double t1);
  void step(const RightHandSide& f, double t1);
  void take_events(const RightHandSide& f);
  void record();
  double next_stop(double t1) const;

  Stepper& stepper_;
  EventLocator& locator_;
  const IntegratorOptions& options_;
  const EventRequest* events_;
  Budget budget_;
  Recorder recorder_;
  IntegrationResult result_;
  Eigen::VectorXd state_;  // at the ends of pieces; in between the stepper has it
  bool forwards_ = true;
  bool terminated_ = false;
};

}  // namespace strutt::detail
