#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "strutt/base/outcome.hpp"
#include "strutt/integrate/problem.hpp"

namespace strutt {

/// The steppers, all from SUNDIALS.
enum class Backend {
  arkode_erk,   ///< ARKODE, embedded explicit Runge-Kutta
  cvode_adams,  ///< CVODE, variable-order Adams-Moulton with fixed-point iteration (non-stiff)
  cvode_bdf,    ///< CVODE, variable-order BDF with Newton iteration and dense difference-quotient Jacobian
                ///< (stiff)
};

/// What a stepper is told. The local error e of a step is accepted when
///   sqrt(mean_i (e_i/(relative_tolerance |y_i| + absolute_tolerance))^2) <= 1.
/// With absolute_tolerance 0 a run ends in Outcome::tolerance_not_reached where a component is zero.
struct IntegratorOptions {
  Backend backend = Backend::arkode_erk;
  int order = 8;  ///< ARKODE only: 2, 3, 4, 5, 6 or 8 (Dormand and Prince's 8(7))
  double relative_tolerance =
      1e-9;  ///< > 0; below 1e-15 the run ends in Outcome::tolerance_not_reached at once
  double absolute_tolerance = 1e-9;  ///< >= 0, one value for all components: scale the state
  double max_step = std::numeric_limits<double>::infinity();  ///< > 0, bound of |step|
  double first_step = 0.0;      ///< |first step| to try, >= 0, finite; 0: the stepper's own, cautious choice
  long max_steps = 10'000'000;  ///< >= 1, budget of accepted steps per call
  double max_seconds =
      std::numeric_limits<double>::infinity();  ///< >= 0, budget of (monotonic) time per call
  const std::atomic<bool>* cancel = nullptr;    ///< looked at on every step

  void validate() const;  ///< throws InvalidInput naming field, value and range
};

/// What it cost.
struct IntegrationCost {
  long steps = 0;             ///< accepted steps
  long rejections = 0;        ///< attempts that failed the error test or the nonlinear iteration
  long right_hand_sides = 0;  ///< evaluations of f, those for Jacobians and for locating events included

  IntegrationCost& operator+=(const IntegrationCost& other);
};

/// How a run ended and what it reached. With any outcome but `converged`, `t` and the state are the last
/// accepted ones; after a terminal event they are those of the event.
struct IntegrationResult {
  Outcome outcome = Outcome::converged;
  double t = 0.0;
  IntegrationCost cost;
  std::vector<Event> events;  ///< in order of time, if any were asked for
};

/// States at requested times: column j of `states` (dimension x times) belongs to times[j]; columns that were
/// not reached are NaN.
struct Trajectory {
  IntegrationResult result;
  Eigen::MatrixXd states;
};

/// One reusable stepper of fixed dimension. Construction allocates; every later call starts afresh from the
/// state it is given, so that results do not depend on what was integrated before, and allocates nothing of
/// size `dimension` inside the stepper. Not thread-safe: one Integrator (it owns one SUNContext) per thread.
class Integrator {
 public:
  /// dimension >= 1. Throws InvalidInput for bad options.
  Integrator(int dimension, const IntegratorOptions& options);
  ~Integrator();
  Integrator(Integrator&&) noexcept;
  Integrator& operator=(Integrator&&) noexcept;

  /// Changes tolerances, maximal step and budgets for later calls. Throws InvalidInput for bad options and
  /// for another backend or order.
  void set_options(const IntegratorOptions& options);
  const IntegratorOptions& options() const;

  /// Integrates y' = f(t, y) from t0 to t1 (either direction, landing exactly on t1); `state` is advanced in
  /// place. Non-finite initial states, times or right-hand sides are outcomes. What f or the event function
  /// throw is passed on, with `state` as it was before.
  IntegrationResult advance(const RightHandSide& f, double t0, double t1, Eigen::Ref<Eigen::VectorXd> state,
                            const EventRequest* events = nullptr);

  /// States at `times` (monotonic in the direction of the run, first one not before t0). Each is a step end
  /// (ARKODE, whose interpolant is less accurate than its steps) or is interpolated to the accuracy of the
  /// steps (CVODE). Restarts at each of `breakpoints` (ascending), where f may jump; `f` is called with
  /// `interior`, the middle of the current smooth piece (between neighbouring breakpoints, t0 and the last
  /// time), so that it can choose the right side of the jump.
  using PiecewiseRightHandSide = std::function<void(double t, double interior, StateView y, StateOut dydt)>;
  Trajectory trajectory(const PiecewiseRightHandSide& f, double t0, StateView state0,
                        std::span<const double> times, std::span<const double> breakpoints = {},
                        const EventRequest* events = nullptr);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// One run with a fresh stepper: Integrator(state.size(), options).advance(...).
IntegrationResult integrate(const RightHandSide& f, double t0, double t1, Eigen::Ref<Eigen::VectorXd> state,
                            const IntegratorOptions& options = {}, const EventRequest* events = nullptr);

}  // namespace strutt
