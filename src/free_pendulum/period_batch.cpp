#include <algorithm>
#include <array>
#include <cstddef>

#include "base/dispatch.hpp"
#include "free_pendulum/period_table.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/free_pendulum/period.hpp"

namespace strutt {
namespace {

constexpr std::size_t kBlock = 256;

/// Distance from the top of an amplitude. pi is added in two parts: next to it the distance has full relative
/// accuracy.
struct FromAmplitude {
  [[gnu::always_inline]] static double distance(double amplitude) { return (kPi.hi - amplitude) + kPi.lo; }
};
struct FromTop {
  [[gnu::always_inline]] static double distance(double from_top) { return from_top; }
};

/// The sign bit is set if the input or y is negative, or y is not in [kLeast, pi]. (Comparisons would keep
/// the compiler from vector code.)
[[gnu::always_inline]] inline std::uint64_t strange_bits(double input, double y) {
  const auto bits = std::bit_cast<std::uint64_t>(y);
  return std::bit_cast<std::uint64_t>(input) | bits |
         (bits - std::bit_cast<std::uint64_t>(PeriodTable::kLeast)) |
         (std::bit_cast<std::uint64_t>(kPi.hi) - bits);
}

/// The loop that every instruction set compiles for itself. Returns whether the table is good for all inputs.
template <typename Input>
[[gnu::always_inline]] inline bool evaluate_block(const double* columns, const double* input, double* ratio,
                                                  std::size_t count) {
  std::uint64_t strange = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double y = Input::distance(input[i]);
    const TwoParts parts = table_parts(columns, y);
    ratio[i] = parts.large + parts.small;
    strange |= strange_bits(input[i], y);
  }
  return (strange >> 63) == 0;
}

// GCC forgets __restrict when it inlines: it must stand on the outermost function.
#define STRUTT_ARRAYS                                                                         \
  const double* __restrict columns, const double* __restrict input, double* __restrict ratio, \
      std::size_t count

template <typename Input>
bool evaluate_sse2(STRUTT_ARRAYS) {
  return evaluate_block<Input>(columns, input, ratio, count);
}
template <typename Input>
[[gnu::target("avx2")]] bool evaluate_avx2(STRUTT_ARRAYS) {
  return evaluate_block<Input>(columns, input, ratio, count);
}
template <typename Input>
[[gnu::target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")]] bool evaluate_avx512(STRUTT_ARRAYS) {
  return evaluate_block<Input>(columns, input, ratio, count);
}
#undef STRUTT_ARRAYS

/// The elements that the table is not made for, one by one.
template <typename Input>
void repair(const double* input, double* ratio, std::size_t count, double (*one)(double)) {
  for (std::size_t i = 0; i < count; ++i)
    if ((strange_bits(input[i], Input::distance(input[i])) >> 63) != 0) ratio[i] = one(input[i]);
}

template <typename Input>
void evaluate(std::span<const double> input, std::span<double> ratio, double (*one)(double)) {
  if (input.size() != ratio.size())
    throw InvalidInput("ratio.size()", std::to_string(ratio.size()), "that of the input");
  const auto block = for_this_process(evaluate_sse2<Input>, evaluate_avx2<Input>, evaluate_avx512<Input>);
  const double* const columns = PeriodTable::instance().columns();
  std::array<double, kBlock> result;
  for (std::size_t first = 0; first < input.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, input.size() - first);
    const double* const in = input.data() + first;
    if (!block(columns, in, result.data(), count)) repair<Input>(in, result.data(), count, one);
    std::copy_n(result.begin(), count, ratio.data() + first);
  }
}

double ratio_of_amplitude(double amplitude) {
  return period_ratio_at(amplitude >= 0.0 ? FromAmplitude::distance(amplitude) : amplitude);
}

}  // namespace

void period_ratios(std::span<const double> amplitude, std::span<double> ratio) {
  const DefaultFloatingPoint environment;
  evaluate<FromAmplitude>(amplitude, ratio, ratio_of_amplitude);
}

void period_ratios_from_top(std::span<const double> from_top, std::span<double> ratio) {
  const DefaultFloatingPoint environment;
  evaluate<FromTop>(from_top, ratio, period_ratio_at);
}

double period_ratio(double amplitude) {
  const DefaultFloatingPoint environment;
  return ratio_of_amplitude(amplitude);
}

double period_ratio_from_top(double from_top) {
  const DefaultFloatingPoint environment;
  return period_ratio_at(from_top);
}

}  // namespace strutt
