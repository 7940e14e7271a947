#pragma once

#include <cstddef>
#include <vector>

namespace strutt::detail {

/// Functions f_g(s, t) = sum_kl c_kl T_k(s) T_l(t) at scattered points of [-1, 1]^2, by Clenshaw's recurrence
/// in both directions; coefficients of function g with k running fastest at coefficients[g].
struct ScatteredSeries {
  std::vector<const double*> coefficients;
  std::size_t terms_x, terms_y;
  const double* s;
  const double* t;
  std::size_t points;
  double* values;  ///< of function g at point p: values[g * stride + p]
  std::size_t stride;
};

/// With the instruction set of this process; every value has the same bits whatever stands beside it.
void evaluate(const ScatteredSeries& series);

}  // namespace strutt::detail
