#include "chart/tensor_kernel.hpp"

#include <immintrin.h>

#include "strutt/base/instruction_set.hpp"

namespace strutt::detail {
namespace {

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")
namespace avx512 {
#define STRUTT_WIDTH 8
#define STRUTT_ROWS 8
#define STRUTT_REGISTERS 3
#define STRUTT_FMA(a, b, c) _mm512_fmadd_pd(a, b, c)
#include "chart/tensor_kernel.inc"
}  // namespace avx512
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
#define STRUTT_WIDTH 4
#define STRUTT_ROWS 4
#define STRUTT_REGISTERS 3
#define STRUTT_FMA(a, b, c) _mm256_fmadd_pd(a, b, c)
#include "chart/tensor_kernel.inc"
}  // namespace avx2
#pragma GCC pop_options

// Without hardware for it, a fused multiply-add costs a hundred times more.
namespace sse2 {
#define STRUTT_WIDTH 2
#define STRUTT_ROWS 4
#define STRUTT_REGISTERS 2
#define STRUTT_FMA(a, b, c) ((a) * (b) + (c))
#include "chart/tensor_kernel.inc"
}  // namespace sse2

}  // namespace

void evaluate(const TensorProduct& product) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::evaluate_all(product);
    case InstructionSet::avx2:
      return avx2::evaluate_all(product);
    case InstructionSet::sse2:
      return sse2::evaluate_all(product);
  }
}

}  // namespace strutt::detail
