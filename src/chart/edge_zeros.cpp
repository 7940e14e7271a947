#include "chart/edge_zeros.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/bracketed_zero.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr int kMostEdgePieces = 200'000;

class ZeroSearch {
 public:
  ZeroSearch(EdgeFunction& function, bool upper, const TongueLine& line, double resolution,
             const std::atomic<bool>* cancel)
      : function_(function), upper_(upper), resolution_(resolution * (line.to - line.from)), cancel_(cancel) {
    const double from = value(line.from) == 0.0 ? clear_of(line.from, line.to) : line.from;
    const double to = value(line.to) == 0.0 ? clear_of(line.to, line.from) : line.to;
    if (from > line.from) add(line.from, value(from) > 0.0);
    if (!(from < to)) return;
    search(from, to);
    if (to < line.to) add(line.to, value(to) < 0.0);
    merge();
  }

  std::vector<EdgeZero> zeros;

 private:
  /// Of zeros between which F is nowhere more than its errors the outer two stay or, of an odd number, one.
  void merge() {
    const auto apart = [&](const EdgeZero& a, const EdgeZero& b) {
      const double middle = std::midpoint(a.position, b.position);
      return std::abs(value(middle)) > 2.0 * function_.at(middle).error(upper_);
    };
    std::vector<EdgeZero> merged;
    for (auto first = zeros.begin(); first != zeros.end();) {
      auto end = std::adjacent_find(first, zeros.end(), apart);
      if (end != zeros.end()) ++end;
      const auto count = end - first;
      merged.push_back(count % 2 == 0 ? *first : first[count / 2]);
      if (count % 2 == 0) merged.push_back(end[-1]);
      first = end;
    }
    zeros = std::move(merged);
  }

  double value(double p) { return function_.at(p).below(upper_); }
  void add(double position, bool rising) { zeros.push_back({upper_, rising, position}); }

  /// From a zero towards `end`, to where F is again more than its error, with this sign unless that is 0;
  /// `end` if it never is.
  double clear_of(double zero, double end, double sign = 0.0) {
    const double least = std::max(resolution_, std::abs(std::nextafter(zero, end) - zero));
    for (double step = least; step < std::abs(end - zero); step *= 2.0) {
      const double p = zero + std::copysign(step, end - zero);
      if (value(p) * sign >= 0.0 && std::abs(value(p)) > 2.0 * function_.at(p).error(upper_)) return p;
    }
    return end;
  }

  /// |F(a)| + |F(b)| is more than F can change on the way to zero and back.
  bool empty(double a, double b) {
    const auto &low = function_.at(a), &high = function_.at(b);
    const double change = change_between(low.point, high.point);
    return change == 0.0 || std::abs(low.below(upper_)) + std::abs(high.below(upper_)) >
                                change * (1.0 + 1e-12) + low.error(upper_) + high.error(upper_);
  }

  /// F changes by less than its errors: no pair of zeros can be told from none.
  bool indistinct(double a, double b) {
    const auto &low = function_.at(a), &high = function_.at(b);
    return change_between(low.point, high.point) <= low.error(upper_) + high.error(upper_);
  }

  /// F is too straight to reach zero between two values of the same sign. It comes close to zero where a line
  /// passes the tip of a tongue, where its value is that of a square.
  bool straight(double a, double b) {
    const auto &low = function_.at(a), &high = function_.at(b);
    const auto bend = function_.bend(low, high, upper_);
    const double least = std::min(std::abs(low.below(upper_)), std::abs(high.below(upper_)));
    return bend && least > *bend * (1.0 + 1e-9) + low.error(upper_) + high.error(upper_);
  }

  void search(double a, double b) {
    if (++pieces_ > kMostEdgePieces)
      throw NumericalFailure("tongue " + std::to_string(function_.order()) +
                             ": no proof that all crossings are found");
    if (!(a < b) || (cancel_ != nullptr && *cancel_)) return;
    const double at_a = value(a), at_b = value(b);
    if ((at_a < 0.0) != (at_b < 0.0)) {
      const double position = solve(a, b);
      search(a, clear_of(position, a, at_a));
      add(position, at_b > at_a);
      search(clear_of(position, b, at_b), b);
      return;
    }
    if (b - a <= resolution_ || empty(a, b) || indistinct(a, b) || straight(a, b)) return;
    const double middle = std::midpoint(a, b);
    search(a, middle);
    search(middle, b);
  }

  double solve(double a, double b) {
    const auto [low, high] =
        bracketed_zero([this](double p) { return value(p); }, a, b, value(a), value(b), are_neighbours, 200);
    return std::abs(value(low)) < std::abs(value(high)) ? low : high;
  }

  EdgeFunction& function_;
  bool upper_;
  double resolution_;
  const std::atomic<bool>* cancel_;
  int pieces_ = 0;
};

}  // namespace

std::vector<EdgeZero> edge_zeros(EdgeFunction& function, bool upper, const TongueLine& line,
                                 double resolution, const std::atomic<bool>* cancel) {
  return ZeroSearch(function, upper, line, resolution, cancel).zeros;
}

}  // namespace strutt
