#include "chart/unstable_intervals.hpp"

#include <algorithm>
#include <cmath>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "base/minimum.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

std::vector<UnstableInterval> proved_intervals(const Scene& scene, const TongueLine& line,
                                               const IntervalOptions& options) {
  std::vector<UnstableInterval> result;
  int order = -1, crossing = -1;
  for (const TongueEdge& edge :
       tongues(scene, line, {.tolerance = options.tolerance, .cancel = options.cancel})) {
    if (edge.width == 0.0 || edge.width_relative_error >= 1.0) continue;  // closed
    if (result.empty() || edge.order != order || edge.crossing != crossing)
      result.push_back({.tongue = edge.order, .begin = {}, .end = {}});
    order = edge.order;
    crossing = edge.crossing;
    (edge.upper ? result.back().end : result.back().begin) =
        LineEdge{edge.position, edge.error, edge.method, edge.outcome};
  }
  return result;
}

/// The sign of the margin at points of the line.
class MarginScan {
 public:
  MarginScan(const Scene& scene, const TongueLine& line, const IntervalOptions& options)
      : line_(scene, line.parameter), from_(line.from), to_(line.to), options_(options) {}

  std::vector<UnstableInterval> intervals() {
    sample();
    std::vector<UnstableInterval> result;
    if (unstable_.front()) result.push_back({});
    for (std::size_t i = 0; i + 1 < places_.size() && !cancelled(); ++i) {
      if (unstable_[i] == unstable_[i + 1]) continue;
      const LineEdge edge = enclosed(places_[i], places_[i + 1]);
      if (unstable_[i + 1]) {
        result.push_back({.tongue = kNoTongue, .begin = edge, .end = {}});
      } else {
        result.back().end = edge;
      }
    }
    for (UnstableInterval& interval : result) interval.tongue = tongue_of(interval);
    return result;
  }

 private:
  bool cancelled() const { return options_.cancel != nullptr && *options_.cancel; }
  double margin(double p) { return line_.at(p).margin; }
  static bool is_unstable(const Stability& s) { return s.verdict == Verdict::unstable; }

  void sample() {
    for (int i = 0; i <= options_.samples; ++i)
      places_.push_back(
          i == options_.samples ? to_ : std::lerp(from_, to_, static_cast<double>(i) / options_.samples));
    std::vector<double> margins;
    for (const Stability& s : line_.at(places_)) {
      unstable_.push_back(is_unstable(s));
      margins.push_back(s.margin);
    }
    add_extrema(margins);
  }

  /// Points between the samples at which a dip of the margin below 0, or a rise above it, is deepest.
  void add_extrema(const std::vector<double>& margins) {
    std::vector<double> found;
    for (std::size_t i = 1; i + 1 < margins.size() && !cancelled(); ++i) {
      if (unstable_[i - 1] != unstable_[i] || unstable_[i] != unstable_[i + 1]) continue;
      const double sign = unstable_[i] ? -1.0 : 1.0;
      const bool extreme =
          sign * margins[i] < sign * margins[i - 1] && sign * margins[i] <= sign * margins[i + 1];
      if (!extreme) continue;
      const auto [place, least] =
          least_between([&](double x) { return sign * margin(x); }, places_[i - 1], places_[i + 1], 26);
      if (least < 0.0 && is_unstable(line_.at(place)) != unstable_[i]) found.push_back(place);
    }
    for (const double place : found) {
      const auto at = std::ranges::lower_bound(places_, place);
      unstable_.insert(unstable_.begin() + (at - places_.begin()), is_unstable(line_.at(place)));
      places_.insert(at, place);
    }
  }

  /// The change of verdict between a and b, and how far on either side the verdict is certain.
  LineEdge enclosed(double a, double b) {
    const bool unstable_before = is_unstable(line_.at(a));
    const auto smooth = [&](double p) {  // the margin where its sign agrees with the side, for faster steps
      const Stability s = line_.at(p);
      const double side = is_unstable(s) == unstable_before ? 1.0 : -1.0;
      const double m = unstable_before ? -s.margin : s.margin;
      return std::isfinite(m) && m * side > 0.0 ? m : side * 1e-18;
    };
    const double position = bracketed_zero(smooth, a, b, smooth(a), smooth(b), are_close).middle();
    // beyond a and b: one of them may be just where the line touches the other side
    const double before = certain(position, std::max(from_, 2.0 * a - b), unstable_before),
                 after = certain(position, std::min(to_, 2.0 * b - a), !unstable_before);
    LineEdge edge{
        .position = position,
        .error = (std::max(before, after) + kUnit * std::abs(position)) / std::max(1.0, std::abs(position)),
        .method = line_.at(position).method};
    if (!(edge.error <= options_.tolerance)) edge.outcome = Outcome::tolerance_not_reached;
    return edge;
  }

  /// The distance from `place` towards `end` at which the verdict is the wanted one. Where it is uncertain
  /// first and then the other up to the end, the line only touches the wanted side, in what is uncertain.
  double certain(double place, double end, bool unstable) {
    const Verdict wanted = unstable ? Verdict::unstable : Verdict::stable;
    const double most = std::abs(end - place);
    double uncertain = HUGE_VAL, step = 4.0 * kUnit * std::max(std::abs(place), 1e-3 * most);
    for (; step < 2.0 * most; step *= 2.0) {
      const Verdict found = line_.at(place + std::copysign(step, end - place)).verdict;
      if (found == wanted) return step;
      if (found == Verdict::unresolved) uncertain = step;
    }
    return 4.0 * uncertain < step ? 2.0 * uncertain : HUGE_VAL;
  }

  int tongue_of(const UnstableInterval& interval) {
    const double a = interval.begin ? interval.begin->position : from_,
                 b = interval.end ? interval.end->position : to_;
    const double winding = line_.at(0.5 * (a + b), true).winding;
    return std::isnan(winding) ? kNoTongue : static_cast<int>(std::lround(2.0 * winding));
  }

  MarginLine line_;
  double from_, to_;
  const IntervalOptions& options_;
  std::vector<double> places_;
  std::vector<bool> unstable_;
};

bool is_undamped(const Scene& scene, const TongueLine& line) {
  Scene changed = scene;
  double& value = parameter(changed, line.parameter);
  for (const double end : {line.from, line.to}) {
    value = end;
    const LinearModel model = linear_model(changed);
    const auto* equation = std::get_if<HillEquation>(&model);
    if (equation == nullptr || equation->damping != 0.0) return false;
  }
  return true;
}

/// Is tongues() complete on this line? With damping it is so along the mean of W only.
bool is_known(const Scene& scene, const TongueLine& line) {
  if (!is_undamped(scene, line)) return false;
  try {
    require_tongue_line(scene, line);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

bool is_countable(const Scene& scene, const TongueLine& line) {
  try {
    return tongue_count(scene, line) <= kLargestTongue + 1;
  } catch (const InvalidInput&) {
    return false;
  }
}

std::vector<UnstableInterval> intervals_of(const Scene& scene, const TongueLine& line,
                                           const IntervalOptions& options) {
  if (is_known(scene, line)) {
    if (is_countable(scene, line)) {
      try {
        return proved_intervals(scene, line, options);
      } catch (const NumericalFailure&) {  // the line touches an edge, as at the tip of a tongue
      }
    } else if (is_undamped_fourier(linear_model(scene))) {
      throw NumericalFailure(line.parameter + ": more than 1000 tongues, most of them too thin to be seen");
    }
  }
  return MarginScan(scene, line, options).intervals();
}

}  // namespace

bool is_undamped_fourier(const LinearModel& model) {
  const auto* equation = std::get_if<HillEquation>(&model);
  return equation != nullptr && equation->damping == 0.0 &&
         (equation->coefficient.is_constant() || !equation->coefficient.harmonics().empty());
}

MonodromyOptions sharpest() { return {.tolerance = 1e-13}; }

Stability MarginLine::at(double p, bool winding) {
  *value_ = p;
  return analyse(engine_, linear_model(scene_), sharpest(), {.winding = winding, .matrix = false});
}

std::vector<Stability> MarginLine::at(const std::vector<double>& p) {
  std::vector<LinearModel> models;
  for (const double value : p) {
    *value_ = value;
    models.push_back(linear_model(scene_));
  }
  return analyse(engine_, models, sharpest(), {.winding = false, .matrix = false});
}

std::vector<UnstableInterval> unstable_intervals(const Scene& scene, const TongueLine& line,
                                                 const IntervalOptions& options) {
  auto result = intervals_of(scene, line, options);
  std::ranges::sort(result, {}, [&](const UnstableInterval& i) {
    return i.begin ? i.begin->position : i.end ? i.end->position : line.from;
  });
  return result;
}

}  // namespace strutt
