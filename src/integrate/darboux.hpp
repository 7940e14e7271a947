#pragma once

namespace strutt::detail {

/// Product over i < k of 2 (q - i)/(2 q - i): the weight of a_k in Darboux's relation of order 2 q between
/// nodes that are 2 apart.
constexpr double darboux_weight(int q, int k) {
  double result = 1.0;
  for (int i = 0; i < k; ++i) result *= 2.0 * (q - i) / (2.0 * q - i);
  return result;
}

/// What HillSeries's weights and the terms it leaves out take away from a solution in the middle of a step:
/// a_k keeps at least 1 - result k (k - 1) of its value and 1 - result (k - 1) (k - 2) of its slope.
constexpr double darboux_loss(int terms) {
  double result = 1.0 / ((terms - 1.0) * (terms - 2.0));
  for (int q = terms - 2; q < terms; ++q) {
    for (int k = 2; k <= q; ++k) {
      const double loss = (1.0 - darboux_weight(q, k)) / (k * (k - 1.0));
      result = loss > result ? loss : result;
    }
  }
  return result;
}

}  // namespace strutt::detail
