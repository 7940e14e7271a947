#include "integrate/series_kernel.hpp"

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <new>

#include "base/dispatch.hpp"

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

#define STRUTT_KERNEL "integrate/series_kernel.inc"
#include "base/every_instruction_set.inc"

}  // namespace

void choose(const SeriesChoice& choice) {
  for_this_process(sse2::choose_all, avx2::choose_all, avx512::choose_all)(choice);
}

void sweep(const SeriesSweep& batch) {
  for_this_process(sse2::sweep_all, avx2::sweep_all, avx512::sweep_all)(batch);
}

}  // namespace strutt::detail
