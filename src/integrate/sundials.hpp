#pragma once

#include <memory>
#include <vector>

#include "integrate/sundials_vector.hpp"
#include "strutt/integrate/integrator.hpp"

namespace strutt::detail {

/// An event as SUNDIALS saw it: found on its interpolant.
struct Root {
  int index = 0;
  bool rising = true;
  double t = 0.0;
  Eigen::VectorXd state;
};

/// ARKODE or CVODE: takes one step after the other. Not movable, since SUNDIALS keeps pointers into it.
class Stepper {
 public:
  Stepper(int dimension, const IntegratorOptions& options);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// A second stepper like this one, within the same SUNContext.
  std::unique_ptr<Stepper> sibling(const IntegratorOptions& options) const;

  /// Tolerances and maximal step.
  void configure(const IntegratorOptions& options);
  /// Looks for these events from the next start() on; null: for none.
  void watch(const EventRequest* events);
  /// Forgets everything before. `f` must outlive the steps. first_step 0: SUNDIALS chooses.
  void start(const RightHandSide& f, double t0, StateView y0, double stop, double first_step = 0.0);
  /// Moves the stop on, once it was reached.
  void set_stop(double stop);
  /// One accepted step, not beyond the stop. Anything but `converged` leaves time and state of the last
  /// accepted step. Rethrows what the callbacks threw.
  Outcome step();

  double t() const { return t_; }
  Eigen::Map<const Eigen::VectorXd> state() const;
  bool at_stop() const { return t_ == stop_; }
  double step_start() const { return previous_t_; }
  const Eigen::VectorXd& start_state() const { return previous_; }
  /// Roots within the last step.
  const std::vector<Root>& roots() const { return roots_; }
  /// The state at a time within the last step, from the interpolant of SUNDIALS: accurate for CVODE only.
  void interpolate(double t, StateOut state);

  /// Since start().
  IntegrationCost cost() const;

 private:
  using Context = std::shared_ptr<_SUNContext>;

  Stepper(int dimension, const IntegratorOptions& options, Context context);
  void create_arkode(const IntegratorOptions& options);
  void create_cvode(const IntegratorOptions& options);
  void record_roots();
  bool root_is_step_end();
  Outcome failure(int flag);

  Context context_;
  StateVector y_;
  StateVector interpolated_;
  std::unique_ptr<_generic_SUNMatrix, Destroy<&SUNMatDestroy>> jacobian_;
  std::unique_ptr<_generic_SUNLinearSolver, Destroy<&SUNLinSolFree>> linear_solver_;
  std::unique_ptr<_generic_SUNNonlinearSolver, Destroy<&SUNNonlinSolFree>> nonlinear_solver_;
  const SundialsApi* api_;
  std::unique_ptr<void, FreeMemory> memory_;
  Callbacks callbacks_;
  double absolute_tolerance_ = 0.0;
  double t_ = 0.0;
  double stop_ = 0.0;
  double previous_t_ = 0.0;
  Eigen::VectorXd previous_;
  std::vector<Root> roots_;
  std::vector<int> root_flags_;
};

}  // namespace strutt::detail
