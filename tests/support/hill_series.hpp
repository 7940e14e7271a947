#pragma once

#include <array>
#include <cmath>

#include "strutt/model/periodic_function.hpp"

namespace reference {

/// Fundamental matrix [x1, x2; x1', x2'] of x'' + w(t) x = 0 over [0, 2 pi] to about 1e-17 for a Fourier
/// series w with sqrt|w| up to `steps`/3: the power series of x over equal steps, in long double.
inline std::array<std::array<long double, 2>, 2> hill_matrix(const strutt::PeriodicFunction& w,
                                                             int steps = 64) {
  constexpr int kTerms = 30;
  const long double h = 2.0L * std::acos(-1.0L) / steps;
  std::array<std::array<long double, 2>, 2> state{{{1.0L, 0.0L}, {0.0L, 1.0L}}};
  for (int step = 0; step < steps; ++step) {
    std::array<long double, kTerms> series{};  // of w(t + h s) in s
    series[0] = w.mean();
    for (const auto& harmonic : w.harmonics()) {
      const long double angle = harmonic.order * (step * h), c = std::cos(angle), s = std::sin(angle);
      const long double value = harmonic.cosine * c + harmonic.sine * s;
      const long double slope = harmonic.sine * c - harmonic.cosine * s;
      long double factor = 1.0L;  // (order h)^k / k!
      for (int k = 0; k < kTerms; factor *= harmonic.order * h / ++k) {
        series[k] += factor * (k % 4 < 2 ? 1.0L : -1.0L) * (k % 2 == 0 ? value : slope);
      }
    }
    for (int column = 0; column < 2; ++column) {
      std::array<long double, kTerms + 2> x{state[0][column], h * state[1][column]};
      for (int k = 0; k < kTerms; ++k) {  // (k + 2)(k + 1) x_{k+2} = -h^2 sum_j w_j x_{k-j}
        long double sum = 0.0L;
        for (int j = 0; j <= k; ++j) sum += series[j] * x[k - j];
        x[k + 2] = -h * h * sum / ((k + 2) * (k + 1));
      }
      state[0][column] = state[1][column] = 0.0L;
      for (int k = kTerms + 1; k >= 0; --k) {
        state[0][column] += x[k];
        state[1][column] += k * x[k] / h;
      }
    }
  }
  return state;
}

}  // namespace reference
