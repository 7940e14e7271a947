#include "strutt/floquet/characteristic_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "floquet/sturm_count.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

enum class Parity { even, odd };

/// Below this q the terms that change n^2 are less than its rounding.
constexpr double kSmallestCoupling = 0x1p-60;

MathieuMatrix matrix_of(Parity parity, int order, double q) {
  if (order % 2 != 0) return {.lowest = 1, .corner = parity == Parity::even ? q : -q, .q = q};
  if (parity == Parity::odd) return {.lowest = 2, .q = q};
  return {.lowest = 0, .first_coupling = 2.0, .q = q};
}

/// The eigenvalue of one order between two bounds.
struct Bracket {
  int index;  ///< how many eigenvalues of the matrix lie below it
  double low, high;

  /// 2 q cos 2t has the norm 2 q, so that the value is that close to n^2, and above -2 q.
  Bracket(int order, const MathieuMatrix& matrix) : index((order - matrix.lowest) / 2) {
    const double square = static_cast<double>(order) * order;
    low = std::max(-2.0 * matrix.q, std::nextafter(square - 2.0 * matrix.q, -HUGE_VAL));
    high = std::nextafter(square + 2.0 * matrix.q, HUGE_VAL);
  }

  double middle() const { return low + 0.5 * (high - low); }
  /// Nothing is won by bisection below a tenth of the perturbation, nor between neighbours.
  bool narrow(double q) const {
    const double x = middle();
    return high - low <= 0x1p-55 * (std::abs(x) + 2.0 * q) || x <= low || x >= high;
  }
  void cut(double x, std::int64_t below) { (below <= index ? low : high) = x; }

  CharacteristicValue value(double perturbation) const {
    const double x = middle();
    // the differences and the sum round; a few of their last bits cover it
    return {x, (std::max(high - x, x - low) + perturbation) * (1.0 + 0x1p-50)};
  }
};

/// The characteristic values of orders first, first + 2, ... of one parity, q > 0.
class ParityClass {
 public:
  ParityClass(Parity parity, int first, int last, double q)
      : matrix_(matrix_of(parity, first, q)), first_(first) {
    if (q < kSmallestCoupling) {
      for (int n = first; n <= last; n += 2) values_.push_back(nearly_free(n, q));
      return;
    }
    std::vector<Bracket> brackets;
    for (int n = first; n <= last; n += 2) brackets.emplace_back(n, matrix_);
    for (std::size_t k = 0; k < brackets.size(); k += kSturmLanes)
      bisect(brackets.data() + k, std::min(kSturmLanes, brackets.size() - k));
    const double perturbation = matrix_.perturbation();
    for (const Bracket& bracket : brackets) values_.push_back(bracket.value(perturbation));
  }

  CharacteristicValue of(int order) const { return values_[static_cast<std::size_t>(order - first_) / 2]; }

 private:
  /// a_0 = -q^2/2 + 7 q^4/128 - ...; all others lie within 2 q of n^2.
  static CharacteristicValue nearly_free(int order, double q) {
    if (q == 0.0 || order > 0) return {static_cast<double>(order) * order, 2.0 * q};
    return {-0.5 * q * q + 0.0, 0x1p-52 * q * q + std::numeric_limits<double>::denorm_min()};
  }

  void bisect(Bracket* brackets, std::size_t count) const {
    for (;;) {
      bool narrow = true;
      SturmPoints points;
      for (std::size_t k = 0; k < kSturmLanes; ++k) {
        points[k] = brackets[std::min(k, count - 1)].middle();
        narrow = narrow && brackets[std::min(k, count - 1)].narrow(matrix_.q);
      }
      if (narrow) return;
      const SturmCounts below = sturm_counts(matrix_, points);
      for (std::size_t k = 0; k < count; ++k)
        if (!brackets[k].narrow(matrix_.q)) brackets[k].cut(points[k], below[k]);
    }
  }

  MathieuMatrix matrix_;
  int first_;
  std::vector<CharacteristicValue> values_;
};

/// The values of one parity for all orders from first to last.
class ParityPair {
 public:
  ParityPair(Parity parity, int first, int last, double q)
      : classes_{ParityClass(parity, first, last, q), ParityClass(parity, first + 1, last, q)},
        first_(first) {}

  CharacteristicValue of(int order) const { return classes_[(order - first_) % 2].of(order); }

 private:
  ParityClass classes_[2];
  int first_;
};

void validate(int first, int last, double q) {
  require(first >= 0 && first <= kLargestCharacteristicOrder, "first", first, "0 to 10000");
  require(last >= first && last <= kLargestCharacteristicOrder, "last", last, "first to 10000");
  require(std::abs(q) <= kLargestCharacteristicParameter, "q", q, "-1e8 to 1e8");
}

}  // namespace

std::vector<CharacteristicPair> characteristic_values(int first, int last, double q) {
  validate(first, last, q);
  const ParityPair even(Parity::even, first, last, std::abs(q));
  const ParityPair odd(Parity::odd, std::max(first, 1), last, std::abs(q));
  std::vector<CharacteristicPair> pairs;
  for (int n = first; n <= last; ++n) {
    CharacteristicPair pair{n, even.of(n), std::nullopt};
    if (n > 0) pair.b = odd.of(n);
    // a shift of t by pi/2 changes the sign of q, and the parity of what has antiperiod pi
    if (q < 0.0 && n % 2 != 0) std::swap(pair.a, *pair.b);
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace strutt
