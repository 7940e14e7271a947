#include "chart/tensor_kernel.hpp"

#include "strutt/base/instruction_set.hpp"

namespace strutt::detail {
namespace {

#define STRUTT_INLINE [[gnu::always_inline]] inline
#define STRUTT_LANES for (std::size_t l = 0; l < kTensorColumns; ++l)

struct Fused {
  STRUTT_INLINE static double multiply_add(double a, double b, double c) { return __builtin_fma(a, b, c); }
};

struct Plain {  // without hardware for it, a fused multiply-add costs a hundred times more
  STRUTT_INLINE static double multiply_add(double a, double b, double c) { return a * b + c; }
};

/// kFunctions functions at kTensorColumns columns from `first`.
template <typename Arithmetic, std::size_t kFunctions>
STRUTT_INLINE void block(const TensorRow& row, std::size_t function, std::size_t first) {
  double sum[kFunctions][kTensorColumns] = {};
  const double* const weights = row.weights + function * row.terms;
  for (std::size_t k = row.terms; k-- > 0;) {
    const double* const basis = row.basis + k * row.basis_stride + first;
#pragma GCC unroll 4
    for (std::size_t f = 0; f < kFunctions; ++f) {
      const double weight = weights[f * row.terms + k];
      STRUTT_LANES sum[f][l] = Arithmetic::multiply_add(weight, basis[l], sum[f][l]);
    }
  }
  for (std::size_t f = 0; f < kFunctions; ++f) {
    STRUTT_LANES row.values[(function + f) * row.stride + first + l] = sum[f][l];
  }
}

template <typename Arithmetic>
STRUTT_INLINE void evaluate_with(const TensorRow& row) {
  for (std::size_t first = 0; first < row.columns; first += kTensorColumns) {
    std::size_t f = 0;
    for (; f + 4 <= row.functions; f += 4) block<Arithmetic, 4>(row, f, first);
    for (; f < row.functions; ++f) block<Arithmetic, 1>(row, f, first);
  }
}

[[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")]] void
evaluate_avx512(const TensorRow& row) {
  evaluate_with<Fused>(row);
}
[[gnu::target("avx2,fma")]] void evaluate_avx2(const TensorRow& row) { evaluate_with<Fused>(row); }
void evaluate_sse2(const TensorRow& row) { evaluate_with<Plain>(row); }

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
