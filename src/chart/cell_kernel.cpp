#include <immintrin.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "chart/cell_row.hpp"
#include "strutt/base/instruction_set.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kStable = static_cast<double>(Verdict::stable),
                 kUnstable = static_cast<double>(Verdict::unstable),
                 kUnresolved = static_cast<double>(Verdict::unresolved);

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")
namespace avx512 {
#define STRUTT_WIDTH 8
#define STRUTT_FMA(a, b, c) _mm512_fmadd_pd(a, b, c)
// the unmasked square root makes GCC 12 warn of its own header (GCC bug 105593)
#define STRUTT_SQRT(x) _mm512_maskz_sqrt_pd(0xff, x)
#define STRUTT_SIGNS(x) static_cast<int>(_mm512_movepi64_mask((__m512i)(x)))
#include "chart/cell_kernel.inc"
}  // namespace avx512
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
#define STRUTT_WIDTH 4
#define STRUTT_FMA(a, b, c) _mm256_fmadd_pd(a, b, c)
#define STRUTT_SQRT(x) _mm256_sqrt_pd(x)
#define STRUTT_SIGNS(x) _mm256_movemask_pd((__m256d)(x))
#include "chart/cell_kernel.inc"
}  // namespace avx2
#pragma GCC pop_options

// Without hardware for it, a fused multiply-add costs a hundred times more.
namespace sse2 {
#define STRUTT_WIDTH 2
#define STRUTT_FMA(a, b, c) ((a) * (b) + (c))
#define STRUTT_SQRT(x) _mm_sqrt_pd(x)
#define STRUTT_SIGNS(x) _mm_movemask_pd((__m128d)(x))
#include "chart/cell_kernel.inc"
}  // namespace sse2

}  // namespace

void plain_cells(CellRow& row) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::compute_any(row);
    case InstructionSet::avx2:
      return avx2::compute_any(row);
    case InstructionSet::sse2:
      return sse2::compute_any(row);
  }
}

}  // namespace strutt
