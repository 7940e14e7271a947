#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "strutt/integrate/taylor_propagator.hpp"

namespace strutt {
namespace {

constexpr double kLargestHalfStep =
    2.0;  // radians: a solution that grows then loses one digit in a step, not more
constexpr double kLargestShareOfRadius = 0.3;  // of the best radius: the terms then fall at least that fast
constexpr double kFixedCost = 40.0;            // of a step, in products: the inverse and the bounds
constexpr double kLowestRate = 0.01;
constexpr double kRatioOfRadii = 1.25;  // coarse: any radius gives a bound
constexpr int kTaylorOrders = (kHighestTaylorOrder - kLowestTaylorOrder) / 2 + 1;

/// Largest absolute row sums of the parts of a periodic matrix.
class Sizes {
 public:
  explicit Sizes(const PeriodicMatrix& matrix) : mean_(size(matrix.mean)) {
    for (const auto& h : matrix.harmonics)
      waves_.push_back({static_cast<double>(h.order), size(h.cosine) + size(h.sine)});
  }
  /// Bound of the matrix at a distance r from the real axis.
  double at(double r) const {
    double sum = mean_;
    for (const auto& wave : waves_) sum += wave.size * std::cosh(wave.order * r);
    return sum;
  }

 private:
  static double size(const Eigen::MatrixXd& m) {
    return m.size() == 0 ? 0.0 : m.cwiseAbs().rowwise().sum().maxCoeff();
  }
  struct Wave {
    double order, size;
  };
  double mean_;
  std::vector<Wave> waves_;
};

/// Where G(R) - (p+1) ln R is smallest.
struct Radius {
  double least = std::numeric_limits<double>::infinity();
  double radius = 0.0;
};

/// For each order p.
std::array<Radius, kTaylorOrders> best_radii(const Sizes& stiffness, const Sizes& damping, double at_zero) {
  std::array<Radius, kTaylorOrders> result;
  const auto rate = [&](double r) {
    return std::max(std::sqrt(stiffness.at(r)) + damping.at(r), kLowestRate);
  };
  double radius = kHighestTaylorOrder / std::max(at_zero, kLowestRate), edge = rate(radius);
  while (radius * edge > 0.7 * kLowestTaylorOrder) {
    const double growth = radius / 6.0 * (at_zero + 4.0 * rate(0.5 * radius) + edge);  // Simpson's rule
    for (int i = 0; i < kTaylorOrders; ++i) {
      auto& best = result[static_cast<std::size_t>(i)];
      const double value = growth - (kLowestTaylorOrder + 2 * i + 1) * std::log(radius);
      if (value < best.least) best = {value, radius};
    }
    radius /= kRatioOfRadii;
    edge = rate(radius);
  }
  return result;
}

}  // namespace

TaylorStepPlan plan_taylor_steps(const TaylorEquation& equation, int half_periods, double tolerance) {
  const Sizes stiffness(equation.stiffness), damping(equation.damping);
  const double length = half_periods * std::numbers::pi;
  const double rate = std::sqrt(stiffness.at(0.0)) + damping.at(0.0);
  if (!(rate * length <= 4.0 * kLargestHalfStep * kMostTaylorSteps)) return {};
  const auto radii = best_radii(stiffness, damping, rate);
  TaylorStepPlan best;
  double lowest_cost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTaylorOrders; ++i) {
    const int order = kLowestTaylorOrder + 2 * i;
    const auto [least, radius] = radii[static_cast<std::size_t>(i)];
    // safety n e^least (length/2n)^(p+1)/sqrt(2 pi (p+1)) = tolerance
    const double excess = std::log(kTaylorTruncationSafety / tolerance) + least +
                          (order + 1) * std::log(0.5 * length) -
                          0.5 * std::log(2.0 * std::numbers::pi * (order + 1));
    const double steps =
        std::ceil(std::max({1.0, std::exp(excess / order), 0.5 * rate * length / kLargestHalfStep,
                            0.5 * length / (kLargestShareOfRadius * radius)}));
    const double products = 0.5 * order * (order + 1) * (equation.damping.mean.size() > 0 ? 2.0 : 1.0);
    const double cost = steps * (products + kFixedCost);
    if (!(steps <= kMostTaylorSteps && cost < lowest_cost)) continue;
    lowest_cost = cost;
    const double share = 0.5 * length / (steps * radius);
    best = {order, static_cast<int>(steps), share * share};
  }
  return best;
}

}  // namespace strutt
