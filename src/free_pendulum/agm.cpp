#include "free_pendulum/agm.hpp"

#include <cmath>

namespace strutt {

AgmSteps::AgmSteps(DoubleDouble a, DoubleDouble b) {
  a_[0] = a;
  b_[0] = b;
  // The distance is squared by every step: below 2^-53 the next mean is exact.
  for (bool exact = false; !exact && last_ + 1 < kMost; ++last_) {
    exact = std::abs(a.hi - b.hi) <= 0x1p-52 * a.hi;
    const DoubleDouble mean = ldexp(a + b, -1);
    // sqrt(a) sqrt(b) where a b would lose its low part or overflow.
    const bool extreme = !(b.hi > 1e-100 && a.hi < 1e100);
    b = extreme ? sqrt(a) * sqrt(b) : sqrt(a * b);
    a = mean;
    a_[last_ + 1] = a;
    b_[last_ + 1] = b;
  }
}

DoubleDouble AgmSteps::gap_sum() const {
  // c_1/c_0 = c_0/(4 a_1): no difference of nearly equal numbers; then c_{n+1} = c_n^2/(4 a_{n+1}).
  const DoubleDouble c0_squared = (a_[0] - b_[0]) * (a_[0] + b_[0]);
  DoubleDouble ratio = sqrt(c0_squared) / (DoubleDouble(4.0) * a_[1]);  // c_n/c_0
  DoubleDouble gap = ldexp(a_[0] - b_[0], -1);                          // c_n
  DoubleDouble sum;
  double weight = 1.0;
  for (std::size_t n = 1; n < last_; ++n, weight *= 2.0) {
    sum = sum + DoubleDouble(weight) * ratio * ratio;
    ratio = ratio * gap / (DoubleDouble(4.0) * a_[n + 1]);
    gap = gap * gap / (DoubleDouble(4.0) * a_[n + 1]);
  }
  return sum;
}

DoubleDouble AgmSteps::turns_of(DoubleDouble cotangent) const {
  DoubleDouble y = cotangent;  // a_n cot(psi_n)/a_0
  double half_turns = 0.0;     // whole multiples of pi in psi_n, doubled by each step
  if (std::isinf(y.hi)) return {};
  for (std::size_t n = 0; n < last_; ++n) {
    // psi_n an odd multiple of pi/2 is that multiple of K at every step.
    if (y.hi == 0.0) return std::ldexp(half_turns + 0.5, -static_cast<int>(n) - 1);
    half_turns = 2.0 * half_turns + (y.hi < 0.0 ? 1.0 : 0.0);
    y = ldexp(y - b_[n + 1] / (y / b_[n + 1]), -1);
  }
  const DoubleDouble psi = atan2(a_[last_], y) / kPi + DoubleDouble(half_turns);
  return ldexp(psi, -static_cast<int>(last_) - 1);
}

AgmSteps::Amplitude AgmSteps::amplitude(DoubleDouble turns) const {
  const SinCos s = sin_cos_of_turns(turns);
  constexpr double kLinear = 1e-60;  // sn u = u, with an error of u^3
  if (std::abs(s.sine.hi) < kLinear) {
    const double sign = s.cosine.hi < 0.0 ? -1.0 : 1.0;
    return {s.sine / mean(), DoubleDouble(sign), DoubleDouble(1.0)};
  }
  DoubleDouble square = s.cosine / s.sine;   // becomes a_n cot^2
  DoubleDouble cotangent = mean() * square;  // a_0 cot(psi_n)
  DoubleDouble dn = 1.0;
  for (std::size_t n = last_; n-- > 0;) {
    square = square * cotangent;
    cotangent = cotangent * dn;
    dn = (b_[n] + square) / (a_[n] + square);
    square = cotangent / a_[n];
  }
  DoubleDouble sn = DoubleDouble(1.0) / hypot(DoubleDouble(1.0), cotangent);
  if (s.sine.hi < 0.0) sn = -sn;
  return {sn, cotangent * sn, dn};
}

}  // namespace strutt
