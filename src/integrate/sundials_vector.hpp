#pragma once

#include <nvector/nvector_serial.h>

#include <memory>

#include "integrate/sundials_api.hpp"

namespace strutt::detail {

using StateVector = std::unique_ptr<_generic_N_Vector, Destroy<&N_VDestroy>>;

/// A serial vector of zeros. It and its clones form linear combinations, the bulk of what SUNDIALS does with
/// a short state, element by element in registers; SUNDIALS's own pass over memory for every term doubles the
/// time of a Runge-Kutta step of four components. The order of the additions is the same.
StateVector make_state_vector(int dimension, SUNContext context);

}  // namespace strutt::detail
