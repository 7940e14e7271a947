// Compiled with -fno-math-errno and -fno-trapping-math (CMakeLists.txt), without which square roots and
// comparisons are not vectorised; neither changes a result.
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "chart/cell_row.hpp"
#include "chart/vector_math.hpp"
#include "strutt/base/instruction_set.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

#define STRUTT_INLINE [[gnu::always_inline]] inline

constexpr double kUnit = 0x1p-53;
constexpr double kStable = static_cast<double>(Verdict::stable),
                 kUnstable = static_cast<double>(Verdict::unstable),
                 kUnresolved = static_cast<double>(Verdict::unresolved);

STRUTT_INLINE double larger(double a, double b) { return a > b ? a : b; }

/// What the stages hand on, per cell, with 2^(2 exponent) in it.
struct Stage {
  alignas(64) double upper[CellRow::kMost];  // u1' u2 = (D - 2)/4
  alignas(64) double lower[CellRow::kMost];  // u1 u2' = (D + 2)/4
  alignas(64) double gap[CellRow::kMost];    // 2 - |D|
};

/// Bound of the error of a product of two factors with bounds.
STRUTT_INLINE double product_error(double a, double ea, double b, double eb, double units) {
  return std::abs(a) * eb + std::abs(b) * ea + ea * eb + units * kUnit * std::abs(a * b);
}

/// See monodromy_error.
STRUTT_INLINE void errors(const CellRow& row, double square, double* __restrict error, std::size_t count) {
  const auto [e1, e2, d1, d2] = row.factor_error;
  const double *u1s = row.factors[0], *u2s = row.factors[1], *du1s = row.factors[2], *du2s = row.factors[3];
  const double inverse_box_kappa = 1.0 / row.box_kappa;
  const double weight_of_trace = row.shifted ? 1.0 : 0.0;
  for (std::size_t c = 0; c < count; ++c) {
    const double u1 = u1s[c], u2 = u2s[c], du1 = du1s[c], du2 = du2s[c];
    const double ratio = row.kappa[c] * inverse_box_kappa,
                 inverse_ratio = row.inverse_kappa[c] * row.box_kappa;
    const double h = row.damping.h[c], decay = row.damping.decay[c];
    const double s = h * (0.5 * std::numbers::inv_pi) * row.inverse_kappa[c];
    const double a = u1 * du2 + du1 * u2, b = 2.0 * u2 * du2 * ratio, g = 2.0 * u1 * du1 * inverse_ratio;
    const double ea = product_error(u1, e1, du2, d2, 8.0) + product_error(u2, e2, du1, d1, 8.0);
    const double eb = 2.0 * ratio * product_error(u2, e2, du2, d2, 16.0),
                 eg = 2.0 * inverse_ratio * product_error(u1, e1, du1, d1, 16.0);
    const double size =
        larger(std::abs(b), larger(std::abs(a) + s * std::abs(b), std::abs(g) + s * s * std::abs(b)));
    const double rounding = h > 0.0 ? (8.0 + 4.0 * h) * kUnit : 0.0;
    const double largest_error =
        larger(2.0 * (ea + s * eb), larger(eb, eg + 2.0 * s * ea + s * s * eb)) + rounding * size;
    const double largest = larger(larger(std::abs(a + s * b), std::abs(a - s * b)),
                                  larger(std::abs(b), std::abs(g - s * s * b)));
    const double unit = square * decay;
    const double of_matrix = largest_error * unit / larger(1.0, largest * unit) + 8.0 * kUnit;
    const double of_trace = 2.0 * ea * unit / larger(1.0, std::abs(a) * unit) + (8.0 + 4.0 * h) * kUnit;
    error[c] = larger(weight_of_trace * of_trace, of_matrix);
  }
}

/// See discriminant_gap and hill_margin.
STRUTT_INLINE void margins(const CellRow& row, double square, Stage& stage, double* __restrict margin,
                           double* __restrict verdict, double* __restrict trace, std::size_t count) {
  const auto [e1, e2, d1, d2] = row.factor_error;
  const double *u1s = row.factors[0], *u2s = row.factors[1], *du1s = row.factors[2], *du2s = row.factors[3];
  for (std::size_t c = 0; c < count; ++c) {
    const double u1 = u1s[c], u2 = u2s[c], du1 = du1s[c], du2 = du2s[c];
    const double upper = du1 * u2 * square, lower = u1 * du2 * square;
    const double upper_error = product_error(u2, e2, du1, d1, 2.0) * square,
                 lower_error = product_error(u1, e1, du2, d2, 2.0) * square;
    const double half_trace = upper + lower;
    const double gap = half_trace < 0.0 ? 4.0 * lower : -4.0 * upper;
    const double gap_error = 4.0 * (half_trace < 0.0 ? lower_error : upper_error);
    const double h = row.damping.h[c], half_sinh = row.damping.half_sinh[c];
    const double allowance = 4.0 * half_sinh * half_sinh, share = row.damping.half_over_cosh[c];
    const double value = (gap + allowance) * share;
    const double error =
        (gap_error + 8.0 * kUnit * (row.damping.sinh[c] * h + std::abs(gap) + allowance)) * share;
    stage.upper[c] = upper;
    stage.lower[c] = lower;
    stage.gap[c] = gap;
    margin[c] = value;
    const double sign = value > 0.0 ? kStable : kUnstable;
    verdict[c] = std::abs(value) > error ? sign : kUnresolved;
    trace[c] = 2.0 * half_trace * row.damping.decay[c];
  }
}

/// See hill_growth.
STRUTT_INLINE void growths(const CellRow& row, const Stage& stage, double* __restrict growth,
                           std::size_t count) {
  for (std::size_t c = 0; c < count; ++c) {
    const double half_gap =
        0.5 * stage.gap[c] < 0.0 ? 0.5 * stage.gap[c] : -1.0;  // not used where it is positive
    const double half_sinh = row.damping.half_sinh[c], cosh = row.damping.cosh[c];
    const double x = 1.0 - half_gap, sinh_x = std::sqrt(-half_gap * (1.0 + x));
    const double excess = -half_gap - 2.0 * half_sinh * half_sinh;
    const double sinh = excess * (x + cosh) / (sinh_x * cosh + x * row.damping.sinh[c]);
    const double unstable = vector_math::asinh(sinh);
    growth[c] = stage.gap[c] < 0.0 ? unstable : 0.0 - row.damping.h[c];
  }
}

/// See quadrant and winding_number.
STRUTT_INLINE void windings(const CellRow& row, const Stage& stage, double* __restrict winding,
                            std::size_t count) {
  const double *u2s = row.factors[1], *du2s = row.factors[3];
  for (std::size_t c = 0; c < count; ++c) {
    const double y = u2s[c], v = du2s[c];
    const double above = v > 0.0 ? 0.0 : 1.0, below = v < 0.0 ? 2.0 : 3.0;
    const double pattern = y > 0.0 ? above : below;
    const double quadrant =
        pattern + 4.0 * vector_math::nearest(0.25 * (row.quarter_turns[c] - (pattern + 0.5)));
    const double odd = quadrant - 2.0 * vector_math::nearest(0.5 * quadrant - 0.25);
    const double upper = stage.upper[c], lower = stage.lower[c];
    const double parity = upper + lower < 0.0 ? 1.0 : 0.0;
    const double in_tongue = 0.5 * (quadrant + std::abs(odd - parity));
    const double angle = vector_math::atan_of_root(std::abs(upper), std::abs(lower)) * std::numbers::inv_pi;
    const double between = 0.5 * (quadrant + odd) + (odd > 0.5 ? -angle : angle);
    winding[c] = stage.gap[c] <= 0.0 ? in_tongue : between;
  }
}

STRUTT_INLINE void all_stages(CellRow& row) {
  const double square = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + 2 * row.exponent) << 52);
  const std::size_t count = (row.count + 15) / 16 * 16;
  Stage stage;
  errors(row, square, row.error, count);
  margins(row, square, stage, row.margin, row.verdict, row.trace, count);
  if (row.with_growth) growths(row, stage, row.growth, count);
  if (row.with_winding) windings(row, stage, row.winding, count);
}

[[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,fma,prefer-vector-width=512")]] void cells_avx512(
    CellRow& row) {
  all_stages(row);
}
[[gnu::target("avx2,fma")]] void cells_avx2(CellRow& row) { all_stages(row); }
void cells_sse2(CellRow& row) { all_stages(row); }

}  // namespace

void plain_cells(CellRow& row) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return cells_avx512(row);
    case InstructionSet::avx2:
      return cells_avx2(row);
    case InstructionSet::sse2:
      return cells_sse2(row);
  }
}

}  // namespace strutt
