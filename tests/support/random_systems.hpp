#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "strutt/model/linear_system.hpp"

namespace strutt::test {

/// Systems of 1 to 5 degrees of freedom with up to three harmonics to order 8, period 2 pi: slow and fast,
/// weakly and strongly excited; by turns with symmetric matrices, with any, with constant and with periodic
/// damping.
class RandomSystems {
 public:
  explicit RandomSystems(unsigned seed) : random_(seed) {}

  LinearPeriodicSystem next() {
    const int kind = count_++ % 4, d = between(1, 5);
    const double size = power_of_ten(-1.2, 1.8), share = power_of_ten(-2.0, 1.0);
    const auto matrix = [&](double scale) { return kind == 0 ? symmetric(d, scale) : any(d, scale); };
    LinearPeriodicSystem system;
    system.mass = 2.0 * Eigen::MatrixXd::Identity(d, d) + 0.3 * matrix(1.0);
    system.stiffness.mean = matrix(size);
    if (between(0, 1) == 1) system.stiffness.mean.diagonal().array() += 2.0 * size;
    for (int k = 1, count = between(1, 3); k <= count; ++k) {
      const int order = k == count ? k + between(0, 1) * between(0, 5) : k;
      const auto sine = between(0, 1) == 1 ? matrix(size * share) : Eigen::MatrixXd();
      system.stiffness.harmonics.push_back({order, matrix(size * share), sine});
    }
    if (kind < 2) return system;
    const double damping = power_of_ten(-1.5, 0.5);
    system.damping.mean = any(d, damping);
    if (kind == 3) system.damping.harmonics = {{between(1, 3), any(d, damping), any(d, damping)}};
    return system;
  }

 private:
  int between(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  double power_of_ten(double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random_));
  }
  Eigen::MatrixXd any(int d, double scale) {
    std::uniform_real_distribution<double> entry(-scale, scale);
    return Eigen::MatrixXd::NullaryExpr(d, d, [&] { return entry(random_); });
  }
  Eigen::MatrixXd symmetric(int d, double scale) {
    const Eigen::MatrixXd half = any(d, 0.5 * scale);
    return half + half.transpose();
  }

  std::mt19937_64 random_;
  int count_ = 0;
};

}  // namespace strutt::test
