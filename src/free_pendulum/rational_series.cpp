#include "free_pendulum/rational_series.hpp"

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
    for (std::size_t i = 1; i <= n; ++i) b[n] -= a[i] * b[n - i];
    b[n] *= b[0];
  }
  return b;
}

Series square_root(const Series& a) {
  Series b(a.size());
  b[0] = 1;
  for (std::size_t n = 1; n < a.size(); ++n) {
    b[n] = a[n];
    for (std::size_t i = 1; i < n; ++i) b[n] -= b[i] * b[n - i];
    b[n] /= 2;
  }
  return b;
}

Series composition(const Series& outer, const Series& inner) {
  Series sum(inner.size());
  for (std::size_t n = std::min(outer.size(), inner.size()); n-- > 0;) {
    sum = product(sum, inner);
    sum[0] += outer[n];
  }
  return sum;
}

Series inverse(const Series& a) {
  // Lagrange: coefficient n of the inverse is 1/n times coefficient n - 1 of (x/a)^n.
  Series quotient(a.begin() + 1, a.end());
  quotient = reciprocal(quotient);
  Series b(a.size()), power = quotient;
  for (std::size_t n = 1; n < a.size(); ++n) {
    b[n] = power[n - 1] / n;
    power = product(power, quotient);
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
