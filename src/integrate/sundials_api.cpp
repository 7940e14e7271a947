#include "integrate/sundials_api.hpp"

#include <arkode/arkode_erkstep.h>

#include <cstdio>
#include <new>
#include <stdexcept>

namespace strutt::detail {
namespace {

using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using Map = Eigen::Map<Eigen::VectorXd>;

/// Runs `body` and turns whatever goes wrong into the flag of an unrecoverable failure.
template <typename Body>
int guarded(Callbacks& callbacks, const Body& body) noexcept {
  if (callbacks.failed()) return -1;
  try {
    if (body()) return 0;
    callbacks.non_finite = true;
  } catch (...) {
    callbacks.exception = std::current_exception();
  }
  return -1;
}

}  // namespace

extern "C" int strutt_right_hand_side(double t, N_Vector y, N_Vector dydt, void* user_data) {
  auto& callbacks = *static_cast<Callbacks*>(user_data);
  return guarded(callbacks, [&] {
    ++callbacks.right_hand_sides;
    Map derivative(N_VGetArrayPointer(dydt), callbacks.dimension);
    (*callbacks.right_hand_side)(callbacks.direction * t,
                                 ConstMap(N_VGetArrayPointer(y), callbacks.dimension), derivative);
    if (callbacks.direction < 0.0) derivative = -derivative;
    return all_finite(derivative);
  });
}

extern "C" int strutt_events(double t, N_Vector y, double* values, void* user_data) {
  auto& callbacks = *static_cast<Callbacks*>(user_data);
  return guarded(callbacks, [&] {
    Map g(values, callbacks.event_count);
    (*callbacks.event_function)(callbacks.direction * t, ConstMap(N_VGetArrayPointer(y), callbacks.dimension),
                                g);
    return all_finite(g);
  });
}

extern "C" void strutt_keep_message(int, const char*, const char* function, char* message, void* user_data) {
  auto& callbacks = *static_cast<Callbacks*>(user_data);
  std::snprintf(callbacks.message, sizeof callbacks.message, "%s: %s", function, message);
}

void check(int flag, const char* call, const char* message) {
  if (flag >= 0) return;
  if (flag == CV_MEM_FAIL) throw std::bad_alloc();
  throw std::logic_error(std::string("SUNDIALS: ") + call + " returned " + std::to_string(flag) + ": " +
                         message);
}

void Callbacks::reset() {
  right_hand_sides = 0;
  non_finite = false;
  exception = nullptr;
  message[0] = '\0';
}

void FreeMemory::operator()(void* memory) const { api->free(&memory); }

constinit const SundialsApi kArkode{
    .evolve_name = "ERKStepEvolve",
    .evolve = ERKStepEvolve,
    .restart = [](void* memory, double t0,
                  N_Vector y0) { return ERKStepReInit(memory, strutt_right_hand_side, t0, y0); },
    .set_stop_time = ERKStepSetStopTime,
    .set_first_step = ERKStepSetInitStep,
    .set_max_step = ERKStepSetMaxStep,
    .set_max_error_failures = ERKStepSetMaxErrTestFails,
    .set_tolerances = ERKStepSStolerances,
    .set_error_handler = ERKStepSetErrHandlerFn,
    .set_user_data = ERKStepSetUserData,
    .find_roots = ERKStepRootInit,
    .set_root_directions = ERKStepSetRootDirection,
    .do_not_warn_of_inactive_roots = ERKStepSetNoInactiveRootWarn,
    .root_info = ERKStepGetRootInfo,
    .current_time = ERKStepGetCurrentTime,
    .current_step = ERKStepGetCurrentStep,
    .last_step = ERKStepGetLastStep,
    .derivative = ERKStepGetDky,
    .count_steps = ERKStepGetNumSteps,
    .count_rejections = ERKStepGetNumErrTestFails,
    .free = ERKStepFree,
};

constinit const SundialsApi kCvode{
    .evolve_name = "CVode",
    .evolve = CVode,
    .restart = CVodeReInit,
    .set_stop_time = CVodeSetStopTime,
    .set_first_step = CVodeSetInitStep,
    .set_max_step = CVodeSetMaxStep,
    .set_max_error_failures = CVodeSetMaxErrTestFails,
    .set_tolerances = CVodeSStolerances,
    .set_error_handler = CVodeSetErrHandlerFn,
    .set_user_data = CVodeSetUserData,
    .find_roots = CVodeRootInit,
    .set_root_directions = CVodeSetRootDirection,
    .do_not_warn_of_inactive_roots = CVodeSetNoInactiveRootWarn,
    .root_info = CVodeGetRootInfo,
    .current_time = CVodeGetCurrentTime,
    .current_step = CVodeGetCurrentStep,
    .last_step = CVodeGetLastStep,
    .derivative = CVodeGetDky,
    .count_steps = CVodeGetNumSteps,
    .count_rejections =
        [](void* memory, long* count) {
          long solver_failures = 0;
          const int flag = CVodeGetNumStepSolveFails(memory, &solver_failures);
          if (flag < 0) return flag;
          const int last = CVodeGetNumErrTestFails(memory, count);
          *count += solver_failures;
          return last;
        },
    .free = CVodeFree,
};

}  // namespace strutt::detail
