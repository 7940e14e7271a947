#include "strutt/floquet/tongue_edges.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"
#include "floquet/fourier_excitation.hpp"
#include "floquet/hill_matrix.hpp"
#include "floquet/square_wave.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

constexpr double kLargestSquareWave = 1e6;

/// Eigenvalue `index` of a matrix, whose square of the frequency is known: |eigenvalue - square| <= norm of
/// V.
class Edge {
 public:
  Edge(const HillMatrix& matrix, int index, double square)
      : matrix_(matrix), index_(index), low_(square - matrix.norm()), high_(square + matrix.norm()) {
    search(square);
    enclose();
  }

  /// `change`: a bound of the norm of what V may lack.
  CharacteristicValue value(double change) const { return {x_, (error_ + change) * (1.0 + 8.0 * kUnit)}; }

 private:
  /// The secant method on eigenvalue mu of the Schur complement, whose slope is -1 minus the share of the
  /// solution outside the core.
  void search(double x) {
    double smallest = HUGE_VAL, slope = -1.0;
    for (int step = 0; step < 30; ++step) {
      const CoreEigenvalues core = core_eigenvalues(matrix_, x, high_);
      const double mu = core.values[index_];
      if (step > 0) slope = std::min(-1.0, (mu - smallest) / (x - x_));
      if (std::abs(mu) >= std::abs(smallest)) return;
      smallest = mu;
      x_ = x;
      error_ = std::abs(mu) + core.error;
      size_ = core.size;
      x = std::clamp(x_ - mu / slope, low_, high_);
      if (std::abs(mu) <= kUnit * std::abs(x_) || x == x_) return;
    }
  }

  /// Counts on both sides prove what the search has found, mostly with a smaller bound.
  void enclose() {
    for (double h = 2.0 * kUnit * size_; h < error_; h *= 4.0) {
      const CoreCount low = core_count(matrix_, x_ - h, high_ + h),
                      high = core_count(matrix_, x_ + h, high_ + h);
      if (low.below > index_ || high.below <= index_) continue;
      error_ = std::min(error_, h + std::max(low.error, high.error));
      return;
    }
  }

  HillMatrix matrix_;
  int index_;
  double low_, high_;
  double x_ = 0.0, error_ = HUGE_VAL, size_ = 0.0;
};

CharacteristicValue eigenvalue(const HillMatrix& matrix, int index, double square, double change) {
  return Edge(matrix, index, square).value(change);
}

double half_square(int order) { return 0.25 * order * order; }

/// Even V: cosines and sines are apart, and each edge of tongue n has the index n/2 in its own matrix.
TongueEdges even_tongue(const FourierExcitation& v, int order) {
  const double exponent = order % 2 == 0 ? 0.0 : 0.5, square = half_square(order);
  const auto cosine = eigenvalue(v.matrix(HillBasis::cosine, exponent), order / 2, square, v.change);
  if (order == 0) return {order, std::nullopt, cosine};
  const auto sine = eigenvalue(v.matrix(HillBasis::sine, exponent), (order - 1) / 2, square, v.change);
  if (cosine.value < sine.value) return {order, cosine, sine};
  return {order, sine, cosine};
}

TongueEdges tongue(const FourierExcitation& v, int order) {
  const HillMatrix matrix = v.matrix(HillBasis::bloch, order % 2 == 0 ? 0.0 : 0.5);
  const double square = half_square(order);
  const auto upper = eigenvalue(matrix, order, square, v.change);
  if (order == 0) return {order, std::nullopt, upper};
  return {order, eigenvalue(matrix, order - 1, square, v.change), upper};
}

}  // namespace

std::vector<TongueEdges> tongue_edges(const PeriodicFunction& coefficient, int first, int last) {
  const DefaultFloatingPoint environment;
  require(first >= 0 && first <= kLargestTongue, "first", first, "0 to 1000");
  require(last >= first && last <= kLargestTongue, "last", last, "first to 1000");
  std::vector<TongueEdges> edges;
  if (is_square_wave(coefficient)) {
    const double amplitude = coefficient.deviation();
    require(amplitude <= kLargestSquareWave, "amplitude of the square wave", amplitude, "at most 1e6");
    for (int order = first; order <= last; ++order) edges.push_back(square_wave_tongue(amplitude, order));
    return edges;
  }
  const FourierExcitation v(coefficient);
  for (int order = first; order <= last; ++order)
    edges.push_back(v.even ? even_tongue(v, order) : tongue(v, order));
  return edges;
}

CharacteristicValue mean_of_winding(const PeriodicFunction& coefficient, double winding) {
  const DefaultFloatingPoint environment;
  require(winding > 0.0 && winding < 0.5 * kLargestTongue, "winding", winding, "above 0, below 500");
  require(2.0 * winding != std::floor(2.0 * winding), "winding", winding, "between two multiples of 1/2");
  const FourierExcitation v(coefficient);
  const HillMatrix matrix = v.matrix(HillBasis::bloch, winding - std::floor(winding));
  return eigenvalue(matrix, static_cast<int>(2.0 * winding), winding * winding, v.change);
}

}  // namespace strutt
