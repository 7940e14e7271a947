#include "integrate/series_kernel.hpp"

#include <immintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>

#include "base/constants.hpp"
#include "base/dispatch.hpp"
#include "integrate/darboux.hpp"

namespace strutt::detail {
namespace {

constexpr double kRoundingOnce = 2.0;    // units: what the sums and their coefficients cost,
constexpr double kRoundingGrowth = 0.3;  // and for each g^2 more
constexpr double kProductRounding = 3.0 * kUnit;
constexpr double kSecondOrder = 1.01;                 // room for products of errors
constexpr int kRescaling = 4;                         // steps, each of which grows by at most cosh(8)^2
constexpr std::size_t kRegisters = 8, kFewNodes = 8;  // their steps stay in the first level of the cache

/// Of a_k in the relation between values, and in that between slopes.
template <int K>
constexpr std::array<double, K> kValueWeights = [] {
  std::array<double, K> result{};
  for (int k = 0; k < K; ++k) result[static_cast<std::size_t>(k)] = darboux_weight(K - 1, k);
  return result;
}();
template <int K>
constexpr std::array<double, K> kSlopeWeights = [] {
  std::array<double, K> result{};
  for (int k = 1; k < K; ++k) result[static_cast<std::size_t>(k)] = k * darboux_weight(K - 2, k - 1);
  return result;
}();

constexpr int kCoshTerms = 10;
constexpr double kCoshReach = 64.0;  // up to there the terms left out are less than 1e-3 of it
constexpr std::array<double, kCoshTerms> kCoshCoefficients = [] {
  std::array<double, kCoshTerms> result{1.0};
  for (std::size_t k = 1; k < result.size(); ++k)
    result[k] = result[k - 1] / (2.0 * static_cast<double>(k) * (2.0 * static_cast<double>(k) - 1.0));
  return result;
}();
constexpr double kSmallestClass = 1.0 / (1 << -kSmallestOctave);

/// Memory for vector registers, from one piece.
class Workspace {
 public:
  explicit Workspace(std::size_t bytes)
      : data_(::operator new(bytes, std::align_val_t(kAlignment))), next_(static_cast<std::byte*>(data_)) {}
  ~Workspace() { ::operator delete(data_, std::align_val_t(kAlignment)); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  template <typename T>
  T* take(std::size_t count) {
    return reinterpret_cast<T*>(std::exchange(next_, next_ + count * sizeof(T)));
  }

 private:
  static constexpr std::size_t kAlignment = 64;
  void* data_;
  std::byte* next_;
};

#define STRUTT_KERNEL "integrate/series_kernel.inc"
#include "base/every_instruction_set.inc"

}  // namespace

void classify(const SeriesClasses& classes) {
  for_this_process(sse2::classify_all, avx2::classify_all, avx512::classify_all)(classes);
}

void sweep(const SeriesSweep& batch) {
  for_this_process(sse2::sweep_any, avx2::sweep_any, avx512::sweep_any)(batch);
}

}  // namespace strutt::detail
