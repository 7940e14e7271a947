#include "chart/tensor_kernel.hpp"

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "base/dispatch.hpp"

namespace strutt::detail {
namespace {

#define STRUTT_KERNEL "chart/tensor_kernel.inc"
#include "base/every_instruction_set.inc"

}  // namespace

void evaluate(const TensorProduct& product) {
  for_this_process(sse2::evaluate_all, avx2::evaluate_all, avx512::evaluate_all)(product);
}

}  // namespace strutt::detail
