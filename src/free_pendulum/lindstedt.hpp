#pragma once

#include "free_pendulum/rational_series.hpp"

namespace strutt {

/// Lindstedt's method for phi'' + phi + sum_(k >= 2) force[k] phi^k = 0 with phi(0) = A, phi'(0) = 0: the
/// series of omega^2 in A. `force` has the coefficients up to order + 1.
Series lindstedt_frequency_squared(const Series& force, int order);

}  // namespace strutt
