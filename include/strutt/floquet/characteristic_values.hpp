#pragma once

#include <optional>
#include <vector>

namespace strutt {

/// The orders and parameters of Mathieu's equation for which characteristic values are computed.
inline constexpr int kLargestCharacteristicOrder = 10'000;
inline constexpr double kLargestCharacteristicParameter = 1e8;

/// A real number with a proved bound of its error, |value - true| <= error.
struct CharacteristicValue {
  double value = 0.0;
  double error = 0.0;
};

/// a_n(q) and b_n(q); there is no b_0.
struct CharacteristicPair {
  int order = 0;
  CharacteristicValue a;
  std::optional<CharacteristicValue> b;
};

/// The characteristic values of Mathieu's equation x'' + (a - 2 q cos 2t) x = 0 for the orders first <= n <=
/// last: the values of a for which it has a solution of period pi (n even) or antiperiod pi (n odd), even
/// (a_n) or odd (b_n) in t. They are the edges of the tongues; for q > 0: a_0 < b_1 < a_1 < b_2 < ... For q <
/// 0 the letters of odd orders change places: a_2k+1(-q) = b_2k+1(q), a_2k(-q) = a_2k(q), b_2k(-q) = b_2k(q)
/// (DLMF 28.2.26-28.2.28).
///
/// The Fourier coefficients of the solutions of one parity obey a three-term recurrence: a symmetric
/// tridiagonal matrix with the squares of the frequencies on its diagonal and q beside it. The number of its
/// eigenvalues below x is that of the negative pivots of its elimination (Sturm's count); bisection on it
/// gives each value its index, whatever the others do. The matrix is not truncated: the count ends where the
/// pivots that follow are proved to be positive.
///
/// `error` bounds rounding and bracket: at most 4 x 2^-52 x (|a| + 2 |q|), on the whole range. A value
/// depends on n and q only, not on the other orders asked for. Cost: a few microseconds for n = 10, q = 1e5;
/// it grows with sqrt(n^2 + |q|). Throws InvalidInput unless 0 <= first <= last <= 1e4 and |q| <= 1e8.
std::vector<CharacteristicPair> characteristic_values(int first, int last, double q);

}  // namespace strutt
