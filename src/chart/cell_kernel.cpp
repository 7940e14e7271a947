#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "base/constants.hpp"
#include "base/dispatch.hpp"
#include "chart/cell_row.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

constexpr double kStable = static_cast<double>(Verdict::stable),
                 kUnstable = static_cast<double>(Verdict::unstable),
                 kUnresolved = static_cast<double>(Verdict::unresolved);

/// Bounds that the errors of a row are compared with: four an octave, the same whatever the width of a
/// register. This is the last one not above `error` that is a power of two.
double first_bound(double error) {
  if (!(error < kInfinity)) return kInfinity;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(error) & 0x7ff0000000000000);
}

/// The one after; the error allowed is one of them, and the last.
double next_bound(double bound, double allowed) {
  const double next = std::bit_cast<double>(std::bit_cast<std::uint64_t>(bound) + (std::uint64_t{1} << 50));
  return bound < allowed ? std::min(next, allowed) : kInfinity;
}

#define STRUTT_KERNEL "chart/cell_kernel.inc"
#include "base/every_instruction_set.inc"

}  // namespace

void plain_cells(CellRow& row) {
  for_this_process(sse2::compute_any, avx2::compute_any, avx512::compute_any)(row);
}

}  // namespace strutt
