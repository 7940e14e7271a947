#pragma once

#include <span>

namespace strutt::detail {

/// A symmetric splitting of one step into kicks (b) and drifts (a): kick, drift, kick, ..., kick.
struct Splitting {
  int order;
  std::span<const double> kicks;   ///< b_0 ... b_s, sum 1
  std::span<const double> drifts;  ///< a_1 ... a_s, sum 1
  double error_constant;           ///< c_p of the error formula, see plan_hill_steps
};

/// The splitting of this order (4 or 6). Throws InvalidInput for another one.
const Splitting& splitting(int order);

}  // namespace strutt::detail
