#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/reference.hpp"

/// The problem all benchmarks of this folder solve: x'' + (delta + epsilon cos t) x = 0 over [0, 2 pi].
namespace benchmarks {

/// A monodromy matrix [m11, kappa m12; m21/kappa, m22], kappa = max(1, sqrt|delta|).
struct Matrix {
  double m11 = 0.0, m12 = 0.0, m21 = 0.0, m22 = 0.0;
};

struct Point {
  double delta, epsilon, kappa;
  Matrix exact;  // correctly rounded from 40 digits
};

/// 64 undamped points scattered over -1 <= delta <= 5, |epsilon| <= 6, from tests/reference/mathieu.csv.
inline std::vector<Point> mathieu_points() {
  std::vector<Point> points;
  for (const auto& row : reference::read("mathieu")) {
    if (row.text("family") != "scatter" || row.input("epsilon") == 0.0 || points.size() == 64) continue;
    const double delta = row.input("delta"), kappa = std::max(1.0, std::sqrt(std::abs(delta)));
    const auto entry = [&row](const char* name, double scale) {
      return static_cast<double>(reference::Real(row.result(name) * scale));
    };
    points.push_back(
        {delta,
         row.input("epsilon"),
         kappa,
         {entry("m11", 1.0), entry("m12", kappa), entry("m21", 1.0 / kappa), entry("m22", 1.0)}});
  }
  return points;
}

/// Error of the entries and of the trace, divided by max(1, largest |entry|).
inline double scaled_error(const Matrix& m, const Matrix& exact) {
  const double d11 = m.m11 - exact.m11, d22 = m.m22 - exact.m22;
  const double error = std::max({std::abs(d11), std::abs(m.m12 - exact.m12), std::abs(m.m21 - exact.m21),
                                 std::abs(d22), std::abs(d11 + d22)});
  const double size =
      std::max({1.0, std::abs(exact.m11), std::abs(exact.m12), std::abs(exact.m21), std::abs(exact.m22)});
  return error / size;
}

/// The matrix of a period from u1, kappa u2, u1'/kappa, u2' at its middle, since the coefficient is even.
inline Matrix period_from_half(double u1, double u2, double v1, double v2) {
  return {u1 * v2 + u2 * v1, 2.0 * u2 * v2, 2.0 * u1 * v1, u1 * v2 + u2 * v1};
}

}  // namespace benchmarks
