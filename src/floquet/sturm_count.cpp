#include "floquet/sturm_count.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace strutt {
namespace {

// Two lanes fill a register of every 64-bit processor. The pairs are independent of each other, so that their
// divisions overlap.
using Pair [[gnu::vector_size(16)]] = double;
using PairCount [[gnu::vector_size(16)]] = std::int64_t;
constexpr std::size_t kPairs = kSturmLanes / 2;

constexpr double kUnit = 0x1p-53;  // unit roundoff
constexpr double kMargin = 1e-12;  // far above the roundings of one row, far below what costs rows

/// The pivots of one row, and the numbers of negative ones so far.
struct Elimination {
  std::array<Pair, kPairs> point, pivot;
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

}  // namespace strutt
