#include "free_pendulum/rational_series.hpp"

#include <algorithm>

namespace strutt {

Series product(const Series& a, const Series& b) {
  Series c(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == 0) continue;
    for (std::size_t j = 0; j < b.size() && i + j < c.size(); ++j)
      if (b[j] != 0) c[i + j] += a[i] * b[j];
  }
  return c;
}

Series reciprocal(const Series& a) {
  Series b(a.size());
  b[0] = 1 / a[0];
  for (std::size_t n = 1; n < a.size(); ++n) {
    for (std::size_t i = 1; i <= n; ++i)
      if (a[i] != 0 && b[n - i] != 0) b[n] -= a[i] * b[n - i];
    b[n] *= b[0];
  }
  return b;
}

Series composition(const Series& outer, const Series& inner) {
  // Horner's rule. What stands at step n is still to be multiplied by the n-th power of `inner`: its last
  // coefficients would be cut off.
  std::size_t lowest = 1;
  while (lowest < inner.size() && inner[lowest] == 0) ++lowest;
  const std::size_t terms = std::min(outer.size(), (inner.size() - 1) / lowest + 1);
  Series sum;
  for (std::size_t n = terms; n-- > 0;) {
    sum.resize(inner.size() - n * lowest);
    sum = product(sum, inner);
    sum[0] += outer[n];
  }
  return sum;
}

Series power(const Series& a, const Exact& exponent) {
  // b a' exponent = b' a, coefficient by coefficient (J. C. P. Miller).
  Series b(a.size());
  b[0] = 1;
  for (std::size_t n = 1; n < a.size(); ++n) {
    for (std::size_t i = 1; i <= n; ++i)
      if (a[i] != 0 && b[n - i] != 0) b[n] += (i * (exponent + 1) - n) * a[i] * b[n - i];
    b[n] /= n;
  }
  return b;
}

Exact binomial_central(int n) {
  Exact value = 1;
  for (int i = 1; i <= n; ++i) {
    value *= 2 * i - 1;
    value /= 2 * i;
  }
  return value;
}

}  // namespace strutt
