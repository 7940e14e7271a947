#pragma once

// With sundials.{hpp,cpp} the one door to SUNDIALS: no other file includes its headers.

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <exception>
#include <string>

#include "strutt/integrate/problem.hpp"

namespace strutt::detail {

/// What the C callbacks work on. They let neither an exception nor a NaN through to SUNDIALS: both are kept
/// here and SUNDIALS is told that the call failed for good. CVODE with a fixed-point iteration tries shorter
/// steps all the same: the functions are not called again then.
struct Callbacks {
  /// SUNDIALS always sees time grow: of a run towards smaller times it sees y(-t).
  double direction = 1.0;
  const RightHandSide* right_hand_side = nullptr;
  const EventFunction* event_function = nullptr;
  int dimension = 0;
  int event_count = 0;
  long right_hand_sides = 0;
  bool non_finite = false;
  std::exception_ptr exception;
  char message[256] = "";  ///< the last text SUNDIALS would have printed

  bool failed() const { return non_finite || exception; }
  void reset();
};

/// The callbacks themselves; `user_data` is a Callbacks.
extern "C" int strutt_right_hand_side(double t, N_Vector y, N_Vector dydt, void* user_data);
extern "C" int strutt_events(double t, N_Vector y, double* values, void* user_data);
/// Keeps what SUNDIALS would have printed to stderr.
extern "C" void strutt_keep_message(int code, const char* module, const char* function, char* message,
                                    void* user_data);

template <typename Vector>
bool all_finite(const Vector& values) {
  return (values * 0.0).sum() == 0.0;  // Inf * 0 is NaN, too; unlike allFinite() this is vectorised
}

/// The functions of ARKODE or CVODE by one set of names: their signatures and flags agree.
struct SundialsApi {
  const char* evolve_name;
  int (*evolve)(void*, double, N_Vector, double*, int);
  int (*restart)(void*, double, N_Vector);
  int (*set_stop_time)(void*, double);
  int (*set_first_step)(void*, double);
  int (*set_max_step)(void*, double);
  int (*set_max_error_failures)(void*, int);
  int (*set_tolerances)(void*, double, double);
  int (*set_error_handler)(void*, CVErrHandlerFn, void*);
  int (*set_user_data)(void*, void*);
  int (*find_roots)(void*, int, CVRootFn);
  int (*set_root_directions)(void*, int*);
  int (*do_not_warn_of_inactive_roots)(void*);
  int (*root_info)(void*, int*);
  int (*current_time)(void*, double*);
  int (*current_step)(void*, double*);
  int (*last_step)(void*, double*);
  int (*derivative)(void*, double, int, N_Vector);
  int (*count_steps)(void*, long*);
  int (*count_rejections)(void*, long*);
  void (*free)(void**);
};

extern const SundialsApi kArkode;
extern const SundialsApi kCvode;

template <auto function>
struct Destroy {
  template <typename T>
  void operator()(T* object) const {
    function(object);
  }
};

struct FreeMemory {
  const SundialsApi* api = nullptr;
  void operator()(void* memory) const;
};

/// Throws unless the call succeeded: what fails here is a mistake of this library (or memory that ran out).
void check(int flag, const char* call, const char* message);

template <typename T>
T* check(T* object, const char* call, const char* message) {
  if (!object) check(CV_MEM_NULL, call, message);
  return object;
}

// Every call of SUNDIALS but those that take a step goes through this, to keep the text of the one that
// failed.
#define STRUTT_CHECKED(call) check((call), #call, "")
// The same where a Stepper has kept the message.
#define STRUTT_STEPPER_CALL(call) check((call), #call, callbacks_.message)

}  // namespace strutt::detail
