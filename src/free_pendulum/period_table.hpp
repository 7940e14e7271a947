#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "free_pendulum/double_double.hpp"

namespace strutt {

/// T/T0 as a function of the distance y from the top, tabulated for evaluation in a few products and sums.
/// Every octave of y is cut into 64 equal intervals; each has the Taylor series about its middle,
///   T/T0 = c0 + t (c1 + t (c2 + ... )),  t = y - middle (exact),
/// with c0 in twice the working precision. The series follow from the differential equation that
/// T/T0 = P_{-1/2}(-cos y) obeys (Legendre): sin y f'' + cos y f' = sin y f/4, started with the AGM.
/// The singularity at y = 0 is 128 half intervals away: the first term left out is below 2^-60 of the sum,
/// and the only rounding that counts is that of the last sum.
class PeriodTable {
 public:
  /// Made at the first call (about 2 ms), the same for all threads.
  static const PeriodTable& instance();

  static constexpr double kLeast = 0x1p-27;  ///< below, see `deep`
  static constexpr int kColumns = 9;         ///< c0, its low part, c1 ... c7

  /// Column by column, so that the lanes of a vector load their coefficients with one gather each.
  const double* columns() const { return columns_.data(); }

  /// For 0 < y < kLeast: f(y) = f(2^n y) + n (2/pi) ln 2, since f = (2/pi) ln(8/y) + O(y^2 ln y).
  double deep(double y) const;

 private:
  PeriodTable();
  std::vector<double> columns_;
};

inline constexpr int kRowBits = 52 - 6;
/// The leading bits of y: exponent and 6 bits of the mantissa.
constexpr std::int32_t row_bits(double y) {
  return static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(y) >> kRowBits);
}
inline constexpr std::int32_t kFirstRow = row_bits(PeriodTable::kLeast);
inline constexpr std::int32_t kLastRow = row_bits(kPi.hi) - kFirstRow;
inline constexpr std::int32_t kRows = kLastRow + 1;

/// The two parts whose sum is f(y): neither branches nor library calls, so that a loop over it becomes vector
/// code. Only kLeast <= y <= pi is meaningful, but any y is safe. Products and sums are rounded one by one
/// (no FMA): every instruction set gives the same bits.
struct TwoParts {
  double large, small;
};
[[gnu::always_inline]] inline TwoParts table_parts(const double* columns, double y) {
  std::int64_t row = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(y) >> kRowBits) - kFirstRow;
  row = row < 0 ? 0 : row;
  row = row > kLastRow ? kLastRow : row;
  constexpr std::uint64_t kHalf = std::uint64_t{1} << (kRowBits - 1);
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(y);
  const double t = y - std::bit_cast<double>((bits & ~(2 * kHalf - 1)) | kHalf);
  const auto c = [columns, row](std::int64_t column) { return columns[row + kRows * column]; };
  const double series = c(2) + t * (c(3) + t * (c(4) + t * (c(5) + t * (c(6) + t * (c(7) + t * c(8))))));
  return {c(0), c(1) + t * series};
}

/// T/T0 at the distance y from the top for any y; NaN outside [0, pi], infinite at 0.
double period_ratio_at(double y);

}  // namespace strutt
