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

/// kFunctions functions at two registers of columns from `first`.
template <typename Arithmetic, std::size_t kWidth, std::size_t kFunctions>
STRUTT_INLINE void block(const TensorRow& row, std::size_t function, std::size_t first) {
  Register<kWidth> left[kFunctions], right[kFunctions];
  const double* const weights = row.weights + function * row.terms;
#pragma GCC unroll 4
  for (std::size_t f = 0; f < kFunctions; ++f) {
    STRUTT_LANES left[f].lane[l] = right[f].lane[l] = 0.0;
  }
  for (std::size_t k = row.terms; k-- > 0;) {
    const double* const basis = row.basis + k * row.basis_stride + first;
#pragma GCC unroll 4
    for (std::size_t f = 0; f < kFunctions; ++f) {
      const double weight = weights[f * row.terms + k];
      STRUTT_LANES {
        left[f].lane[l] = Arithmetic::multiply_add(weight, basis[l], left[f].lane[l]);
        right[f].lane[l] = Arithmetic::multiply_add(weight, basis[kWidth + l], right[f].lane[l]);
      }
    }
  }
#pragma GCC unroll 4
  for (std::size_t f = 0; f < kFunctions; ++f) {
    double* const values = row.values + (function + f) * row.stride + first;
    STRUTT_LANES {
      values[l] = left[f].lane[l];
      values[kWidth + l] = right[f].lane[l];
    }
  }
}

template <typename Arithmetic, std::size_t kWidth>
STRUTT_INLINE void evaluate_with(const TensorRow& row) {
  for (std::size_t first = 0; first < row.columns; first += 2 * kWidth) {
    std::size_t f = 0;
    for (; f + 4 <= row.functions; f += 4) block<Arithmetic, kWidth, 4>(row, f, first);
    for (; f < row.functions; ++f) block<Arithmetic, kWidth, 1>(row, f, first);
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
