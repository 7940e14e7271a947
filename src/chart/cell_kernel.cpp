#include <immintrin.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "base/dispatch.hpp"
#include "chart/cell_row.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kStable = static_cast<double>(Verdict::stable),
                 kUnstable = static_cast<double>(Verdict::unstable),
                 kUnresolved = static_cast<double>(Verdict::unresolved);

#define STRUTT_KERNEL "chart/cell_kernel.inc"
#include "base/every_instruction_set.inc"

}  // namespace

void plain_cells(CellRow& row) {
  for_this_process(sse2::compute_any, avx2::compute_any, avx512::compute_any)(row);
}

}  // namespace strutt
