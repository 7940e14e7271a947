#include "floquet/discriminant_kernel.hpp"

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/constants.hpp"
#include "base/dispatch.hpp"

namespace strutt::detail {
namespace {

constexpr double kMargin = 1.0 + 2e-5;  // for square roots that are good to 5e-6

#define STRUTT_KERNEL "floquet/discriminant_kernel.inc"
#include "base/every_instruction_set.inc"

}  // namespace

void combine(const DiscriminantArrays& arrays) {
  for_this_process(sse2::combine_all, avx2::combine_all, avx512::combine_all)(arrays);
}

}  // namespace strutt::detail
