#include "free_pendulum/double_double.hpp"

#include <algorithm>
#include <array>

namespace strutt {
namespace {

/// 1/n!, n = 0 ... 28.
const std::array<DoubleDouble, 29>& inverse_factorials() {
  static const auto table = [] {
    std::array<DoubleDouble, 29> values{1.0};
    for (std::size_t n = 1; n < values.size(); ++n)
      values[n] = values[n - 1] / DoubleDouble(static_cast<double>(n));
    return values;
  }();
  return table;
}

/// Taylor series, |x| <= pi/4 and a little: the first term left out is below 1e-33 of the sum.
SinCos small_sin_cos(DoubleDouble x) {
  const auto& inverse = inverse_factorials();
  const DoubleDouble square = x * x;
  DoubleDouble sine, cosine;
  for (int n = 26; n >= 0; n -= 2) {
    const auto i = static_cast<std::size_t>(n);
    cosine = inverse[i] - square * cosine;
    sine = inverse[i + 1] - square * sine;
  }
  return {x * sine, cosine};
}

SinCos turned(const SinCos& s, double quarters) {
  switch (static_cast<int>(quarters - 4.0 * std::floor(quarters / 4.0))) {
    case 0:
      return s;
    case 1:
      return {s.cosine, -s.sine};
    case 2:
      return {-s.sine, -s.cosine};
    default:
      return {-s.cosine, s.sine};
  }
}

/// x - n pi/2.
DoubleDouble minus_quarters(DoubleDouble x, double n) {
  const DoubleDouble rest = (x - two_product(0.5 * n, kPi.hi)) - two_product(0.5 * n, kPi.lo);
  return rest - DoubleDouble(0.5 * n * kPiThird);
}

}  // namespace

DoubleDouble sqrt(DoubleDouble a) {
  if (a.hi == 0.0) return {};
  int exponent = 0;
  std::frexp(a.hi, &exponent);
  exponent -= exponent % 2;
  const DoubleDouble m = ldexp(a, -exponent);
  const double root = std::sqrt(m.hi);
  const DoubleDouble rest = m - two_product(root, root);
  return ldexp(fast_two_sum(root, rest.hi / (2.0 * root)), exponent / 2);
}

DoubleDouble hypot(DoubleDouble a, DoubleDouble b) {
  const double size = std::max(std::abs(a.hi), std::abs(b.hi));
  if (size == 0.0) return {};
  int exponent = 0;
  std::frexp(size, &exponent);
  a = ldexp(a, -exponent);
  b = ldexp(b, -exponent);
  return ldexp(sqrt(a * a + b * b), exponent);
}

SinCos sin_cos(DoubleDouble x) {
  const double quarters = std::round(x.hi / (0.5 * kPi.hi));
  return turned(small_sin_cos(minus_quarters(x, quarters)), quarters);
}

SinCos sin_cos_of_turns(DoubleDouble turns) {
  const double quarters = std::round(4.0 * turns.hi);
  const DoubleDouble rest = turns - DoubleDouble(0.25 * quarters);
  return turned(small_sin_cos(rest * DoubleDouble(2.0) * kPi), quarters);
}

HalfTurns half_turns(DoubleDouble x) {
  double count = std::round(x.hi / kPi.hi);
  SinCos s = sin_cos(x);
  const auto turn_back = [&s] { s = {-s.sine, -s.cosine}; };
  if (std::fmod(count, 2.0) != 0.0) turn_back();
  if (s.cosine.hi < 0.0) {  // a tie, broken the wrong way
    count += std::copysign(1.0, s.sine.hi);
    turn_back();
  }
  return {count, s};
}

DoubleDouble atan2(DoubleDouble y, DoubleDouble x) {
  const double size = std::max(std::abs(x.hi), std::abs(y.hi));
  if (size == 0.0) return {};
  int exponent = 0;
  std::frexp(size, &exponent);
  x = ldexp(x, -exponent);
  y = ldexp(y, -exponent);
  // One Newton step from the value in double doubles its digits.
  const double angle = std::atan2(y.hi, x.hi);
  const SinCos s = sin_cos(angle);
  return DoubleDouble(angle) + (y * s.cosine - x * s.sine) / (x * s.cosine + y * s.sine);
}

}  // namespace strutt
