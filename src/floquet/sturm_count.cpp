#include "floquet/sturm_count.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/constants.hpp"

namespace strutt {
namespace {

// Two lanes fill a register of every 64-bit processor. The pairs are independent of each other, so that their
// divisions overlap.
using TwoDoubles [[gnu::vector_size(16)]] = double;
using PairCount [[gnu::vector_size(16)]] = std::int64_t;
constexpr std::size_t kPairs = kSturmLanes / 2;

constexpr double kMargin = 1e-12;  // far above the roundings of one row, far below what costs rows

/// The pivots of one row, and the numbers of negative ones so far.
struct Elimination {
  std::array<TwoDoubles, kPairs> point, pivot;
  std::array<PairCount, kPairs> negative{};

  explicit Elimination(const SturmPoints& points) {
    std::memcpy(point.data(), points.data(), sizeof(points));
  }

  void begin(double diagonal) {
    for (std::size_t k = 0; k < kPairs; ++k) pivot[k] = diagonal - point[k];
    count();
  }
  /// A pivot 0 stands for a positive one that is tiny: the next is -inf, the one after it has no trace of
  /// both.
  void step(double diagonal, double coupling) {
    for (std::size_t k = 0; k < kPairs; ++k) pivot[k] = (diagonal - point[k]) - coupling / pivot[k];
    count();
  }
  bool all_at_least(double bound) const {
    PairCount below{};
    for (std::size_t k = 0; k < kPairs; ++k) below |= pivot[k] < bound;
    return (below[0] | below[1]) == 0;
  }

 private:
  void count() {
    for (std::size_t k = 0; k < kPairs; ++k) negative[k] -= pivot[k] < 0.0;
  }
};

/// Pivots p and the sum of p'/p, the logarithmic derivative of the determinant by the point.
struct Derivation {
  std::array<TwoDoubles, kPairs> point, inverse, share, sum{};  // 1/p, p'/p and its sum
  std::array<TwoDoubles, kPairs> fall;  // what the eigenvector has fallen by in the tail
  std::array<PairCount, kPairs> negative{}, active;

  Derivation(const SturmPoints& points, double diagonal) {
    std::memcpy(point.data(), points.data(), sizeof(points));
    for (std::size_t k = 0; k < kPairs; ++k) {
      fall[k] = TwoDoubles{1.0, 1.0};
      active[k] = PairCount{-1, -1};
      add(k, diagonal - point[k], TwoDoubles{-1.0, -1.0});
    }
  }
  void step(double diagonal, double coupling) {
    for (std::size_t k = 0; k < kPairs; ++k) advance(k, diagonal, coupling);
  }
  /// A row of the tail. From where the diagonal is 2 q above the point on, the eigenvector falls by (d - x -
  /// q)/q or more; the eigenvalue feels the square of what is cut off. Returns whether any lane needs a
  /// further row.
  bool tail_step(double diagonal, double coupling, double q) {
    PairCount any{};
    for (std::size_t k = 0; k < kPairs; ++k) {
      const TwoDoubles sum_before = sum[k], above = diagonal - point[k];
      const PairCount negative_before = negative[k];
      advance(k, diagonal, coupling);
      sum[k] = active[k] ? sum[k] : sum_before;
      negative[k] = active[k] ? negative[k] : negative_before;
      fall[k] = above >= 2.0 * q ? fall[k] * ((above - q) * (1.0 / q)) : fall[k];
      active[k] &= fall[k] < 0x1p26;
      any |= active[k];
    }
    return (any[0] | any[1]) != 0;
  }

 private:
  void advance(std::size_t k, double diagonal, double coupling) {
    const TwoDoubles ratio = coupling * inverse[k];
    add(k, (diagonal - point[k]) - ratio, ratio * share[k] - 1.0);
  }
  void add(std::size_t k, TwoDoubles pivot, TwoDoubles derivative) {
    negative[k] -= pivot < 0.0;
    inverse[k] = 1.0 / pivot;
    share[k] = derivative * inverse[k];
    sum[k] += share[k];
  }
};

}  // namespace

double MathieuMatrix::perturbation() const {
  // Five roundings per row, of q^2, the quotient, two differences and the difference before, go into its
  // coupling (Kahan 1966): 2.5 roundings in each of the entries, which together have the norm 2 q. Then 1 +
  // corner.
  const double low = static_cast<double>(lowest * lowest);
  const double sum = low + corner, part = sum - low;
  const double corner_error = (low - (sum - part)) + (corner - part);
  return 5.0 * (1.0 + kMargin) * kUnit * q + std::abs(corner_error);
}

SturmCounts sturm_counts(const MathieuMatrix& matrix, const SturmPoints& points) {
  const double largest = *std::max_element(points.begin(), points.end());
  const double q = matrix.q, coupling = q * q;
  // Where the diagonal is 2 q above the point from now on and a pivot is q or more, so are all that follow:
  // p' = (d - x) - q^2/p >= 2 q - q. Then no further eigenvalue lies below the point.
  const double tail = largest + 2.0 * q * (1.0 + kMargin) + 8.0 * kUnit * std::abs(largest);
  const double safe = q * (1.0 + kMargin);

  // The elimination works on a copy of its own, which the compiler keeps in registers.
  Elimination rows(points);
  double frequency = matrix.lowest;
  rows.begin(frequency * frequency + matrix.corner);
  frequency += 2.0;
  rows.step(frequency * frequency, matrix.first_coupling * coupling);
  for (frequency += 2.0; frequency * frequency < tail; frequency += 2.0)
    rows.step(frequency * frequency, coupling);
  while (!rows.all_at_least(safe)) {
    for (int k = 0; k < 4; ++k, frequency += 2.0) rows.step(frequency * frequency, coupling);
  }
  SturmCounts counts;
  std::memcpy(counts.data(), rows.negative.data(), sizeof(counts));
  return counts;
}

NewtonSteps newton_steps(const MathieuMatrix& matrix, const SturmPoints& points) {
  const double smallest = *std::min_element(points.begin(), points.end());
  const double q = matrix.q, coupling = q * q;
  double frequency = matrix.lowest;
  Derivation rows(points, frequency * frequency + matrix.corner);
  frequency += 2.0;
  rows.step(frequency * frequency, matrix.first_coupling * coupling);
  for (frequency += 2.0; frequency * frequency < smallest + 2.0 * q; frequency += 2.0)
    rows.step(frequency * frequency, coupling);
  while (rows.tail_step(frequency * frequency, coupling, q)) frequency += 2.0;
  NewtonSteps result;
  std::memcpy(result.below.data(), rows.negative.data(), sizeof(result.below));
  std::memcpy(result.step.data(), rows.sum.data(), sizeof(result.step));
  for (double& step : result.step) step = -1.0 / step;
  return result;
}

}  // namespace strutt
