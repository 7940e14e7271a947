#pragma once

#include <cmath>

namespace strutt {

/// An unevaluated sum hi + lo with |lo| <= ulp(hi)/2: 106 bits, the exponent range of double. Sums and
/// products are good to a few 2^-104 relative (sums: of the larger operand), unless the low part underflows.
/// Method: Dekker 1971, Knuth; Joldes, Muller and Popescu, ACM TOMS 44 (2017).
struct DoubleDouble {
  double hi = 0.0;
  double lo = 0.0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : hi(value) {}  // NOLINT(google-explicit-constructor): a double is one
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
  explicit operator double() const { return hi + lo; }
};

/// a + b exactly.
inline DoubleDouble two_sum(double a, double b) {
  const double s = a + b, part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}
/// a + b exactly, |a| >= |b|.
inline DoubleDouble fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}
/// a b exactly.
inline DoubleDouble two_product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

inline DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }
inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble high = two_sum(a.hi, b.hi), low = two_sum(a.lo, b.lo);
  const DoubleDouble sum = fast_two_sum(high.hi, high.lo + low.hi);
  return fast_two_sum(sum.hi, sum.lo + low.lo);
}
inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + (-b); }
inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}
inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double q = a.hi / b.hi;
  const DoubleDouble rest = a - DoubleDouble(q) * b;
  const double next = rest.hi / b.hi;
  const DoubleDouble last = rest - DoubleDouble(next) * b;
  return fast_two_sum(q, next) + DoubleDouble(last.hi / b.hi);
}
inline bool operator<(DoubleDouble a, DoubleDouble b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); }
inline bool operator==(DoubleDouble a, DoubleDouble b) { return a.hi == b.hi && a.lo == b.lo; }

inline DoubleDouble abs(DoubleDouble a) { return a.hi < 0.0 ? -a : a; }
inline DoubleDouble ldexp(DoubleDouble a, int exponent) {
  return {std::ldexp(a.hi, exponent), std::ldexp(a.lo, exponent)};
}
/// a >= 0; tiny and huge ones are scaled, so that no low part is lost.
DoubleDouble sqrt(DoubleDouble a);
/// sqrt(a^2 + b^2) without overflow and underflow.
DoubleDouble hypot(DoubleDouble a, DoubleDouble b);

inline constexpr DoubleDouble kPi{3.141592653589793, 1.2246467991473532e-16};
inline constexpr DoubleDouble kTwoPi{2.0 * kPi.hi, 2.0 * kPi.lo};
inline constexpr double kPiThird = -2.9947698097183397e-33;  ///< pi - kPi

struct SinCos {
  DoubleDouble sine, cosine;
};
/// Relative error of both about 1e-31, also next to their zeros (pi is subtracted in 159 bits); |x| <= 1e9.
SinCos sin_cos(DoubleDouble x);
/// sin and cos of 2 pi `turns`; the whole quarters are taken out exactly.
SinCos sin_cos_of_turns(DoubleDouble turns);

/// x = pi n + rest with |rest| <= pi/2: n, and sin and cos (>= 0) of the rest, which keep their relative
/// accuracy.
struct HalfTurns {
  double count;
  SinCos rest;
};
HalfTurns half_turns(DoubleDouble x);

/// Angle of the point (x, y), in (-pi, pi].
DoubleDouble atan2(DoubleDouble y, DoubleDouble x);

}  // namespace strutt
