#include "strutt/chart/worst_growth.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>

#include "chart/growth_bound.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/model/model_derivative.hpp"

namespace strutt {
namespace {

constexpr std::size_t kSystemSamples = 2000;  // of systems, in each of the two sets
constexpr double kFinest = 1e-9;              // step of the pattern search, of the range

void validate_box(const Scene& scene, const std::vector<ParameterRange>& box) {
  const auto count = static_cast<double>(box.size());
  require(count >= 1 && box.size() <= kMostUncertain, "number of uncertain parameters", count, "1 to 8");
  std::set<std::string> seen;
  Scene corner = scene;
  for (const ParameterRange& range : box) {
    if (!seen.insert(range.parameter).second)
      throw InvalidInput("uncertain parameter '" + range.parameter + "' is given twice");
    require(std::isfinite(range.from) && std::isfinite(range.to), range.parameter, range.to - range.from,
            "a finite range");
    require(range.from <= range.to, range.parameter + ": TO", range.to,
            "not below FROM = " + to_text(range.from));
    if (!moves_stability(scene, range.parameter))
      throw InvalidInput("'" + range.parameter + "' has no influence on the stability");
    for (const double end : {range.to, range.from}) {
      parameter(corner, range.parameter) = end;
      validate(corner);
      static_cast<void>(linear_model(corner));
    }
  }
}

/// The largest growth found so far.
class Best {
 public:
  Best(BoxScene& scene, const std::vector<ParameterRange>& box) : scene_(scene), box_(box) {}

  std::vector<double> at;
  double growth = -HUGE_VAL;
  std::size_t evaluations = 0;
  Method method = Method::propagator;

  bool offer(const std::vector<double>& values, double found) {
    if (!(found > growth)) return false;
    growth = found;
    at = values;
    return true;
  }

  bool try_at(const std::vector<double>& values) {
    ++evaluations;
    const Stability s = scene_.stability(values);
    method = s.method;
    return offer(values, s.growth);
  }

  void try_corners() {
    for (std::size_t mask = 0; mask < (std::size_t{1} << box_.size()); ++mask) {
      std::vector<double> corner;
      for (std::size_t i = 0; i < box_.size(); ++i)
        corner.push_back((mask >> i & 1) != 0 ? box_[i].to : box_[i].from);
      try_at(corner);
    }
  }

  /// Steps along the axes, halved where none improves.
  void climb() {
    for (double share = 0.25; share > kFinest;) {
      bool better = false;
      for (std::size_t i = 0; i < box_.size(); ++i) {
        for (const double side : {-1.0, 1.0}) {
          auto next = at;
          const double range = box_[i].to - box_[i].from;
          next[i] = std::clamp(at[i] + side * share * range, box_[i].from, box_[i].to);
          if (next[i] != at[i] && try_at(next)) better = true;
        }
      }
      if (!better) share *= 0.5;
    }
  }

 private:
  BoxScene& scene_;
  const std::vector<ParameterRange>& box_;
};

struct SmallerBound {
  bool operator()(const GrowthCell& a, const GrowthCell& b) const { return a.bound < b.bound; }
};

WorstGrowth branch_and_bound(BoxScene& scene, const std::vector<ParameterRange>& box,
                             const WorstGrowthOptions& options) {
  Best best(scene, box);
  best.try_corners();
  std::priority_queue<GrowthCell, std::vector<GrowthCell>, SmallerBound> cells;
  const auto add = [&](GrowthCell cell) {
    bound_growth(scene, cell);
    ++best.evaluations;
    best.offer(cell.centre(), cell.found);
    cells.push(std::move(cell));
  };
  GrowthCell whole;
  for (const auto& range : box) {
    whole.low.push_back(range.from);
    whole.high.push_back(range.to);
  }
  add(whole);
  best.climb();
  double climbed = best.growth;
  const auto cancelled = [&] { return options.cancel != nullptr && *options.cancel; };
  while (cells.top().bound > best.growth + options.tolerance && best.evaluations < options.evaluations &&
         !cancelled()) {
    GrowthCell lower = cells.top(), upper = lower;
    cells.pop();
    lower.high[lower.longest] = upper.low[lower.longest] = lower.centre()[lower.longest];
    add(std::move(lower));
    add(std::move(upper));
    if (best.growth > climbed + 0.1 * options.tolerance) {
      best.climb();
      climbed = best.growth;
    }
  }
  WorstGrowth result{.growth = best.growth,
                     .proved = true,
                     .at = best.at,
                     .evaluations = best.evaluations,
                     .method = best.method};
  result.error = std::max(0.0, cells.top().bound - best.growth);
  return result;
}

/// Number `index` in the base `base`, its digits mirrored behind the point.
double radical_inverse(std::size_t index, std::size_t base) {
  double result = 0.0, digit = 1.0;
  for (; index > 0; index /= base) {
    digit /= static_cast<double>(base);
    result += digit * static_cast<double>(index % base);
  }
  return result;
}

WorstGrowth sampled(BoxScene& scene, const std::vector<ParameterRange>& box,
                    const WorstGrowthOptions& options) {
  constexpr std::size_t kPrimes[kMostUncertain] = {2, 3, 5, 7, 11, 13, 17, 19};
  const std::size_t samples = std::min(kSystemSamples, options.evaluations / 4);
  std::vector<Best> sets(2, Best(scene, box));
  for (std::size_t set = 0; set < 2; ++set) {
    if (set == 0) sets[set].try_corners();
    for (std::size_t k = 0; k < samples; ++k) {
      if (options.cancel != nullptr && *options.cancel) return {};
      std::vector<double> values;
      for (std::size_t i = 0; i < box.size(); ++i)
        values.push_back(
            std::lerp(box[i].from, box[i].to, radical_inverse(1 + k + set * samples, kPrimes[i])));
      sets[set].try_at(values);
    }
    sets[set].climb();
  }
  const Best& best = sets[0].growth >= sets[1].growth ? sets[0] : sets[1];
  return {.growth = best.growth,
          .error = std::abs(sets[0].growth - sets[1].growth) + 1e-12,
          .proved = false,
          .at = best.at,
          .evaluations = sets[0].evaluations + sets[1].evaluations,
          .method = best.method};
}

}  // namespace

WorstGrowth worst_growth(const Scene& scene, const std::vector<ParameterRange>& box,
                         const WorstGrowthOptions& options) {
  const DefaultFloatingPoint environment;
  require(options.tolerance >= 1e-13 && options.tolerance <= 1e-2, "tolerance", options.tolerance,
          "1e-13 to 1e-2");
  require(options.evaluations >= 100 && options.evaluations <= 100'000'000, "evaluations",
          static_cast<double>(options.evaluations), "100 to 1e8");
  validate(scene);
  validate_box(scene, box);
  BoxScene points(scene, box);
  const LinearModel model = linear_model(scene);
  const auto* system = std::get_if<LinearPeriodicSystem>(&model);
  WorstGrowth result =
      system == nullptr ? branch_and_bound(points, box, options) : sampled(points, box, options);
  if (!(result.error <= options.tolerance)) result.outcome = Outcome::tolerance_not_reached;
  return result;
}

}  // namespace strutt
