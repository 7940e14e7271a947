#include "integrate/sundials.hpp"

#include <arkode/arkode_erkstep.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "integrate/sundials_tables.hpp"

namespace strutt::detail {

namespace {

// A discontinuity of the right-hand side asks for much smaller steps at once: about 25 failures in a row at
// tolerance 1e-13. More than these 60 are not needed to get from any step down to one that no longer changes
// the time.
constexpr int kMaxErrorFailures = 60;
// Steps are looked for at most this close to the time they start at: the factor SUNDIALS uses for its own
// times.
constexpr double kFuzz = 100.0 * std::numeric_limits<double>::epsilon();

using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using Map = Eigen::Map<Eigen::VectorXd>;

std::shared_ptr<_SUNContext> make_context() {
  SUNContext context = nullptr;
  STRUTT_CHECKED(SUNContext_Create(nullptr, &context));
  return {context, [](SUNContext owned) { SUNContext_Free(&owned); }};
}

}  // namespace

Stepper::Stepper(int dimension, const IntegratorOptions& options)
    : Stepper(dimension, options, make_context()) {}

Stepper::Stepper(int dimension, const IntegratorOptions& options, Context context)
    : context_(std::move(context)),
      y_(make_state_vector(dimension, context_.get())),  // all vectors SUNDIALS makes are clones of this one
      api_(options.backend == Backend::arkode_erk ? &kArkode : &kCvode),
      previous_(Eigen::VectorXd::Zero(dimension)) {
  callbacks_.dimension = dimension;
  if (options.backend == Backend::arkode_erk)
    create_arkode(options);
  else
    create_cvode(options);
  STRUTT_STEPPER_CALL(api_->set_error_handler(memory_.get(), strutt_keep_message, &callbacks_));
  STRUTT_STEPPER_CALL(api_->set_user_data(memory_.get(), &callbacks_));
  STRUTT_STEPPER_CALL(api_->set_max_error_failures(memory_.get(), kMaxErrorFailures));
  configure(options);
}

std::unique_ptr<Stepper> Stepper::sibling(const IntegratorOptions& options) const {
  return std::unique_ptr<Stepper>(new Stepper(callbacks_.dimension, options, context_));
}

void Stepper::create_arkode(const IntegratorOptions& options) {
  void* memory = STRUTT_CHECKED(ERKStepCreate(strutt_right_hand_side, 0.0, y_.get(), context_.get()));
  memory_ = {memory, FreeMemory{api_}};
  STRUTT_CHECKED(ERKStepSetTable(memory, butcher_table(options.order).get()));  // copied
  // Degree 3 needs no further right-hand sides; it only has to find events, which are refined afterwards.
  STRUTT_CHECKED(ERKStepSetInterpolantDegree(memory, 3));
}

void Stepper::create_cvode(const IntegratorOptions& options) {
  const bool adams = options.backend == Backend::cvode_adams;
  void* memory = STRUTT_CHECKED(CVodeCreate(adams ? CV_ADAMS : CV_BDF, context_.get()));
  memory_ = {memory, FreeMemory{api_}};
  STRUTT_CHECKED(CVodeInit(memory, strutt_right_hand_side, 0.0, y_.get()));
  if (adams) {
    nonlinear_solver_.reset(STRUTT_CHECKED(SUNNonlinSol_FixedPoint(y_.get(), 0, context_.get())));
    STRUTT_CHECKED(CVodeSetNonlinearSolver(memory, nonlinear_solver_.get()));
    return;
  }
  const sunindextype n = callbacks_.dimension;
  jacobian_.reset(STRUTT_CHECKED(SUNDenseMatrix(n, n, context_.get())));
  linear_solver_.reset(STRUTT_CHECKED(SUNLinSol_Dense(y_.get(), jacobian_.get(), context_.get())));
  STRUTT_CHECKED(CVodeSetLinearSolver(memory, linear_solver_.get(), jacobian_.get()));
}

void Stepper::configure(const IntegratorOptions& options) {
  absolute_tolerance_ = options.absolute_tolerance;
  STRUTT_STEPPER_CALL(
      api_->set_tolerances(memory_.get(), options.relative_tolerance, options.absolute_tolerance));
  const double bound = std::isfinite(options.max_step) ? options.max_step : 0.0;  // 0: none
  STRUTT_STEPPER_CALL(api_->set_max_step(memory_.get(), bound));
}

void Stepper::watch(const EventRequest* events) {
  // SUNDIALS keeps which functions were inactive (zero) over a restart: off and on again makes it forget.
  if (callbacks_.event_count > 0) STRUTT_STEPPER_CALL(api_->find_roots(memory_.get(), 0, nullptr));
  callbacks_.event_count = events ? static_cast<int>(events->crossings.size()) : 0;
  callbacks_.event_function = events ? &events->function : nullptr;
  if (!events) return;
  STRUTT_STEPPER_CALL(api_->find_roots(memory_.get(), callbacks_.event_count, strutt_events));
  root_flags_.clear();
  for (const Crossing crossing : events->crossings)
    root_flags_.push_back(crossing == Crossing::rising ? 1 : crossing == Crossing::falling ? -1 : 0);
  STRUTT_STEPPER_CALL(api_->set_root_directions(memory_.get(), root_flags_.data()));
  STRUTT_STEPPER_CALL(api_->do_not_warn_of_inactive_roots(memory_.get()));
}

void Stepper::start(const RightHandSide& f, double t0, StateView y0, double stop, double first_step) {
  callbacks_.reset();
  callbacks_.right_hand_side = &f;
  Map(N_VGetArrayPointer(y_.get()), callbacks_.dimension) = y0;
  // ARKODE 5.4 checks the direction of a restarted run by the last step of the run before, and refuses to
  // turn round.
  callbacks_.direction = stop < t0 ? -1.0 : 1.0;
  t_ = previous_t_ = t0;
  roots_.clear();
  STRUTT_STEPPER_CALL(api_->restart(memory_.get(), callbacks_.direction * t0, y_.get()));
  STRUTT_STEPPER_CALL(api_->set_first_step(memory_.get(), callbacks_.direction * first_step));
  set_stop(stop);
}

void Stepper::set_stop(double stop) {
  stop_ = stop;
  STRUTT_STEPPER_CALL(api_->set_stop_time(memory_.get(), callbacks_.direction * stop));
}

Eigen::Map<const Eigen::VectorXd> Stepper::state() const {
  return {N_VGetArrayPointer(y_.get()), callbacks_.dimension};
}

Outcome Stepper::step() {
  previous_t_ = t_;
  previous_ = state();
  roots_.clear();
  int flag = CV_SUCCESS;
  do {
    double time = callbacks_.direction * t_;
    flag = api_->evolve(memory_.get(), callbacks_.direction * stop_, y_.get(), &time, CV_ONE_STEP);
    t_ = callbacks_.direction * time;
    if (flag == CV_ROOT_RETURN) record_roots();
  } while (flag == CV_ROOT_RETURN && !root_is_step_end());
  if (flag >= 0 && !callbacks_.failed() && t_ != previous_t_ && all_finite(state()))
    return Outcome::converged;
  return failure(flag);
}

void Stepper::record_roots() {
  STRUTT_STEPPER_CALL(api_->root_info(memory_.get(), root_flags_.data()));
  for (int i = 0; i < callbacks_.event_count; ++i)
    if (root_flags_[i] != 0) roots_.push_back({i, root_flags_[i] > 0, t_, state()});
}

// After a root SUNDIALS hands out the end of the step by a call of its own, unless both are the same to
// rounding.
bool Stepper::root_is_step_end() {
  double end = 0.0;
  double length = 0.0;
  STRUTT_STEPPER_CALL(api_->current_time(memory_.get(), &end));
  STRUTT_STEPPER_CALL(api_->last_step(memory_.get(), &length));
  if (std::abs(end - callbacks_.direction * t_) > kFuzz * (std::abs(end) + std::abs(length))) return false;
  t_ = callbacks_.direction * end;
  STRUTT_STEPPER_CALL(api_->derivative(memory_.get(), end, 0, y_.get()));
  return true;
}

void Stepper::interpolate(double t, StateOut state) {
  if (!interpolated_) interpolated_.reset(STRUTT_CHECKED(N_VClone(y_.get())));
  STRUTT_STEPPER_CALL(api_->derivative(memory_.get(), callbacks_.direction * t, 0, interpolated_.get()));
  state = ConstMap(N_VGetArrayPointer(interpolated_.get()), callbacks_.dimension);
}

/// Goes back to the last accepted step, rethrows what a callback threw, and tells what else went wrong.
Outcome Stepper::failure(int flag) {
  const bool finite = std::isfinite(t_) && (flag < 0 || all_finite(state()));
  t_ = previous_t_;
  Map(N_VGetArrayPointer(y_.get()), callbacks_.dimension) = previous_;
  roots_.clear();
  if (callbacks_.exception) std::rethrow_exception(std::exchange(callbacks_.exception, nullptr));
  if (callbacks_.non_finite || !finite) return Outcome::non_finite;
  if (flag >= 0) return Outcome::step_underflow;  // the step was accepted and did not change the time
  // A relative error of a vanishing component cannot be bounded; SUNDIALS calls the weight an illegal input.
  const bool weightless = absolute_tolerance_ == 0.0 && (previous_.array() == 0.0).any();
  if (flag == CV_TOO_MUCH_ACC || (flag == CV_ILL_INPUT && weightless)) return Outcome::tolerance_not_reached;
  // An event function that stays zero after its zero is told apart by the message only.
  if (flag == CV_ILL_INPUT && std::strstr(callbacks_.message, "oot found at and very near"))
    return Outcome::failed;
  if (flag <= CV_MEM_FAIL) check(flag, api_->evolve_name, callbacks_.message);
  double step = 0.0;
  STRUTT_STEPPER_CALL(api_->current_step(memory_.get(), &step));
  return std::abs(step) <= kFuzz * std::abs(t_) ? Outcome::step_underflow : Outcome::failed;
}

IntegrationCost Stepper::cost() const {
  IntegrationCost cost;
  STRUTT_STEPPER_CALL(api_->count_steps(memory_.get(), &cost.steps));
  STRUTT_STEPPER_CALL(api_->count_rejections(memory_.get(), &cost.rejections));
  cost.right_hand_sides = callbacks_.right_hand_sides;
  return cost;
}

}  // namespace strutt::detail
