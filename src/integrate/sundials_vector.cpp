#include "integrate/sundials_vector.hpp"

#include <algorithm>
#include <array>

namespace strutt::detail {
namespace {

/// z_i = sum_k c_k x_ki for `width` elements from `first` on. z may be one of the x.
template <int width>
void combine(int count, const double* c, const N_Vector* x, sunindextype first, double* z) {
  std::array<double, width> sum;
  const double* term = NV_DATA_S(x[0]) + first;
  for (int j = 0; j < width; ++j) sum[j] = c[0] * term[j];
  for (int k = 1; k < count; ++k) {
    term = NV_DATA_S(x[k]) + first;
    for (int j = 0; j < width; ++j) sum[j] += c[k] * term[j];
  }
  std::copy(sum.begin(), sum.end(), z + first);
}

extern "C" int strutt_linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
  constexpr int kWidth = 4;
  const sunindextype size = NV_LENGTH_S(z);
  sunindextype i = 0;
  for (; i + kWidth <= size; i += kWidth) combine<kWidth>(count, c, x, i, NV_DATA_S(z));
  for (; i < size; ++i) combine<1>(count, c, x, i, NV_DATA_S(z));
  return 0;
}

}  // namespace

StateVector make_state_vector(int dimension, SUNContext context) {
  StateVector vector(STRUTT_CHECKED(N_VNew_Serial(dimension, context)));
  STRUTT_CHECKED(N_VEnableFusedOps_Serial(vector.get(), SUNTRUE));
  vector->ops->nvlinearcombination = strutt_linear_combination;
  N_VConst(0.0, vector.get());
  return vector;
}

}  // namespace strutt::detail
