#include "chart/tensor_kernel.hpp"

#include "strutt/base/instruction_set.hpp"

namespace strutt::detail {
namespace {

#define STRUTT_INLINE [[gnu::always_inline]] inline
// Not unrolled: a loop of one register's length would otherwise be gone before it can be vectorised.
#define STRUTT_LANES _Pragma("GCC unroll 1") for (std::size_t l = 0; l < kWidth; ++l)

struct Fused {
  STRUTT_INLINE static double multiply_add(double a, double b, double c) { return __builtin_fma(a, b, c); }
};

struct Plain {  // without hardware for it, a fused multiply-add costs a hundred times more
  STRUTT_INLINE static double multiply_add(double a, double b, double c) { return a * b + c; }
};

template <std::size_t kWidth>
struct Register {
  double lane[kWidth];
};

// One statement for all registers of a block: a loop of this length is always unrolled.
#define STRUTT_REGISTERS _Pragma("GCC unroll 8") for (std::size_t r = 0; r < kRegisters; ++r)
#define STRUTT_FUNCTIONS _Pragma("GCC unroll 4") for (std::size_t f = 0; f < kFunctions; ++f)

/// kFunctions functions at kRegisters registers of columns from `first`: eight sums, enough independent
/// chains to hide the latency of the multiply-adds.
template <typename Arithmetic, std::size_t kWidth, std::size_t kFunctions>
STRUTT_INLINE void block(const TensorRow& row, std::size_t function, std::size_t first) {
  constexpr std::size_t kRegisters = 8 / kFunctions;
  Register<kWidth> sum[kFunctions][kRegisters];
  const double* const weights = row.weights + function * row.terms;
  STRUTT_FUNCTIONS {
    STRUTT_REGISTERS { STRUTT_LANES sum[f][r].lane[l] = 0.0; }
  }
  for (std::size_t k = row.terms; k-- > 0;) {
    const double* const basis = row.basis + k * row.basis_stride + first;
    STRUTT_FUNCTIONS {
      const double weight = weights[f * row.terms + k];
      STRUTT_REGISTERS {
        STRUTT_LANES sum[f][r].lane[l] =
            Arithmetic::multiply_add(weight, basis[r * kWidth + l], sum[f][r].lane[l]);
      }
    }
  }
  STRUTT_FUNCTIONS {
    double* const values = row.values + (function + f) * row.stride + first;
    STRUTT_REGISTERS { STRUTT_LANES values[r * kWidth + l] = sum[f][r].lane[l]; }
  }
}

template <typename Arithmetic, std::size_t kWidth>
STRUTT_INLINE void evaluate_with(const TensorRow& row) {
  std::size_t f = 0;
  for (; f + 4 <= row.functions; f += 4) {
    for (std::size_t first = 0; first < row.columns; first += 2 * kWidth)
      block<Arithmetic, kWidth, 4>(row, f, first);
  }
  for (; f < row.functions; ++f) {
    for (std::size_t first = 0; first < row.columns; first += 8 * kWidth)
      block<Arithmetic, kWidth, 1>(row, f, first);
  }
}

[[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")]] void
evaluate_avx512(const TensorRow& row) {
  evaluate_with<Fused, 8>(row);
}
[[gnu::target("avx2,fma")]] void evaluate_avx2(const TensorRow& row) { evaluate_with<Fused, 4>(row); }
void evaluate_sse2(const TensorRow& row) { evaluate_with<Plain, 2>(row); }

}  // namespace

void evaluate(const TensorRow& row) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return evaluate_avx512(row);
    case InstructionSet::avx2:
      return evaluate_avx2(row);
    case InstructionSet::sse2:
      return evaluate_sse2(row);
  }
}

}  // namespace strutt::detail
