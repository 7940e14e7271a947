#include "integrate/hill_kernel.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "strutt/base/instruction_set.hpp"

namespace strutt::detail {
namespace {

#define STRUTT_INLINE [[gnu::always_inline]] inline
#define STRUTT_INLINE_LAMBDA __attribute__((always_inline))
// Not unrolled: a loop of one register's length would otherwise be gone before it can be vectorised.
#define STRUTT_LANES _Pragma("GCC unroll 1") for (std::size_t l = 0; l < kWidth; ++l)

// With these many stages between two looks at the exponents, no lane grows by more than about e^60.
constexpr std::size_t kStagesBetween = 66;

struct Fused {
  STRUTT_INLINE static double multiply_add(double a, double b, double c) { return __builtin_fma(a, b, c); }
};

struct Plain {  // without hardware for it, a fused multiply-add costs a hundred times more
  STRUTT_INLINE static double multiply_add(double a, double b, double c) { return a * b + c; }
};

/// 2^-e and e for the largest power of two 2^e not above x; e = 0 for x = 0 and for what is not finite.
struct PowerOfTwo {
  double inverse;
  std::int64_t exponent;
};
STRUTT_INLINE PowerOfTwo power_of_two(double x) {
  const auto biased = static_cast<std::int64_t>((std::bit_cast<std::uint64_t>(x) >> 52) & 0x7ff);
  const std::int64_t exponent = biased > 0 && biased < 0x7ff ? biased - 1023 : 0;
  return {std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent) << 52), exponent};
}

STRUTT_INLINE double larger(double a, double b) { return a > b ? a : b; }

/// `kWidth` lanes side by side.
template <typename Arithmetic, std::size_t kWidth>
struct Lanes {
  double u1[kWidth], du1[kWidth], u2[kWidth], du2[kWidth], mean[kWidth];
  std::int64_t exponent[kWidth];

  STRUTT_INLINE void start(const HillSweep& batch, std::size_t first, std::size_t count) {
    STRUTT_LANES {
      u1[l] = du2[l] = 1.0;
      du1[l] = u2[l] = 0.0;
      mean[l] = l < count ? batch.mean[first + l] : 0.0;
      exponent[l] = 0;
    }
  }

  /// Y' -= b h W Y, with weights[j * kWidth + l] of function j. kFunctions: how many, 0 if not known when
  /// compiled.
  template <int kFunctions>
  STRUTT_INLINE void kick(double b, const double* f, int functions, const double* weights) {
    STRUTT_LANES {
      double w = mean[l] * b;
      const int count = kFunctions > 0 ? kFunctions : functions;
      for (int j = 0; j < count; ++j)
        w = Arithmetic::multiply_add(weights[j * static_cast<int>(kWidth) + static_cast<int>(l)], f[j], w);
      du1[l] = Arithmetic::multiply_add(-w, u1[l], du1[l]);
      du2[l] = Arithmetic::multiply_add(-w, u2[l], du2[l]);
    }
  }

  STRUTT_INLINE void drift(double a) {
    STRUTT_LANES {
      u1[l] = Arithmetic::multiply_add(a, du1[l], u1[l]);
      u2[l] = Arithmetic::multiply_add(a, du2[l], u2[l]);
    }
  }

  /// Moves the common power of two of a lane into its exponent. Exact.
  STRUTT_INLINE void rescale() {
    STRUTT_LANES {
      const double first = larger(std::abs(u1[l]), std::abs(du1[l])),
                   second = larger(std::abs(u2[l]), std::abs(du2[l]));
      const PowerOfTwo power = power_of_two(larger(first, second));
      u1[l] *= power.inverse;
      du1[l] *= power.inverse;
      u2[l] *= power.inverse;
      du2[l] *= power.inverse;
      exponent[l] += power.exponent;
    }
  }

  STRUTT_INLINE void store(const HillSweep& batch, std::size_t first, std::size_t count) const {
    for (std::size_t l = 0; l < (count < kWidth ? count : kWidth); ++l) {
      batch.u1[first + l] = u1[l];
      batch.du1[first + l] = du1[l];
      batch.u2[first + l] = u2[l];
      batch.du2[first + l] = du2[l];
      batch.exponent[first + l] = exponent[l];
    }
  }
};

// The registers of a block, one statement for all of them: a loop of this length is always unrolled.
#define STRUTT_REGISTERS _Pragma("GCC unroll 8") for (std::size_t r = 0; r < kRegisters; ++r)

/// All lanes in blocks of kRegisters registers of kWidth lanes; the last block is filled up with lanes that
/// nobody reads.
template <typename Arithmetic, std::size_t kWidth, std::size_t kRegisters, int kFunctions>
STRUTT_INLINE void sweep_blocks(const HillSweep& batch) {
  constexpr std::size_t kBlock = kWidth * kRegisters;
  const auto functions = static_cast<std::size_t>(batch.functions);
  std::vector<double> weights(functions * kBlock, 0.0);  // register by register, function by function
  for (std::size_t first = 0; first < batch.lanes; first += kBlock) {
    const std::size_t count = batch.lanes - first < kBlock ? batch.lanes - first : kBlock;
    for (std::size_t l = 0; l < count; ++l) {
      const std::size_t place = l / kWidth * functions * kWidth + l % kWidth;
      for (std::size_t j = 0; j < functions; ++j) weights[place + j * kWidth] = batch.weights[j][first + l];
    }
    Lanes<Arithmetic, kWidth> lanes[kRegisters];
    const auto kick = [&](std::size_t s) STRUTT_INLINE_LAMBDA {
      STRUTT_REGISTERS lanes[r].template kick<kFunctions>(batch.kick[s], batch.basis + s * functions,
                                                          batch.functions,
                                                          weights.data() + r * functions * kWidth);
    };
    STRUTT_REGISTERS lanes[r].start(batch, first + r * kWidth, count > r * kWidth ? count - r * kWidth : 0);
    for (std::size_t begin = 0; begin < batch.stages; begin += kStagesBetween) {
      const std::size_t end = batch.stages - begin < kStagesBetween ? batch.stages : begin + kStagesBetween;
      for (std::size_t s = begin; s < end; ++s) {
        kick(s);
        STRUTT_REGISTERS lanes[r].drift(batch.drift[s]);
      }
      STRUTT_REGISTERS lanes[r].rescale();
    }
    kick(batch.stages);
    STRUTT_REGISTERS {
      lanes[r].rescale();
      if (count > r * kWidth) lanes[r].store(batch, first + r * kWidth, count - r * kWidth);
    }
  }
}

template <typename Arithmetic, std::size_t kWidth, std::size_t kRegisters>
STRUTT_INLINE void sweep_with(const HillSweep& batch) {
  if (batch.functions == 1) {
    sweep_blocks<Arithmetic, kWidth, kRegisters, 1>(batch);
  } else {
    sweep_blocks<Arithmetic, kWidth, kRegisters, 0>(batch);
  }
}

/// A few lanes fill one register; many are taken four registers at a time, enough independent chains to hide
/// the latency of the multiply-adds.
template <typename Arithmetic, std::size_t kWidth>
STRUTT_INLINE void sweep_registers(const HillSweep& batch) {
  if (batch.lanes <= kWidth) {
    sweep_with<Arithmetic, kWidth, 1>(batch);
  } else {
    sweep_with<Arithmetic, kWidth, 4>(batch);
  }
}

[[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")]] void sweep_avx512(
    const HillSweep& batch) {
  sweep_registers<Fused, 8>(batch);
}
[[gnu::target("avx2,fma")]] void sweep_avx2(const HillSweep& batch) { sweep_registers<Fused, 4>(batch); }
void sweep_sse2(const HillSweep& batch) { sweep_registers<Plain, 2>(batch); }

}  // namespace

void sweep(const HillSweep& batch) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return sweep_avx512(batch);
    case InstructionSet::avx2:
      return sweep_avx2(batch);
    case InstructionSet::sse2:
      return sweep_sse2(batch);
  }
}

}  // namespace strutt::detail
