#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

/// Elementary functions without branches or tables, for loops that the compiler vectorises.
namespace strutt::vector_math {

/// The nearest whole number, for |x| < 2^51.
[[gnu::always_inline]] inline double nearest(double x) {
  constexpr double kShift = 0x1.8p52;
  return (x + kShift) - kShift;
}

/// ln(1 + x) for 0 <= x < 1e300, to 2 units in the last place. The logarithm is that of fdlibm (Sun
/// Microsystems, 1993): ln m = 2 artanh(f/(2 + f)), f = m - 1, as a polynomial; what 1 + x rounds off is
/// added.
[[gnu::always_inline]] inline double log1p(double x) {
  const double u = 1.0 + x;
  const double lost = (x > 1.0 ? 1.0 - (u - x) : x - (u - 1.0)) / u;
  const auto bits = std::bit_cast<std::uint64_t>(u);
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcdULL;  // bits of sqrt(1/2)
  const std::uint64_t shifted = bits - kRootHalf;             // exponent so that m is in [sqrt(1/2), sqrt(2))
  const std::uint64_t exponent_bits = shifted >> 52;
  const double k = std::bit_cast<double>(exponent_bits | 0x4330000000000000ULL) - 0x1p52;
  const double m = std::bit_cast<double>((shifted & 0x000fffffffffffffULL) + kRootHalf);
  const double f = m - 1.0, s = f / (2.0 + f), z = s * s, w = z * z;
  const double odd =
      w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double even =
      z * (6.666666666666735130e-01 +
           w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const double half_square = 0.5 * f * f;
  constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;
  return k * kLn2High - ((half_square - (s * (half_square + (odd + even)) + (k * kLn2Low + lost))) - f);
}

[[gnu::always_inline]] inline double asinh(double x) {
  const double size = std::abs(x), square = size * size;
  return std::copysign(log1p(size + square / (1.0 + std::sqrt(1.0 + square))), x);
}

/// atan(sqrt(a/b)) for a, b >= 0, not both 0, to about 2 units in the last place. The rational function is
/// that of Cephes (Moshier, Methods and Programs for Mathematical Functions, 1989), on [0, tan(pi/8)].
[[gnu::always_inline]] inline double atan_of_root(double a, double b) {
  constexpr double kQuarterPi = 0.78539816339744830962, kHalfPi = 1.57079632679489661923;
  const double t = std::sqrt((a > b ? b : a) / (a > b ? a : b));
  const bool reduced = t > 0.41421356237309503;
  const double x = reduced ? (t - 1.0) / (t + 1.0) : t, z = x * x;
  const double p = -6.485021904942025371773e1 +
                   z * (-1.228866684490136173410e2 +
                        z * (-7.500855792314704667340e1 +
                             z * (-1.615753718733365076637e1 + z * -8.750608600031904122785e-1)));
  const double q = 1.945506571482613964425e2 +
                   z * (4.853903996359136964868e2 +
                        z * (4.328810604912902668951e2 +
                             z * (1.650270098316988542046e2 + z * (2.485846490142306297962e1 + z))));
  const double small = x + x * z * (p / q), angle = reduced ? kQuarterPi + small : small;
  return a > b ? kHalfPi - angle : angle;
}

}  // namespace strutt::vector_math
