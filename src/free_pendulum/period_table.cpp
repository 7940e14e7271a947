#include "free_pendulum/period_table.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "free_pendulum/agm.hpp"

namespace strutt {
namespace {

constexpr int kDegree = PeriodTable::kColumns - 2;
// (2/pi) ln 2
constexpr DoubleDouble kOctave{0.4412712003053032, -1.4923443078826813e-17};

/// f and f' at y: f = 1/AGM(1, k'), k' = sin(y/2), f' = -f (1/2 - S) k/(2 k') with S as in AgmSteps::gap_sum.
std::array<DoubleDouble, 2> value_and_slope(double y) {
  const SinCos half = sin_cos(0.5 * y);
  const AgmSteps agm(1.0, half.sine);
  const DoubleDouble value = DoubleDouble(1.0) / agm.mean();
  const DoubleDouble bracket = DoubleDouble(0.5) - agm.gap_sum();
  return {value, -(value * bracket * half.cosine / ldexp(half.sine, 1))};
}

/// Taylor coefficients of f at y, by equating the coefficients of t^n in sin y f'' + cos y f' = sin y f/4.
/// In extended precision, since y = pi is a singular point of the equation (not of f).
using Coefficients = std::array<long double, kDegree + 1>;
Coefficients taylor_coefficients(long double y, DoubleDouble value, DoubleDouble slope) {
  Coefficients sine{std::sin(y), std::cos(y)}, cosine{std::cos(y), -std::sin(y)};
  for (std::size_t j = 2; j <= kDegree; ++j) {
    const auto factor = static_cast<long double>(j * (j - 1));
    sine[j] = -sine[j - 2] / factor;
    cosine[j] = -cosine[j - 2] / factor;
  }
  const auto extended = [](DoubleDouble x) { return static_cast<long double>(x.hi) + x.lo; };
  Coefficients f{extended(value), extended(slope)};
  for (std::size_t n = 0; n + 2 <= kDegree; ++n) {
    long double sum = 0.0L;
    for (std::size_t j = 0; j <= n; ++j) {
      const auto order = static_cast<long double>(n - j + 1);
      sum += 0.25L * sine[j] * f[n - j] - order * cosine[j] * f[n - j + 1];
      if (j > 0) sum -= sine[j] * (order + 1.0L) * order * f[n - j + 2];
    }
    f[n + 2] = sum / (sine[0] * static_cast<long double>((n + 2) * (n + 1)));
  }
  return f;
}

}  // namespace

PeriodTable::PeriodTable() : columns_(static_cast<std::size_t>(kRows * kColumns)) {
  for (std::int32_t row = 0; row < kRows; ++row) {
    const auto twice = static_cast<std::uint64_t>(2 * (kFirstRow + row) + 1);
    const auto y = std::bit_cast<double>(twice << (kRowBits - 1));
    const auto [value, slope] = value_and_slope(y);
    const auto f = taylor_coefficients(y, value, slope);
    const auto entry = [&](std::size_t column) -> double& {
      return columns_[static_cast<std::size_t>(row) + kRows * column];
    };
    entry(0) = value.hi;
    entry(1) = value.lo;
    for (std::size_t n = 1; n < f.size(); ++n) entry(n + 1) = static_cast<double>(f[n]);
  }
}

const PeriodTable& PeriodTable::instance() {
  static const PeriodTable table;
  return table;
}

double PeriodTable::deep(double y) const {
  int exponent = 0, least = 0;
  const double mantissa = std::frexp(y, &exponent);
  std::frexp(kLeast, &least);
  const TwoParts parts = table_parts(columns(), std::ldexp(mantissa, least));
  const double octaves = least - exponent;
  const DoubleDouble sum = two_sum(parts.large, octaves * kOctave.hi);
  const double rounding = two_product(octaves, kOctave.hi).lo;
  return sum.hi + (sum.lo + (rounding + octaves * kOctave.lo + parts.small));
}

double period_ratio_at(double y) {
  const PeriodTable& table = PeriodTable::instance();
  if (!(y >= 0.0 && y <= kPi.hi)) return std::numeric_limits<double>::quiet_NaN();
  if (y == 0.0) return std::numeric_limits<double>::infinity();
  if (y < PeriodTable::kLeast) return table.deep(y);
  const TwoParts parts = table_parts(table.columns(), y);
  return parts.large + parts.small;
}

}  // namespace strutt
