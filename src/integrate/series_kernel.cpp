#include "integrate/series_kernel.hpp"

#include <immintrin.h>

#include <cstdint>
#include <cstdlib>
#include <new>

#include "strutt/base/instruction_set.hpp"

namespace strutt::detail {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kRoundingOnce = 1.5;    // units: what the sums and their coefficients cost,
constexpr double kRoundingGrowth = 0.3;  // and for each g^2 more
constexpr double kProductRounding = 3.0 * kUnit;
constexpr double kFallOfTerms =
    0.02;  // a last pair smaller than so much of the one before it is small by chance
constexpr double kTailSafety = 3.0;
constexpr double kTiny = 1e-300;
constexpr double kSecondOrder = 1.01;  // room for products of errors

/// Memory for vector registers.
template <typename T>
class Workspace {
 public:
  explicit Workspace(std::size_t count)
      : data_(static_cast<T*>(::operator new((count + 1) * sizeof(T), std::align_val_t(64)))) {}
  ~Workspace() { ::operator delete(data_, std::align_val_t(64)); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  T* data() { return data_; }

 private:
  T* data_;
};

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")
namespace avx512 {
#define STRUTT_WIDTH 8
#define STRUTT_REGISTERS 3
#define STRUTT_FMA(a, b, c) _mm512_fmadd_pd(a, b, c)
#include "integrate/series_kernel.inc"
}  // namespace avx512
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
#define STRUTT_WIDTH 4
#define STRUTT_REGISTERS 2
#define STRUTT_FMA(a, b, c) _mm256_fmadd_pd(a, b, c)
#include "integrate/series_kernel.inc"
}  // namespace avx2
#pragma GCC pop_options

// Without hardware for it, a fused multiply-add costs a hundred times more.
namespace sse2 {
#define STRUTT_WIDTH 2
#define STRUTT_REGISTERS 2
#define STRUTT_FMA(a, b, c) ((a) * (b) + (c))
#include "integrate/series_kernel.inc"
}  // namespace sse2

}  // namespace

void choose(const SeriesChoice& choice) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::choose_all(choice);
    case InstructionSet::avx2:
      return avx2::choose_all(choice);
    case InstructionSet::sse2:
      return sse2::choose_all(choice);
  }
}

void sweep(const SeriesSweep& batch) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::sweep_all(batch);
    case InstructionSet::avx2:
      return avx2::sweep_all(batch);
    case InstructionSet::sse2:
      return sse2::sweep_all(batch);
  }
}

}  // namespace strutt::detail
