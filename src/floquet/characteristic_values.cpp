#include "strutt/floquet/characteristic_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "floquet/sturm_count.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

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
  double guess = HUGE_VAL;  ///< likely to be closer than the bracket is narrow

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
  void cut_inside(double x, std::int64_t below) {
    if (x > low && x < high) cut(x, below);
  }

  CharacteristicValue value(double perturbation) const {
    const double x = guess >= low && guess <= high ? guess : middle();
    // the differences and the sum round; a few of their last bits cover it
    return {x, (std::max(high - x, x - low) + perturbation) * (1.0 + 0x1p-50)};
  }
};

/// Looks for the eigenvalue of a bracket without bounds: by bisection until it is alone, then by Newton's
/// steps as long as they halve. It starts between the square and the well asymptotics, which hold for all
/// that was tried; if they fail the guess is bad and the value is still right.
class Search {
 public:
  Search(const Bracket& bracket, Parity parity, int order, double q)
      : index_(bracket.index), low_(bracket.low), high_(bracket.high) {
    // n^2 - 2 q < a < n^2 + 2 q, where the next square of the class is 4 n + 4 away
    double next = 4.0 * order + 4.0;
    if (const double root = std::sqrt(q); q >= 4.0 && order <= root) {
      // -2 q + 2 s sqrt(q) - (s^2 + 1)/8 - ..., the levels of a well of cos 2t (DLMF 28.8.1)
      const double s = parity == Parity::even ? 2.0 * order + 1.0 : 2.0 * order - 1.0;
      high_ = std::min(high_, -2.0 * q + 2.0 * s * root);
      low_ = std::max(low_, -2.0 * q + 2.0 * s * root - 0.25 * (s * s + 1.0));
      next = 8.0 * root;
    }
    point_ = middle();
    if (high_ - low_ < 0.5 * next) none_below_ = none_above_ = true;
    isolate();
  }

  double point() const { return point_; }
  bool found() const { return found_; }

  void advance(double step, std::int64_t below, double q) {
    if (found_) return;
    narrow(below);
    const double target = point_ + step, size = std::abs(step);
    const bool inside = alone_ && target > low_ && target < high_;
    // the error that is left is about step^2 over the distance of the next eigenvalue
    found_ = alone_ && size * size <= 0x1p-56 * (std::abs(point_) + 2.0 * q) * gap_;
    const bool newton = inside && 2.0 * size <= last_step_;
    point_ = newton || found_ ? target : middle();
    last_step_ = newton ? size : high_ - low_;
    found_ = found_ || point_ <= low_ || point_ >= high_;
  }

 private:
  double middle() const { return low_ + 0.5 * (high_ - low_); }
  void narrow(std::int64_t below) {
    if (below <= index_) {
      low_ = point_;
      none_below_ = none_below_ || below == index_;
    } else {
      high_ = point_;
      none_above_ = none_above_ || below == index_ + 1;
    }
    isolate();
  }
  void isolate() {
    if (alone_ || !none_below_ || !none_above_) return;
    alone_ = true;
    gap_ = high_ - low_;
  }

  int index_;
  double low_, high_, point_, gap_ = 0.0, last_step_ = HUGE_VAL;
  bool none_below_ = false, none_above_ = false, alone_ = false, found_ = false;
};

/// The characteristic values of orders first, first + 2, ... of one parity, q > 0.
class ParityClass {
 public:
  ParityClass(Parity parity, int first, int last, double q)
      : parity_(parity), matrix_(matrix_of(parity, first, q)), first_(first) {
    if (q < kSmallestCoupling) {
      for (int n = first; n <= last; n += 2) values_.push_back(nearly_free(n, q));
      return;
    }
    std::vector<Bracket> brackets;
    for (int n = first; n <= last; n += 2) brackets.emplace_back(n, matrix_);
    for (std::size_t k = 0; k < brackets.size(); k += kSturmLanes) {
      const std::size_t count = std::min(kSturmLanes, brackets.size() - k);
      enclose(brackets.data() + k, count, guesses(brackets.data() + k, count));
      bisect(brackets.data() + k, count);
    }
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

  SturmPoints guesses(const Bracket* brackets, std::size_t count) const {
    std::vector<Search> searches;
    for (std::size_t k = 0; k < kSturmLanes; ++k) {
      const Bracket& bracket = brackets[std::min(k, count - 1)];
      searches.emplace_back(bracket, parity_, matrix_.lowest + 2 * bracket.index, matrix_.q);
    }
    SturmPoints points;
    for (;;) {
      for (std::size_t k = 0; k < kSturmLanes; ++k) points[k] = searches[k].point();
      if (std::all_of(searches.begin(), searches.end(), [](const Search& s) { return s.found(); }))
        return points;
      const NewtonSteps newton = newton_steps(matrix_, points);
      for (std::size_t k = 0; k < kSturmLanes; ++k)
        searches[k].advance(newton.step[k], newton.below[k], matrix_.q);
    }
  }

  /// Counts on both sides of the guesses, further out where a guess was not good enough.
  void enclose(Bracket* brackets, std::size_t count, const SturmPoints& guess) const {
    for (std::size_t k = 0; k < count; ++k) brackets[k].guess = guess[k];
    for (double distance = 0x1p-54; distance < 0x1p-45; distance *= 4.0) {
      bool close = true;
      for (const double side : {-distance, distance}) {
        SturmPoints points;
        for (std::size_t k = 0; k < kSturmLanes; ++k)
          points[k] = guess[k] + side * (std::abs(guess[k]) + 2.0 * matrix_.q);
        const SturmCounts below = sturm_counts(matrix_, points);
        for (std::size_t k = 0; k < count; ++k) brackets[k].cut_inside(points[k], below[k]);
      }
      for (std::size_t k = 0; k < count; ++k)
        close = close &&
                brackets[k].high - brackets[k].low <= 4.0 * distance * (std::abs(guess[k]) + 2.0 * matrix_.q);
      if (close) return;
    }
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

  Parity parity_;
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
  const DefaultFloatingPoint environment;
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
