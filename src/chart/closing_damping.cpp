#include "strutt/chart/closing_damping.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "base/minimum.hpp"
#include "chart/edge_function.hpp"
#include "chart/unstable_intervals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/floquet/tongue_width.hpp"

namespace strutt {
namespace {

constexpr double kPromise = 1e-8;   // no smaller error is asked for
constexpr double kNarrow = 1e-3;    // width over distance to the next tongue, below which its square is small
constexpr int kSamples = 16;        // of the growth across a tongue: what has fewer maxima is seen
constexpr int kTurns = 30;          // five suffice
constexpr double kBehindIt = 32.0;  // of that square, in the growth: 7 in 272 trials, less than 1 in most

std::string damping_path(const Scene& scene) {
  if (scene.mathieu) return "mathieu.damping";
  if (scene.hill) return "hill.damping";
  if (scene.pendulum) return "pendulum.damping";
  throw InvalidInput("the damping that closes a tongue", "[linear]", "[pendulum], [mathieu] or [hill]");
}

/// The scene with one parameter and the damping to be set.
class DampedLine {
 public:
  DampedLine(const Scene& scene, const std::string& path)
      : scene_(scene), value_(&parameter(scene_, path)), damping_(&parameter(scene_, damping_path(scene))) {
    require(value_ != damping_, path, *value_, "another parameter than the damping");
    *damping_ = 0.0;
  }
  DampedLine(const DampedLine&) = delete;

  const Scene& undamped() const { return scene_; }

  Stability at(double p, double damping) {
    *value_ = p;
    *damping_ = damping;
    const auto result = analyse(engine_, linear_model(scene_), sharpest(), {.verdict = false});
    *damping_ = 0.0;
    return result;
  }

  double rate_of(double growth, double p) {
    *value_ = p;
    return 2.0 * growth / std::get<HillEquation>(linear_model(scene_)).period();
  }

  /// What the error of the margin is in damping, relative.
  double error(double p, double damping) {
    const double step = 1e-4 * damping;
    const double slope = (at(p, damping + step).margin - at(p, damping - step).margin) / (2.0 * step);
    const Stability s = at(p, damping);
    return (std::abs(s.margin) + s.margin_error) / std::abs(slope) / damping + 4.0 * kUnit;
  }

 private:
  MonodromyEngine engine_;
  Scene scene_;
  double *value_, *damping_;
};

/// The tip of a tongue by the monodromy matrix.
class WideTongue {
 public:
  WideTongue(DampedLine& damped, const TongueLine& line, const TongueEdge& low, const TongueEdge& high)
      : damped_(damped), line_(line), order_(low.order), low_(low.position), high_(high.position) {}

  ClosingDamping tip(ClosingDamping result) {
    Tip best;
    for (const double start : starts()) {
      const Tip tip = climb(start);
      if (tip.damping > best.damping) best = tip;
    }
    result.position = best.place;
    result.damping = best.damping;
    result.error = best.damping > 0.0 ? damped_.error(best.place, best.damping) + best.left : kInfinity;
    return result;
  }

 private:
  struct Tip {
    double place = 0.0, damping = 0.0;
    double left = kInfinity;  ///< to the maximum, relative
  };

  /// How much more damping the tongue could stand at a point, if damping did not shift the mean; no more than
  /// -c outside of it.
  double excess(double p, double c) {
    const Stability s = damped_.at(p, c);
    const bool inside = (s.discriminant > 0.0) == (order_ % 2 == 0) && std::lround(2.0 * s.winding) == order_;
    return inside ? 2.0 * s.growth_per_time : -c;
  }

  /// Where the growth without damping has its maxima, as far as some points of the tongue show.
  std::vector<double> starts() {
    std::vector<double> places, values;
    for (int i = 0; i <= kSamples; ++i) {
      places.push_back(std::lerp(low_, high_, static_cast<double>(i) / kSamples));
      values.push_back(i == 0 || i == kSamples ? 0.0 : excess(places.back(), 0.0));
    }
    std::vector<double> result;
    for (std::size_t i = 1; i + 1 < places.size(); ++i)
      if (values[i] > values[i - 1] && values[i] >= values[i + 1]) result.push_back(places[i]);
    return result;
  }

  /// In turn the place that stands most at a damping, and the damping that closes the tongue there: either
  /// squares the distance from the tip.
  Tip climb(double place) {
    Tip tip{.place = place};
    for (int turn = 0; turn < kTurns; ++turn) {
      const Minimum best = most_open(tip.place, tip.damping);
      const double rise = -best.value;
      tip.left = 4.0 * std::max(rise, 0.0) / tip.damping + 0x1p-50;  // a double's half of a maximum's digits
      if (!(rise > kUnit * tip.damping)) break;
      tip.place = best.place;
      tip.damping = closing(tip.place, tip.damping, rise);
    }
    return tip;
  }

  /// The maximum of the excess next to a place, on the line, with its sign turned.
  Minimum most_open(double place, double c) {
    const auto lack = [&](double p) { return -excess(p, c); };
    const Minimum here{place, lack(place)};
    const double low = beyond(here, line_.from, lack), high = beyond(here, line_.to, lack);
    Minimum best = least_between(lack, low, high, 28);
    for (const Minimum& other : {here, Minimum{low, lack(low)}, Minimum{high, lack(high)}})
      if (other.value < best.value) best = other;
    return best;
  }

  /// A place towards the end of the line, with the maximum before it or at that end.
  template <typename Function>
  double beyond(const Minimum& here, double end, const Function& lack) {
    double last = here.value;
    return here.place + std::copysign(certain_distance(here.place, end, (high_ - low_) / kSamples,
                                                       [&](double p) {
                                                         const double value = lack(p);
                                                         return value > std::exchange(last, value);
                                                       }),
                                      end - here.place);
  }

  /// The damping that closes the tongue at a place where it stands `rise` more than c.
  double closing(double p, double c, double rise) {
    const auto function = [&](double damping) { return excess(p, damping); };
    double low = c, high = c + rise, at_low = rise, at_high = function(high);
    for (; at_high > 0.0; at_high = function(high)) {
      low = std::exchange(high, high + 2.0 * (high - c));
      at_low = at_high;
    }
    return at_high == 0.0 ? high : bracketed_zero(function, low, high, at_low, at_high, are_close).middle();
  }

  DampedLine& damped_;
  const TongueLine& line_;
  int order_;
  double low_, high_;
};

/// The tip of a thin tongue by its width in the mean.
class ThinTongue {
 public:
  ThinTongue(LineEquation& equation, const TongueLine& line, const TongueEdge& low, const TongueEdge& high)
      : equation_(equation),
        line_(line),
        low_(low),
        high_(high),
        middle_(std::midpoint(low.position, high.position)) {}

  /// Nothing where the tongue is not thin.
  std::optional<ClosingDamping> tip(ClosingDamping result, DampedLine& damped) {
    const LinePoint point = equation_.at(middle_);
    const auto edges = around(point);
    const TongueEdges& own = edges[1];
    const TongueWidth width = tongue_width(point.variation, own, point.relative_error);
    const double share = width.value / distance(edges);
    if (!(share < kNarrow) || width.relative_error >= 1.0) return std::nullopt;
    const double steepness = steepness_of(width.value), across = steepness * (high_.position - low_.position),
                 off = steepness * low_.error * std::max(1.0, std::abs(middle_));
    result.position = middle_;
    result.damping = damped.rate_of(narrow_tongue_growth(point.variation, own, width), middle_);
    result.error = width.relative_error + kBehindIt * (share * share + across * across) + off + 16.0 * kUnit;
    result.method = Method::fourier;
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

std::vector<ClosingDamping> closing_damping(const Scene& scene, const TongueLine& line,
                                            const TongueOptions& options) {
  const DefaultFloatingPoint environment;
  DampedLine damped(scene, line.parameter);
  LineEquation equation(damped.undamped(), line);
  std::vector<ClosingDamping> result;
  const auto edges = tongues(Scene(damped.undamped()), line, options);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const TongueEdge &low = edges[i], &high = edges[i + 1];
    const bool pair = low.order == high.order && low.crossing == high.crossing && !low.upper && high.upper;
    if (!pair || low.order == 0 || low.width == 0.0 || low.width_relative_error >= 1.0) continue;
    if (options.cancel != nullptr && *options.cancel) break;
    ClosingDamping row{.tongue = low.order, .crossing = low.crossing};
    const auto thin = ThinTongue(equation, line, low, high).tip(row, damped);
    if (!thin || !(thin->error <= kPromise)) row = WideTongue(damped, line, low, high).tip(row);
    if (thin && !(row.error > 0.0 && row.error < thin->error)) row = *thin;
    if (!(row.error <= std::max(options.tolerance, kPromise))) row.outcome = Outcome::tolerance_not_reached;
    result.push_back(row);
  }
  return result;
}

}  // namespace strutt
