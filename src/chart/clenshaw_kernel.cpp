#include "chart/clenshaw_kernel.hpp"

#include <immintrin.h>

#include <cstdint>

#include "base/dispatch.hpp"

namespace strutt::detail {
namespace {

#define STRUTT_KERNEL "chart/clenshaw_kernel.inc"
#include "base/every_instruction_set.inc"

}  // namespace

void evaluate(const ScatteredSeries& series) {
  for_this_process(sse2::evaluate_all, avx2::evaluate_all, avx512::evaluate_all)(series);
}

}  // namespace strutt::detail
