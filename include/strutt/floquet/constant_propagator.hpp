#pragma once

#include "strutt/base/bounded_matrix.hpp"

namespace strutt {

/// Closed-form propagator of Y'' + w Y = 0, w constant, over `half_turns` * pi of canonical time, for the
/// scaled state (Y, Y'/kappa):
///   w > 0, s = sqrt w, x = s pi half_turns:  [cos x, kappa sin(x)/s; -s sin(x)/kappa, cos x],
///   w < 0: the same with cosh and sinh in log form (no overflow), w = 0: [1, kappa pi half_turns; 0, 1].
/// The phase is reduced in twice the working precision, so cos and sin keep their relative accuracy next to
/// their zeros and are exactly 0 where w and half_turns say so: the error bounds are entrywise relative, and
/// 0 for a proved 0. `coefficient_error` bounds the absolute error of w (0: w is exact).
BoundedMatrix2 constant_propagator(double w, double half_turns, double kappa, double coefficient_error = 0.0);

}  // namespace strutt
