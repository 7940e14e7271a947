#pragma once

#include <arkode/arkode_erkstep.h>
#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <numbers>
#include <stdexcept>

#include "integrate/sundials_tables.hpp"
#include "integrate/sundials_vector.hpp"
#include "mathieu_points.hpp"

/// The loops a user would write by hand around bare SUNDIALS: one stepper, restarted point after point, a C
/// right-hand side with the equation written out, nothing checked. They are what Strutt is measured against.
namespace benchmarks {

/// What the right-hand side reads: x'' + (delta + epsilon cos t) x = 0 for both columns of [x; x'/kappa].
struct Mathieu {
  double delta, epsilon, kappa;
  long calls;
};

inline int mathieu_right_hand_side(double t, N_Vector state, N_Vector rate, void* data) {
  auto& p = *static_cast<Mathieu*>(data);
  ++p.calls;
  const double* y = N_VGetArrayPointer(state);
  double* dydt = N_VGetArrayPointer(rate);
  const double stiffness = -(p.delta + p.epsilon * std::cos(t)) / p.kappa;
  dydt[0] = p.kappa * y[1];
  dydt[1] = stiffness * y[0];
  dydt[2] = p.kappa * y[3];
  dydt[3] = stiffness * y[2];
  return 0;
}

inline void require_success(int flag) {
  if (flag < 0) throw std::runtime_error("SUNDIALS flag " + std::to_string(flag));
}

/// What both steppers need: a context and the state, its linear combinations fused into one sweep.
class SundialsState {
 public:
  explicit SundialsState(bool own_sums = false) {
    require_success(SUNContext_Create(nullptr, &context_));
    y_ = own_sums ? strutt::detail::make_state_vector(4, context_).release() : N_VNew_Serial(4, context_);
    if (!own_sums) require_success(N_VEnableFusedOps_Serial(y_, SUNTRUE));
    N_VConst(0.0, y_);
  }
  SundialsState(const SundialsState&) = delete;
  SundialsState& operator=(const SundialsState&) = delete;
  ~SundialsState() {
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  SUNContext context() const { return context_; }
  N_Vector y() const { return y_; }
  double* values() const { return N_VGetArrayPointer(y_); }
  void set_identity() {
    values()[0] = values()[3] = 1.0;
    values()[1] = values()[2] = 0.0;
  }

 private:
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
};

enum class Span { half_period, period };

inline double length(Span span) {
  return span == Span::half_period ? std::numbers::pi : 2.0 * std::numbers::pi;
}

/// M from the state at the end of the span.
inline Matrix monodromy(Span span, const double* y) {
  return span == Span::half_period ? period_from_half(y[0], y[2], y[1], y[3])
                                   : Matrix{y[0], y[2], y[1], y[3]};
}

/// What a user who knows ARKODE well changes of its step control.
struct StepControl {
  double first_step_radians = 0.0;  // times tolerance^(1/order); 0: left to ARKODE
  bool grow_at_once = false;        // ARKODE keeps the step until it could grow by half
  bool own_sums = false;            // the vectors of Strutt's steppers, not those of SUNDIALS
};

/// ARKODE's explicit steppers.
class ArkodeLoop {
 public:
  ArkodeLoop(Span span, strutt::detail::ButcherTable table, StepControl control)
      : span_(span), control_(control), order_(table->q), state_(control.own_sums) {
    memory_ = ERKStepCreate(mathieu_right_hand_side, 0.0, state_.y(), state_.context());
    require_success(ERKStepSetTable(memory_, table.get()));
    require_success(ERKStepSetUserData(memory_, &problem_));
    require_success(ERKStepSetMaxNumSteps(memory_, 1'000'000));
    if (control.grow_at_once) require_success(ERKStepSetFixedStepBounds(memory_, 1.0, 1.0));
  }
  ArkodeLoop(const ArkodeLoop&) = delete;
  ArkodeLoop& operator=(const ArkodeLoop&) = delete;
  ~ArkodeLoop() { ERKStepFree(&memory_); }

  void set_tolerance(double tolerance) {
    first_step_radians_ = control_.first_step_radians * std::pow(tolerance, 1.0 / order_);
    require_success(ERKStepSStolerances(memory_, tolerance, tolerance));
  }

  Matrix compute(const Point& point, long& right_hand_sides) {
    problem_ = {point.delta, point.epsilon, point.kappa, 0};
    const double frequency = std::sqrt(std::abs(point.delta) + std::abs(point.epsilon));
    state_.set_identity();
    require_success(ERKStepReInit(memory_, mathieu_right_hand_side, 0.0, state_.y()));
    require_success(ERKStepSetInitStep(memory_, first_step_radians_ / frequency));
    require_success(ERKStepSetStopTime(memory_, length(span_)));
    double t = 0.0;
    require_success(ERKStepEvolve(memory_, length(span_), state_.y(), &t, ARK_NORMAL));
    right_hand_sides += problem_.calls;
    return monodromy(span_, state_.values());
  }

 private:
  Span span_;
  StepControl control_;
  int order_;
  double first_step_radians_ = 0.0;
  Mathieu problem_{};
  SundialsState state_;
  void* memory_ = nullptr;
};

/// CVODE's Adams-Moulton methods with fixed-point iteration.
class CvodeLoop {
 public:
  explicit CvodeLoop(Span span) : span_(span) {
    memory_ = CVodeCreate(CV_ADAMS, state_.context());
    require_success(CVodeInit(memory_, mathieu_right_hand_side, 0.0, state_.y()));
    solver_ = SUNNonlinSol_FixedPoint(state_.y(), 0, state_.context());
    require_success(CVodeSetNonlinearSolver(memory_, solver_));
    require_success(CVodeSetUserData(memory_, &problem_));
    require_success(CVodeSetMaxNumSteps(memory_, 1'000'000));
  }
  CvodeLoop(const CvodeLoop&) = delete;
  CvodeLoop& operator=(const CvodeLoop&) = delete;
  ~CvodeLoop() {
    CVodeFree(&memory_);
    SUNNonlinSolFree(solver_);
  }

  void set_tolerance(double tolerance) { require_success(CVodeSStolerances(memory_, tolerance, tolerance)); }

  Matrix compute(const Point& point, long& right_hand_sides) {
    problem_ = {point.delta, point.epsilon, point.kappa, 0};
    state_.set_identity();
    require_success(CVodeReInit(memory_, 0.0, state_.y()));
    require_success(CVodeSetStopTime(memory_, length(span_)));
    double t = 0.0;
    require_success(CVode(memory_, length(span_), state_.y(), &t, CV_NORMAL));
    right_hand_sides += problem_.calls;
    return monodromy(span_, state_.values());
  }

 private:
  Span span_;
  Mathieu problem_{};
  SundialsState state_;
  void* memory_ = nullptr;
  SUNNonlinearSolver solver_ = nullptr;
};

}  // namespace benchmarks
