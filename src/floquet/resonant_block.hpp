#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "floquet/ball.hpp"
#include "floquet/hill_matrix.hpp"

namespace strutt {

/// A number with its derivative.
template <typename Value>
struct Dual {
  Ball<Value> value, slope;

  Dual conjugate() const { return {value.conjugate(), slope.conjugate()}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  bool zero() const {
    return value.radius == 0 && slope.radius == 0 && value.size() == 0 && slope.size() == 0;
  }
};

template <typename Value>
Dual<Value> real_inverse(const Dual<Value>& x) {
  const Ball<Value> inverse = real_inverse(x.value);
  const Ball<Value> slope = Ball<Value>{} - x.slope * inverse * inverse;
  return {inverse, slope};
}

/// The infinite matrix of -X'' - V X - x on the two resonant modes exp(+- i order theta/2): its Schur
/// complement
///   [distance  coupling; conj(coupling)  distance],
/// all other modes eliminated. Both edges of the tongue satisfy distance = +- |coupling|; distance falls with
/// x, by 1 or more. Every number is a ball with its derivative by `Direction`.
template <typename Value>
struct ResonantBlock {
  Dual<Value> distance;  ///< real
  Dual<Value> coupling;
  bool finite() const {
    return distance.value.finite() && distance.slope.finite() && coupling.value.finite() &&
           coupling.slope.finite();
  }
};

/// What the derivative is taken by: the mean x, or the exponent nu of all frequencies k + nu (of which that
/// of the mode +order/2 is given).
enum class Direction { mean, exponent };

/// Gaussian elimination of the modes from left to right, without exchange of rows: pivots that may be 0 give
/// infinite radii. The modes beyond the last are positive definite; their Schur complement is enclosed by
/// what it can be at most.
template <typename Real, typename Value>
class ResonantElimination {
 public:
  ResonantElimination(const HillMatrix& matrix, int order, const Ball<Real>& x, Direction direction)
      : matrix_(matrix),
        order_(order),
        x_(x),
        direction_(direction),
        width_(matrix.width()),
        norm_((matrix.norm() + uncertainty(matrix)) * (1.0L + 1e-15L)) {
    last_ = last_mode();
    first_ = -last_ - order % 2;  // frequencies k + exponent: as far to the left as to the right
    plus_ = order / 2;
    minus_ = plus_ - order;
    fill();
  }

  ResonantBlock<Value> run() {
    for (int k = first_; k <= last_; ++k)
      if (!kept(k)) eliminate(k);
    return {block_[1][1], block_[0][1]};
  }

 private:
  using Entry = Dual<Value>;
  struct Row {
    std::vector<Entry> band;    ///< entries (k, k + d)
    std::array<Entry, 2> kept;  ///< entries (k, minus), (k, plus)
  };

  bool kept(int k) const { return k == minus_ || k == plus_; }
  Row& row(int k) { return rows_[static_cast<std::size_t>(k - first_)]; }
  long double gap(int k) const {
    const long double f = k + matrix_.exponent;
    return f * f - x_.middle.template convert_to<long double>() - x_.radius - norm_;
  }

  /// So far that what lies beyond is positive definite and its influence less than a rounding.
  int last_mode() const {
    int k = order_ / 2 + 1;
    const long double digits = -std::log(Ball<Real>::unit()) + 10;
    for (long double decay = 0; decay < digits; ++k) {
      const long double beyond = gap(k + 1);
      if (beyond > norm_) decay += 2 * std::log(beyond / norm_) / width_;
    }
    return k + width_;
  }

  static long double uncertainty(const HillMatrix& matrix) {
    long double sum = 0;
    for (const double error : matrix.errors) sum += 2.0L * error;
    return sum;
  }

  Entry constant(const std::complex<double>& z, double radius) const {
    Entry entry;
    entry.value.radius = radius;
    if constexpr (std::is_same_v<Value, Real>)
      entry.value.middle = Real(z.real());
    else
      entry.value.middle = Value(Real(z.real()), Real(z.imag()));
    return entry;
  }

  Entry diagonal(int k) const {
    const Real f = Real(k) + Real(matrix_.exponent);
    Entry entry;
    entry.value = widened<Value>(Ball<Real>{Real(f * f), 0} - x_);
    entry.slope.middle = Value(direction_ == Direction::mean ? Real(-1) : Real(2 * f));
    return entry;
  }

  void fill() {
    for (int k = first_; k <= last_; ++k) {
      rows_.push_back({std::vector<Entry>(static_cast<std::size_t>(width_) + 1), {}});
      if (kept(k)) continue;
      row(k).band[0] = diagonal(k);
      for (int d = 1; d <= width_; ++d)
        if (!kept(k + d) && k + d <= last_) row(k).band[static_cast<std::size_t>(d)] = off_diagonal(k, k + d);
      row(k).kept = {off_diagonal(k, minus_), off_diagonal(k, plus_)};
    }
    block_[0][0] = diagonal(minus_);
    block_[1][1] = diagonal(plus_);
    block_[0][1] = off_diagonal(minus_, plus_);
    enclose_tail(first_, 1, gap(-first_ + 1 - order_ % 2));
    enclose_tail(last_, -1, gap(last_ + 1));
  }

  /// Entry (i, j) of -V: the harmonic i - j.
  Entry off_diagonal(int i, int j) const {
    const int m = std::abs(i - j);
    if (m == 0 || m > width_) return {};
    const auto harmonic = matrix_.harmonics[static_cast<std::size_t>(m)];
    const double error = matrix_.errors.empty() ? 0.0 : matrix_.errors[static_cast<std::size_t>(m)];
    return constant(i > j ? -harmonic : -std::conj(harmonic), error);
  }

  /// The modes beyond an end, at least `beyond` above x, take a matrix between 0 and norm^2/beyond from the
  /// last ones.
  void enclose_tail(int end, int inwards, long double beyond) {
    const long double most = norm_ * norm_ / beyond * Ball<Value>::kUp;
    const long double f = std::abs(end) + 2.0L;
    const long double slope = most / beyond * (direction_ == Direction::mean ? 1.0L : 4.0L * f);
    for (int i = 0; i < width_; ++i) {
      for (int d = 0; d + i < width_; ++d) {
        const int low = inwards > 0 ? end + i : end - i - d;
        if (kept(low) || kept(low + d)) continue;  // never: the modes that are kept are further inside
        auto& entry = row(low).band[static_cast<std::size_t>(d)];
        entry.value.radius += most;
        entry.slope.radius += slope;
      }
    }
  }

  void eliminate(int k) {
    const Row pivot_row = row(k);
    const Entry inverse = real_inverse(pivot_row.band[0]);
    const int right = std::min(width_, last_ - k);
    for (int i = 1; i <= right; ++i) {
      const Entry& to_i = pivot_row.band[static_cast<std::size_t>(i)];
      if (kept(k + i) || to_i.zero()) continue;
      const Entry factor = to_i.conjugate() * inverse;
      for (int j = i; j <= right; ++j)
        if (!kept(k + j))
          subtract(row(k + i).band[static_cast<std::size_t>(j - i)], factor,
                   pivot_row.band[static_cast<std::size_t>(j)]);
      for (std::size_t p = 0; p < 2; ++p) subtract(row(k + i).kept[p], factor, pivot_row.kept[p]);
    }
    for (std::size_t p = 0; p < 2; ++p) {
      if (pivot_row.kept[p].zero()) continue;
      const Entry factor = pivot_row.kept[p].conjugate() * inverse;
      for (std::size_t r = p; r < 2; ++r) subtract(block_[p][r], factor, pivot_row.kept[r]);
    }
  }

  static void subtract(Entry& entry, const Entry& factor, const Entry& other) {
    if (!other.zero()) entry = entry - factor * other;
  }

  const HillMatrix& matrix_;
  int order_;
  Ball<Real> x_;
  Direction direction_;
  int width_;
  long double norm_;
  int first_ = 0, last_ = 0, minus_ = 0, plus_ = 0;
  std::vector<Row> rows_;
  std::array<std::array<Entry, 2>, 2> block_;
};

}  // namespace strutt
