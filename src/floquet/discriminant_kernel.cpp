#include "floquet/discriminant_kernel.hpp"

#include <bit>
#include <cstdint>
#include <numbers>

#include "base/dispatch.hpp"

namespace strutt::detail {
namespace {

#define STRUTT_INLINE [[gnu::always_inline]] inline

constexpr double kUnit = 0x1p-53;

STRUTT_INLINE double larger(double a, double b) { return a > b ? a : b; }
STRUTT_INLINE double size_of(double x) { return __builtin_fabs(x); }

/// 2^exponent, the exponent brought into the range of normal numbers.
STRUTT_INLINE double power_of_two(std::int64_t exponent) {
  exponent = exponent > 1023 ? 1023 : exponent;
  exponent = exponent < -1022 ? -1022 : exponent;
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

STRUTT_INLINE void combine_all(const DiscriminantArrays& arrays) {
  const auto& half = *arrays.half;
  const double* const __restrict u1 = half.u1.data();
  const double* const __restrict u2 = half.u2.data();
  const double* const __restrict v1 = half.du1.data();
  const double* const __restrict v2 = half.du2.data();
  const double* const __restrict u1_error = half.u1_error.data();
  const double* const __restrict u2_error = half.u2_error.data();
  const double* const __restrict v1_error = half.du1_error.data();
  const double* const __restrict v2_error = half.du2_error.data();
  const long* const __restrict exponent = half.exponent.data();
  const double* const __restrict mean = arrays.mean;
  const double* const __restrict bound = arrays.bound;
  double* const __restrict value = arrays.value;
  double* const __restrict error = arrays.error;
  const double coefficient = std::numbers::pi * arrays.coefficient_error;  // per square root of |W|
  for (std::size_t l = 0; l < arrays.lanes; ++l) {
    const double kappa = larger(1.0, __builtin_sqrt(size_of(mean[l]))), inverse = 1.0 / kappa;
    const double a = size_of(u1[l]), b = kappa * size_of(u2[l]), c = inverse * size_of(v1[l]),
                 d = size_of(v2[l]);
    const double from_coefficient =
        coefficient * __builtin_sqrt(bound[l]) * larger(larger(a, b), larger(c, d));
    const double half_trace = u1[l] * v2[l] + u2[l] * v1[l];
    // of 2 (u1 u2' + u1' u2), second order included
    const double da = u1_error[l] + from_coefficient, db = kappa * u2_error[l] + from_coefficient;
    const double dc = inverse * v1_error[l] + from_coefficient, dd = v2_error[l] + from_coefficient;
    const double deviation =
        2.0 * (da * (d + dd) + a * dd + db * (c + dc) + b * dc) + 6.0 * kUnit * (a * d + b * c);
    const double largest = larger(size_of(half_trace), 2.0 * larger(b * d, a * c));
    const double scale = power_of_two(exponent[l]), one = power_of_two(-2 * exponent[l]);
    value[l] = 2.0 * half_trace * scale * scale;
    error[l] = deviation / larger(one, largest) + 2.0 * kUnit;
  }
}

[[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")]] void
combine_avx512(const DiscriminantArrays& arrays) {
  combine_all(arrays);
}
[[gnu::target("avx2,fma")]] void combine_avx2(const DiscriminantArrays& arrays) { combine_all(arrays); }
void combine_sse2(const DiscriminantArrays& arrays) { combine_all(arrays); }

}  // namespace

void combine(const DiscriminantArrays& arrays) {
  for_this_process(combine_sse2, combine_avx2, combine_avx512)(arrays);
}

}  // namespace strutt::detail
