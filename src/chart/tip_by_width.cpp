#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/constants.hpp"
#include "chart/closing_tip.hpp"
#include "strutt/floquet/tongue_width.hpp"

namespace strutt {
namespace {

constexpr double kThinShare =
    1e-3;                           // width over distance to the next tongue, below which its square is small
constexpr double kBehindIt = 32.0;  // of that square, in the growth: 7 in 272 trials, less than 1 in most

class ThinTongue {
 public:
  ThinTongue(LineEquation& equation, const TongueLine& line, const TongueEdge& low, const TongueEdge& high)
      : equation_(equation),
        line_(line),
        low_(low),
        high_(high),
        middle_(std::midpoint(low.position, high.position)) {}

  std::optional<ClosingDamping> tip(DampedLine& damped) {
    const LinePoint point = equation_.at(middle_);
    const auto edges = around(point);
    const TongueEdges& own = edges[1];
    const TongueWidth width = tongue_width(point.variation, own, point.relative_error);
    const double share = width.value / distance(edges);
    if (!(share < kThinShare) || width.relative_error >= 1.0) return std::nullopt;
    const double steepness = steepness_of(width.value), across = steepness * (high_.position - low_.position),
                 off = steepness * low_.error * std::max(1.0, std::abs(middle_));
    ClosingDamping result{.position = middle_, .method = Method::fourier};
    result.damping = damped.rate_of(narrow_tongue_growth(point.variation, own, width), middle_);
    result.error = width.relative_error + kBehindIt * (share * share + across * across) + off + 16.0 * kUnit;
    return result;
  }

 private:
  /// The tongue and its neighbours, of which the upper one may be missing.
  std::vector<TongueEdges> around(const LinePoint& point) const {
    return tongue_edges(point.variation, low_.order - 1, std::min(low_.order + 1, kLargestTongue));
  }

  static double distance(const std::vector<TongueEdges>& edges) {
    const double below = edges[1].lower->value - edges[0].upper.value;
    return edges.size() < 3 ? below : std::min(below, edges[2].lower->value - edges[1].upper.value);
  }

  /// |d ln(width in the mean)/dp|, 0 along the mean.
  double steepness_of(double width) {
    if (equation_.one_variation()) return 0.0;
    const double step = std::min(1e-4 * std::max(std::abs(middle_), 1e-3), 0.25 * (line_.to - line_.from));
    const LinePoint beside = equation_.at(middle_ < line_.to - step ? middle_ + step : middle_ - step);
    const double other = tongue_width(beside.variation, around(beside)[1], beside.relative_error).value;
    return 1.1 * std::abs(std::log(other / width)) / step;
  }

  LineEquation& equation_;
  const TongueLine& line_;
  const TongueEdge &low_, &high_;
  double middle_;
};

}  // namespace

std::optional<ClosingDamping> tip_by_width(DampedLine& damped, LineEquation& equation, const TongueLine& line,
                                           const TongueEdge& low, const TongueEdge& high) {
  return ThinTongue(equation, line, low, high).tip(damped);
}

}  // namespace strutt
