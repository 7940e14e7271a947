#include "floquet/discriminant_kernel.hpp"

#include <bit>
#include <cstdint>
#include <numbers>

#include "strutt/base/instruction_set.hpp"

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
  const auto &full = *arrays.full, &half = *arrays.half;
  const double* const __restrict u1 = full.u1.data();
  const double* const __restrict v1 = full.du1.data();
  const double* const __restrict u2 = full.u2.data();
  const double* const __restrict v2 = full.du2.data();
  const long* const __restrict exponent = full.exponent.data();
  const double* const __restrict half_u1 = half.u1.data();
  const double* const __restrict half_v1 = half.du1.data();
  const double* const __restrict half_u2 = half.u2.data();
  const double* const __restrict half_v2 = half.du2.data();
  const long* const __restrict half_exponent = half.exponent.data();
  const double* const __restrict mean = arrays.mean;
  const double* const __restrict bound = arrays.bound;
  double* const __restrict value = arrays.value;
  double* const __restrict error = arrays.error;
  const double share = arrays.share, rounding = arrays.rounding;
  const double coefficient = std::numbers::pi * arrays.coefficient_error;  // per square root of |W|
  for (std::size_t l = 0; l < arrays.lanes; ++l) {
    const double kappa = larger(1.0, __builtin_sqrt(size_of(mean[l]))), inverse = 1.0 / kappa;
    const double a = u1[l], b = kappa * u2[l], c = inverse * v1[l], d = v2[l];
    const double shift = power_of_two(half_exponent[l] - exponent[l]);
    const double defect = larger(larger(size_of(a - shift * half_u1[l]), size_of(b - shift * kappa * half_u2[l])),
                                 larger(size_of(c - shift * inverse * half_v1[l]), size_of(d - shift * half_v2[l])));
    const double sum = size_of(a) + size_of(b) + size_of(c) + size_of(d);
    const double size = larger(larger(size_of(a), size_of(b)), larger(size_of(c), size_of(d)));
    const double own = share * defect + (rounding + coefficient * __builtin_sqrt(bound[l])) * size;
    const double product = a * d, other = b * c, half_trace = product + other;
    const double largest = larger(size_of(half_trace), 2.0 * larger(size_of(b * d), size_of(a * c)));
    const double deviation =
        2.0 * own * (sum + 2.0 * own) + 6.0 * kUnit * (size_of(product) + size_of(other));
    const double scale = power_of_two(exponent[l]), one = power_of_two(-2 * exponent[l]);
    value[l] = 2.0 * half_trace * scale * scale;
    error[l] = deviation / larger(one, largest) + 2.0 * kUnit;
  }
}

[[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")]] void combine_avx512(
    const DiscriminantArrays& arrays) {
  combine_all(arrays);
}
[[gnu::target("avx2,fma")]] void combine_avx2(const DiscriminantArrays& arrays) { combine_all(arrays); }
void combine_sse2(const DiscriminantArrays& arrays) { combine_all(arrays); }

}  // namespace

void combine(const DiscriminantArrays& arrays) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return combine_avx512(arrays);
    case InstructionSet::avx2:
      return combine_avx2(arrays);
    case InstructionSet::sse2:
      return combine_sse2(arrays);
  }
}

}  // namespace strutt::detail
