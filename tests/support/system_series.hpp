#pragma once

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "strutt/model/linear_system.hpp"

/// The truth for systems: one-sided Taylor series in long double.
namespace reference {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// M of a system for the state (q, q'/kappa), kappa = 2 pi/T, from `steps` series of degree 30; right to
/// about 1e-18 of its largest entry where a solution turns by less than 2 radians in a step.
inline LongMatrix system_matrix(const strutt::LinearPeriodicSystem& system, int steps) {
  constexpr int kDegree = 30;
  const long double pi = std::numbers::pi_v<long double>, h = 2 * pi / steps, unit = system.period / (2 * pi);
  const Eigen::Index d = system.mass.rows();
  const LongMatrix inverse = system.mass.cast<long double>().inverse();
  const auto coefficient = [&](const strutt::PeriodicMatrix& matrix, long double theta, int j) {
    LongMatrix sum = LongMatrix::Zero(d, d);
    if (j == 0 && matrix.mean.size() > 0) sum += matrix.mean.cast<long double>();
    for (const auto& w : matrix.harmonics) {
      const long double scale = std::pow(w.order * h, j) / std::tgamma(j + 1.0L);
      const long double angle =
          w.order * theta + j * pi / 2;  // the j-th derivative is a shift by j/4 of a turn
      if (w.cosine.size() > 0) sum += scale * std::cos(angle) * w.cosine.cast<long double>();
      if (w.sine.size() > 0) sum += scale * std::sin(angle) * w.sine.cast<long double>();
    }
    return LongMatrix(inverse * sum);
  };
  LongMatrix y = LongMatrix::Identity(2 * d, 2 * d);
  for (int step = 0; step < steps; ++step) {
    std::vector<LongMatrix> stiffness, damping, q{y.topRows(d)}, v{h * y.bottomRows(d)};
    for (int k = 0; k < kDegree; ++k) {
      stiffness.push_back(h * unit * h * unit * coefficient(system.stiffness, step * h, k));
      damping.push_back(h * unit * coefficient(system.damping, step * h, k));
      LongMatrix sum = LongMatrix::Zero(d, 2 * d);
      for (int j = 0; j <= k; ++j) {
        const auto i = static_cast<std::size_t>(j), rest = static_cast<std::size_t>(k - j);
        sum += stiffness[i] * q[rest] + damping[i] * v[rest];
      }
      q.push_back(v.back() / static_cast<long double>(k + 1));
      v.push_back(-sum / static_cast<long double>(k + 1));
    }
    y.setZero();
    for (std::size_t k = q.size(); k-- > 0;) {
      y.topRows(d) += q[k];
      y.bottomRows(d) += v[k] / h;
    }
  }
  return y;
}

}  // namespace reference
