#include "strutt/chart/closing_damping.hpp"

#include <cmath>
#include <numeric>
#include <string>

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

constexpr double kAtEnd = 1e-5;     // of the way between the undamped edges
constexpr double kPromise = 1e-8;   // no smaller error is asked for
constexpr double kNarrow = 1e-3;    // width over distance to the next tongue, below which its square is small
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
    const auto result = analyse(engine_, linear_model(scene_), sharpest(),
                                {.verdict = false, .winding = false, .matrix = false});
    *damping_ = 0.0;
    return result;
  }

  double rate_of(double growth, double p) {
    *value_ = p;
    return 2.0 * growth / std::get<HillEquation>(linear_model(scene_)).period();
  }

  /// The damping that makes a point marginal, 0 where it is stable without.
  double marginal(double p) {
    const Stability undamped = at(p, 0.0);
    if (!(undamped.margin < 0.0)) return 0.0;
    double high = rate_of(undamped.growth, p);  // damping also shifts the mean: a little more may be needed
    const auto margin = [&](double c) { return at(p, c).margin; };
    for (int doubling = 0; margin(high) < 0.0; ++doubling) {
      if (doubling == 60) return HUGE_VAL;
      high *= 1.5;
    }
    const double at_high = margin(high);
    if (at_high == 0.0) return high;
    return bracketed_zero(margin, 0.0, high, undamped.margin, at_high, are_close).middle();
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

/// The tip of a tongue by the damping that each point needs.
ClosingDamping by_margins(DampedLine& line, ClosingDamping result, double from, double to) {
  const auto [place, negative] = least_between([&](double x) { return -line.marginal(x); }, from, to, 28);
  result.position = place;
  result.damping = -negative;
  result.error =
      line.error(result.position, result.damping) + 0x1p-50;  // and what is left of the maximum: (2^-26)^2
  // at an end the tongue stays open longer beyond it: damping lowers the mean
  if (std::min(place - from, to - place) < kAtEnd * (to - from)) result.error = kInfinity;
  return result;
}

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
    if (!thin || !(thin->error <= kPromise)) row = by_margins(damped, row, low.position, high.position);
    if (thin && !(row.error > 0.0 && row.error < thin->error)) row = *thin;
    if (!(row.error <= std::max(options.tolerance, kPromise))) row.outcome = Outcome::tolerance_not_reached;
    result.push_back(row);
  }
  return result;
}

}  // namespace strutt
