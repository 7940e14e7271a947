#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "base/constants.hpp"
#include "base/dispatch.hpp"
#include "chart/block_error.hpp"
#include "chart/cell_row.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

constexpr double kStable = static_cast<double>(Verdict::stable),
                 kUnstable = static_cast<double>(Verdict::unstable),
                 kUnresolved = static_cast<double>(Verdict::unresolved);

/// Cells whose errors have a bound in common; whole registers of any width.
constexpr std::size_t kBlockCells = 120;

#define STRUTT_KERNEL "chart/cell_kernel.inc"
#include "base/every_instruction_set.inc"

}  // namespace

void plain_cells(CellRow& row) {
  for_this_process(sse2::compute_any, avx2::compute_any, avx512::compute_any)(row);
}

void trace_sides(const double* trace, std::size_t count, std::size_t block, double least_gap,
                 TraceSide* result) {
  for_this_process(sse2::sides, avx2::sides, avx512::sides)(trace, count, block, least_gap, result);
}

}  // namespace strutt
