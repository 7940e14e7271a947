#include "chart/chebyshev.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace strutt::chebyshev {

using std::numbers::pi;

double point(int j, int n) {
  return std::sin(pi * (n - 2 * j) / (2.0 * n));  // symmetric to the bit, and 0 in the middle
}

double point(int j, int n, double low, double high) {
  return 0.5 * (low + high) + 0.5 * (high - low) * point(j, n);
}

Eigen::MatrixXd transform(int n) {
  Eigen::MatrixXd result(n + 1, n + 1);
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      const double ends = (k == 0 || k == n ? 0.5 : 1.0) * (j == 0 || j == n ? 0.5 : 1.0);
      const long phase = static_cast<long>(k) * j % (2L * n);  // keeps the argument small
      result(k, j) = ends * 2.0 / n * std::cos(pi * static_cast<double>(phase) / n);
    }
  }
  return result;
}

void polynomials(std::span<const double> t, int degree, Eigen::MatrixXd& result) {
  const auto points = static_cast<Eigen::Index>(t.size());
  const Eigen::Map<const Eigen::ArrayXd> argument(t.data(), points);
  result.resize(points, degree + 1);
  result.col(0).setOnes();
  if (degree >= 1) result.col(1) = argument.matrix();
  for (int k = 2; k <= degree; ++k) {
    result.col(k) = (2.0 * argument * result.col(k - 1).array() - result.col(k - 2).array()).matrix();
  }
}

Eigen::MatrixXd restriction(int n, double low, double high) {
  std::vector<double> t;
  for (int j = 0; j <= n; ++j) t.push_back(point(j, n, low, high));
  Eigen::MatrixXd there;
  polynomials(t, n, there);
  return transform(n) * there;
}

}  // namespace strutt::chebyshev
