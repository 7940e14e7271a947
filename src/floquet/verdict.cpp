#include "strutt/floquet/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"
#include "floquet/half_period_factors.hpp"

namespace strutt {
namespace {

constexpr double kLogLarge = 200.0;  // above, cosh and D are handled by their logarithms

struct Bounded {
  double value = 0.0;
  double error = 0.0;
};

/// Product whose bound excludes 0 whenever those of both factors do: the middle and half width of the product
/// of the two intervals. 0 with error 0 only if a factor is exactly 0.
Bounded product(Bounded a, Bounded b) {
  const double p = a.value * b.value;
  if (a.error < std::abs(a.value) && b.error < std::abs(b.value)) {
    const double ra = a.error / std::abs(a.value), rb = b.error / std::abs(b.value);
    return {p * (1.0 + ra * rb), std::abs(p) * (ra + rb + 2.0 * kUnit)};
  }
  return {p, std::abs(a.value) * b.error + a.error * std::abs(b.value) + a.error * b.error +
                 2.0 * kUnit * std::abs(p)};
}

Bounded entry(const BoundedMatrix2& m, int i, int j) { return {m.value.mantissa(i, j), m.error(i, j)}; }

DiscriminantGap from_trace(Bounded trace, long exponent) {
  DiscriminantGap d;
  d.sign = trace.value < 0.0 ? -1 : 1;
  d.log_abs = std::log(std::abs(trace.value)) + static_cast<double>(exponent) * std::numbers::ln2;
  d.log_abs_error = trace.error / std::abs(trace.value) + kUnit * std::abs(d.log_abs);
  const int shift = static_cast<int>(std::clamp(exponent, -5000L, 5000L));
  d.gap = 2.0 - std::ldexp(std::abs(trace.value), shift);
  d.gap_error = std::ldexp(trace.error, shift) + 2.0 * kUnit;
  return d;
}

DiscriminantGap from_factors(Bounded u1, Bounded u2, Bounded du1, Bounded du2, long exponent) {
  const Bounded upper = product(du1, u2);  // u1' u2 = (D - 2)/4
  const Bounded lower = product(u1, du2);  // u1 u2' = (D + 2)/4
  exponent *= 2;
  auto d = from_trace({2.0 * (upper.value + lower.value), 2.0 * (upper.error + lower.error)}, exponent);
  const int shift = static_cast<int>(std::clamp(exponent, -5000L, 5000L));
  const Bounded& near = d.sign > 0 ? upper : lower;
  d.gap = -d.sign * std::ldexp(4.0 * near.value, shift);
  d.gap_error = std::ldexp(4.0 * near.error, shift);
  return d;
}

DiscriminantGap from_period(const BoundedMatrix2& m) {
  const Bounded a = entry(m, 0, 0), d = entry(m, 1, 1);
  auto result = from_trace({a.value + d.value, a.error + d.error + kUnit * std::abs(a.value + d.value)},
                           m.value.exponent);
  const Bounded half_difference{0.5 * (a.value - d.value), 0.5 * (a.error + d.error)};
  const Bounded off = product(entry(m, 0, 1), entry(m, 1, 0));
  const double square = half_difference.value * half_difference.value;
  const double size = 2.0 + std::exp(result.log_abs);
  const int shift = static_cast<int>(std::clamp(2 * m.value.exponent, -5000L, 5000L));
  const double gap = -4.0 * std::ldexp(square + off.value, shift) / size;
  const double square_error =
      (2.0 * std::abs(half_difference.value) + half_difference.error) * half_difference.error +
      2.0 * kUnit * square;
  const double gap_error =
      4.0 * std::ldexp(square_error + off.error, shift) / size + 4.0 * kUnit * std::abs(gap);
  if (gap_error < result.gap_error) {
    result.gap = gap;
    result.gap_error = gap_error;
  }
  return result;
}

/// ln(2 cosh h) for h >= 0.
double log_two_cosh(double h) { return h + std::log1p(std::exp(-2.0 * h)); }

}  // namespace

std::string_view to_string(Verdict verdict) {
  static constexpr std::array<std::string_view, kVerdictCount> names = {"stable", "unstable", "boundary",
                                                                        "unresolved"};
  return names[static_cast<std::size_t>(verdict)];
}

Verdict verdict_of(const Margin& margin) {
  if (margin.value == 0.0 && margin.error == 0.0) return Verdict::boundary;
  if (!(std::abs(margin.value) > margin.error)) return Verdict::unresolved;
  return margin.value > 0.0 ? Verdict::stable : Verdict::unstable;
}

DiscriminantGap discriminant_gap(const HillMonodromy& monodromy) {
  if (!monodromy.half) return from_period(monodromy.undamped);
  const auto& half = *monodromy.half;
  return from_factors(entry(half, 0, 0), entry(half, 0, 1), entry(half, 1, 0), entry(half, 1, 1),
                      half.value.exponent);
}

DiscriminantGap discriminant_gap(const HalfPeriodFactors& f) {
  const auto factor = [&](std::size_t i) { return Bounded{f.value[i], f.error[i]}; };
  return from_factors(factor(0), factor(1), factor(2), factor(3), f.exponent);
}

Margin hill_margin(const DiscriminantGap& d, double half_damping) {
  const double h = half_damping;
  if (d.log_abs > kLogLarge || h > kLogLarge) {
    const double log_ratio = d.log_abs - log_two_cosh(h);
    if (log_ratio > std::log(-kLowestMargin)) return {kLowestMargin, 0.0};
    const double error = d.log_abs_error + 4.0 * kUnit * (h + std::abs(d.log_abs));
    return {-std::expm1(log_ratio), std::exp(log_ratio) * std::expm1(error) + 2.0 * kUnit};
  }
  if (h == 0.0) return {0.0 + 0.5 * d.gap, 0.5 * d.gap_error};  // not -0
  const double half_sinh = std::sinh(0.5 * h), two_cosh = 2.0 * std::cosh(h);
  const double allowance = 4.0 * half_sinh * half_sinh;  // 2 cosh h - 2
  const double h_error = 4.0 * kUnit * h;
  const double error =
      d.gap_error + 2.0 * std::sinh(h) * h_error + 8.0 * kUnit * (std::abs(d.gap) + allowance);
  return {(d.gap + allowance) / two_cosh, error / two_cosh};
}

double hill_growth(const DiscriminantGap& d, double half_damping) {
  const double h = half_damping;
  if (d.gap >= 0.0) return 0.0 - h;  // not -0
  if (d.log_abs > kLogLarge || h > kLogLarge) {
    return (d.log_abs > 20.0 ? d.log_abs : std::acosh(0.5 * std::exp(d.log_abs))) - h;
  }
  // asinh of sinh(acosh X - h), X = |D|/2: (X - cosh h)(X + cosh h)/(sinh(acosh X) cosh h + X sinh h)
  const double x = 1.0 - 0.5 * d.gap;
  const double sinh_x = std::sqrt(-0.5 * d.gap * (1.0 + x));
  const double half_sinh = std::sinh(0.5 * h), cosh_h = std::cosh(h);
  const double excess = -0.5 * d.gap - 2.0 * half_sinh * half_sinh;  // X - cosh h
  return std::asinh(excess * (x + cosh_h) / (sinh_x * cosh_h + x * std::sinh(h)));
}

}  // namespace strutt
