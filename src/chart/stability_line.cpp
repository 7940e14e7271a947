#include "chart/stability_line.hpp"

#include <algorithm>
#include <cmath>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "base/minimum.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr double kTolerance = 1e-13;  // of the monodromy matrix
constexpr double kDip = 1e-6;         // a minimum is at least so much below its neighbours, relatively

/// Least over all pairs of -Re (a - b)^2/(a b): 4 sin^2 of half the angle between two of the same modulus,
/// negative for two on one ray. Analytic through a collision on the circle, where |a - b| has two cusps.
double least_gap(const std::vector<std::complex<double>>& multipliers) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto a = multipliers[i], b = multipliers[j], apart = a - b;
      least = std::min(least, -((apart / a) * (apart / b)).real());
    }
  return least;
}

class ChangeFinder {
 public:
  ChangeFinder(StabilityLine& line, double from, double to, const ChangeSearch& search)
      : line_(line), search_(search) {
    for (int i = 0; i <= search.steps && !cancelled(); ++i)
      add(std::lerp(from, to, static_cast<double>(i) / search.steps));
    if (search.stable_from && !samples_.empty()) samples_.front().unstable = false;
    if (search.stable_to && !cancelled()) samples_.back().unstable = false;
  }

  ChangeFinder(StabilityLine& line, const std::vector<double>& places, const ChangeSearch& search)
      : line_(line), search_(search) {
    for (const double p : places)
      if (!cancelled() && (p == places.front() || p == places.back() || is_certain(p))) add(p);
    if (search.stable_from && !samples_.empty()) samples_.front().unstable = false;
    if (search.stable_to && !cancelled()) samples_.back().unstable = false;
  }

  /// Where three samples agree and the one in the middle is closest to the other verdict.
  void look_between_samples() {
    const std::vector<Sample> grid = samples_;
    for (std::size_t i = 1; i + 1 < grid.size() && !cancelled(); ++i) {
      const bool unstable = grid[i].unstable;
      if (grid[i - 1].unstable != unstable || grid[i + 1].unstable != unstable) continue;
      const double sign = unstable ? -1.0 : 1.0;
      const auto margin = [&](double p) { return sign * line_.at(p).margin.value; };
      const auto gap = [&](double p) { return unstable ? 0.0 : line_.at(p).gap; };
      dip(grid[i - 1].position, grid[i].position, grid[i + 1].position, unstable, margin);
      dip(grid[i - 1].position, grid[i].position, grid[i + 1].position, unstable, gap);
    }
    std::ranges::sort(samples_, {}, &Sample::position);
  }

  std::vector<StabilityChange> changes() {
    std::vector<StabilityChange> result;
    for (std::size_t i = 1; i < samples_.size() && !cancelled(); ++i)
      if (samples_[i - 1].unstable != samples_[i].unstable)
        result.push_back(located(samples_[i - 1], samples_[i]));
    return result;
  }

 private:
  struct Sample {
    double position;
    bool unstable;
  };

  bool is_certain(double p) { return line_.at(p).unstable() || line_.at(p).stable(); }

  bool cancelled() const { return search_.cancel != nullptr && *search_.cancel; }
  void add(double p) { samples_.push_back({p, line_.at(p).unstable()}); }

  template <typename Function>
  void dip(double low, double middle, double high, bool unstable, const Function& function) {
    const double bound = std::min(function(low), function(high));
    if (!(function(middle) < bound - kDip * std::abs(bound))) return;
    const double p = least_between(function, low, high).place;
    if (line_.at(p).unstable() != unstable) add(p);
  }

  /// The zero of the margin, or its jump, between a stable and an unstable point.
  StabilityChange located(const Sample& low, const Sample& high) {
    const double unstable_end = low.unstable ? low.position : high.position;
    const double stable_end = low.unstable ? high.position : low.position;
    const bool proved = known_stable(stable_end) || line_.at(stable_end).stable();
    const auto value = [&](double p) {
      const Margin& margin = line_.at(p).margin;
      if (p == stable_end) return std::clamp(margin.value, 1e-300, 1.0);
      return std::clamp(proved ? margin.value : margin.value + margin.error, -1.0, 1.0);
    };
    const auto close = [this](double a, double b) { return are_neighbours(a, b) || b - a <= resolution(a); };
    const ZeroBracket bracket = bracketed_zero(value, low.position, high.position, value(low.position),
                                               value(high.position), close, 200);
    StabilityChange change{.position = bracket.middle(), .begins = high.unstable};
    const double to_unstable = distance_to(change.position, unstable_end, true);
    change.unstable_at = change.position + std::copysign(to_unstable, unstable_end - change.position);
    // where nothing proves stability the points that were looked at bound the change
    change.error = proved ? std::max(distance_to(change.position, stable_end, false), to_unstable) +
                                kUnit * std::abs(change.position)
                          : high.position - low.position;
    return change;
  }

  bool known_stable(double p) const {
    return (search_.stable_from && p == samples_.front().position) ||
           (search_.stable_to && p == samples_.back().position);
  }

  double resolution(double p) const { return search_.resolution * std::max(1.0, std::abs(p)); }

  /// How far from p towards `end` the verdict is certain.
  double distance_to(double p, double end, bool unstable) {
    const double rounding = kUnit * std::max(std::abs(p), std::abs(end - p));
    return certain_distance(p, end, std::max(rounding, resolution(p)), [&](double place) {
      return unstable ? line_.at(place).unstable() : line_.at(place).stable();
    });
  }

  StabilityLine& line_;
  const ChangeSearch& search_;
  std::vector<Sample> samples_;
};

}  // namespace

StabilityLine::StabilityLine(MonodromyEngine& engine, const Scene& scene, const std::string& path,
                             bool multipliers, Evaluations* evaluations)
    : engine_(engine),
      scene_(scene),
      value_(&parameter(scene_, path)),
      multipliers_(multipliers),
      evaluations_(evaluations) {}

const StabilityLine::Point& StabilityLine::at(double parameter) {
  if (const auto found = known_.find(parameter); found != known_.end()) return found->second;
  if (evaluations_ != nullptr) evaluations_->add(1);
  *value_ = parameter;
  const StabilityParts parts{.verdict = false, .winding = false, .matrix = multipliers_};
  const Stability s = analyse(engine_, linear_model(scene_), {.tolerance = kTolerance}, parts);
  Point point;
  point.margin = {s.margin, s.margin_error};
  point.growth = s.growth;
  point.method = s.method;
  if (!s.multipliers.empty()) {
    point.leading = s.multipliers.front();
    point.gap = least_gap(s.multipliers);
  }
  return known_.emplace(parameter, point).first->second;
}

std::optional<BoundedMatrix> StabilityLine::half_period(double parameter) {
  *value_ = parameter;
  const LinearModel model = linear_model(scene_);
  const auto* system = std::get_if<LinearPeriodicSystem>(&model);
  if (system == nullptr || system->has_damping()) return std::nullopt;
  return engine_.compute(*system, {.tolerance = kTolerance}).half;
}

std::vector<StabilityChange> stability_changes(StabilityLine& line, double from, double to,
                                               const ChangeSearch& search) {
  ChangeFinder finder(line, from, to, search);
  finder.look_between_samples();
  return finder.changes();
}

std::vector<StabilityChange> stability_changes(StabilityLine& line, const std::vector<double>& places,
                                               const ChangeSearch& search) {
  return ChangeFinder(line, places, search).changes();
}

GrowthPeak largest_growth(StabilityLine& line, double from, double to, int steps) {
  const auto position = [&](int i) { return std::lerp(from, to, static_cast<double>(i) / steps); };
  int best = 0;
  for (int i = 1; i <= steps; ++i)
    if (line.at(position(i)).growth > line.at(position(best)).growth) best = i;
  const auto [p, growth] =
      least_between([&](double x) { return -line.at(x).growth; }, position(std::max(best - 1, 0)),
                    position(std::min(best + 1, steps)));
  return {p, -growth};
}

}  // namespace strutt
