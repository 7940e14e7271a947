#pragma once

#include <arkode/arkode_erkstep.h>

#include <memory>

#include "integrate/sundials_api.hpp"

namespace strutt::detail {

using ButcherTable = std::unique_ptr<ARKodeButcherTableMem, Destroy<&ARKodeButcherTable_Free>>;

/// The embedded explicit Runge-Kutta method of this order: 2, 3, 4, 5, 6 or 8.
ButcherTable butcher_table(int order);

}  // namespace strutt::detail
