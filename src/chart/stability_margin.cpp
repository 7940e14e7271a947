#include "strutt/chart/stability_margin.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chart/joint_margin.hpp"
#include "chart/unstable_intervals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/floquet/sensitivity.hpp"
#include "strutt/model/model_derivative.hpp"

namespace strutt {
namespace {

/// The window ends grow by this from one to the next, beginning with this share of the value.
constexpr double kGrowth = 4.0, kFirst = 0.01;

bool is_valid(const Scene& scene, const std::string& path, double value) {
  Scene changed = scene;
  parameter(changed, path) = value;
  try {
    validate(changed);
    static_cast<void>(linear_model(changed));
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

/// What a parameter may be.
struct Allowed {
  double low, high;
  bool positive;  ///< 0 is not allowed: the way down is one of factors
};

/// The outermost value between `inside` and `outside` that is valid.
double valid_end(const Scene& scene, const std::string& path, double inside, double outside) {
  if (is_valid(scene, path, outside)) return outside;
  for (int i = 0; i < 200 && std::nextafter(inside, outside) != outside; ++i) {
    const double middle = std::midpoint(inside, outside);
    (is_valid(scene, path, middle) ? inside : outside) = middle;
  }
  return inside;
}

Allowed range_of(const Scene& scene, const std::string& path, double value, double reach) {
  const double size = value == 0.0 ? 1.0 : std::abs(value);
  const bool mass = path.starts_with("linear.mass.");  // singular at 0
  const bool positive = value != 0.0 && (mass || !is_valid(scene, path, 0.0));
  const double high = positive ? value * (value > 0.0 ? reach : 1.0 / reach) : value + reach * size;
  double low = positive ? value * (value > 0.0 ? 1.0 / reach : reach) : value - reach * size;
  if (!positive && !is_valid(scene, path, low) && is_valid(scene, path, 0.0)) low = std::min(value, 0.0);
  return {valid_end(scene, path, value, low), valid_end(scene, path, value, high), positive};
}

/// The ends of the windows on one side of the value, outwards. 0 is one of them: there tongues have their
/// tips.
std::vector<double> window_ends(double value, double limit, bool positive) {
  std::vector<double> ends;
  const double size = value == 0.0 ? 1.0 : std::abs(value);
  for (double share = kFirst;; share *= kGrowth) {
    const double step = limit > value ? share * size : -share * size;
    const bool inwards = positive && std::abs(limit) < std::abs(value);
    const double end = inwards ? value / (1.0 + share) : value + step;
    const bool beyond = limit > value ? end >= limit : end <= limit;
    const double last = ends.empty() ? value : ends.back(), next = beyond ? limit : end;
    if (last * next < 0.0) ends.push_back(0.0);
    ends.push_back(next);
    if (beyond) return ends;
  }
}

struct FoundEdge {
  LineEdge edge;
  int tongue;
};

/// The edge nearest to the value on one side.
std::optional<FoundEdge> nearest_edge(const Scene& scene, const std::string& path, double value, double limit,
                                      bool positive, const IntervalOptions& options) {
  if (value == limit) return std::nullopt;
  double from = value;
  for (const double to : window_ends(value, limit, positive)) {
    if (options.cancel != nullptr && *options.cancel) return std::nullopt;
    std::optional<FoundEdge> found;
    const TongueLine line{path, std::min(from, to), std::max(from, to)};
    for (const UnstableInterval& interval : unstable_intervals(scene, line, options)) {
      for (const auto& edge : {interval.begin, interval.end}) {
        const bool nearer =
            edge && (!found || std::abs(edge->position - value) < std::abs(found->edge.position - value));
        if (nearer) found = FoundEdge{*edge, interval.tongue};
      }
    }
    if (found) return found;
    from = to;
  }
  return std::nullopt;
}

ParameterMargin inert(const std::string& path, double value, double sign) {
  ParameterMargin result{.parameter = path, .value = value, .lower_edge = {}, .upper_edge = {}, .tongue = {}};
  result.distance *= sign;
  if (value != 0.0) result.relative_distance = result.distance;
  return result;
}

ParameterMargin margin_along(const Scene& scene, const std::string& path, double sign,
                             const MarginOptions& options) {
  const double value = parameter(scene, path);
  ParameterMargin result = inert(path, value, sign);
  if (!moves_stability(scene, path)) return result;
  const Allowed range = range_of(scene, path, value, options.reach);
  const IntervalOptions intervals{.tolerance = options.tolerance, .cancel = options.cancel};
  const auto below = nearest_edge(scene, path, value, range.low, range.positive, intervals);
  const auto above = nearest_edge(scene, path, value, range.high, range.positive, intervals);
  if (below) result.lower_edge = below->edge.position;
  if (above) result.upper_edge = above->edge.position;
  if (!below && !above) return result;
  const bool lower = below && (!above || value - below->edge.position <= above->edge.position - value);
  const FoundEdge& nearest = lower ? *below : *above;
  result.distance = sign * std::abs(nearest.edge.position - value);
  if (value != 0.0) result.relative_distance = result.distance / std::abs(value);
  if (nearest.tongue != kNoTongue) result.tongue = nearest.tongue;
  result.error = nearest.edge.error;
  result.method = nearest.edge.method;
  result.outcome = nearest.edge.outcome;
  return result;
}

bool has_reciprocal_multipliers(const LinearPeriodicSystem& system) {
  const auto c = system.proportional_damping();
  return c && *c >= 0.0 && system.stiffness.is_symmetric() && system.mass == system.mass.transpose();
}

/// `search`, or a row that says that the distance is not known.
template <typename Row, typename Search>
Row unless_beyond(Row row, const Search& search) {
  try {
    return search();
  } catch (const NumericalFailure&) {
    row.distance = row.error = std::numeric_limits<double>::quiet_NaN();
    row.outcome = Outcome::tolerance_not_reached;
    return row;
  }
}

/// On the edge, as far as can be said.
ParameterMargin margin_on_edge(const Scene& scene, const std::string& path, const Stability& design) {
  MonodromyEngine engine;
  const double value = parameter(scene, path);
  ParameterMargin result = inert(path, value, 1.0);
  result.method = design.method;
  if (!moves_stability(scene, path)) return result;
  result.distance = 0.0;
  if (value != 0.0) result.relative_distance = 0.0;
  if (!std::isnan(design.winding)) result.tongue = static_cast<int>(std::lround(2.0 * design.winding));
  if (design.verdict == Verdict::boundary) {
    result.lower_edge = result.upper_edge = value;
    return result;
  }
  const double slope = std::abs(sensitivity(engine, scene, path).margin.value);
  result.error = slope > 0.0 ? 2.0 * design.margin_error / slope / std::max(1.0, std::abs(value)) : HUGE_VAL;
  result.outcome = Outcome::tolerance_not_reached;
  return result;
}

}  // namespace

bool keeps_structure(const Scene& scene, const std::string& path) {
  if (!moves_stability(scene, path)) return false;
  if (!scene.linear || !has_reciprocal_multipliers(*scene.linear)) return true;
  Scene changed = scene;
  double& value = parameter(changed, path);
  value = value == 0.0 ? 1e-3 : value * 1.001;
  return has_reciprocal_multipliers(*changed.linear);
}

std::vector<std::string> stability_parameters(const Scene& scene) {
  std::vector<std::string> result = parameter_paths(scene);
  std::erase_if(result, [&](const std::string& path) { return !keeps_structure(scene, path); });
  return result;
}

StabilityMargin stability_margin(const Scene& scene, const std::vector<std::string>& parameters,
                                 const MarginOptions& options) {
  const DefaultFloatingPoint environment;
  require(options.tolerance >= 1e-13 && options.tolerance <= 1e-2, "tolerance", options.tolerance,
          "1e-13 to 1e-2");
  require(options.reach >= 2.0 && options.reach <= 1e6, "reach", options.reach, "2 to 1e6");
  validate(scene);
  for (const std::string& path : parameters) parameter_info(scene, path);
  MonodromyEngine engine;
  const Stability design = analyse(engine, linear_model(scene), sharpest(), {.matrix = false});
  StabilityMargin result{.verdict = design.verdict, .parameters = {}, .joint = {}};
  const bool decided = design.verdict == Verdict::stable || design.verdict == Verdict::unstable;
  const double sign = design.verdict == Verdict::unstable ? -1.0 : 1.0;
  result.parameters.resize(parameters.size());
  parallel_for(
      parameters.size(), {.threads = options.threads, .cancel = options.cancel}, [&](std::size_t i, int) {
        const std::string& path = parameters[i];
        const ParameterMargin nothing = inert(path, parameter(scene, path), NAN);
        result.parameters[i] =
            decided ? unless_beyond(nothing, [&] { return margin_along(scene, path, sign, options); })
                    : margin_on_edge(scene, path, design);
      });
  if (decided) {
    result.joint = unless_beyond(
        JointMargin{}, [&] { return joint_margin(scene, design.verdict, result.parameters, options); });
  } else {
    result.joint.distance = 0.0;
    result.joint.method = design.method;
    if (!result.parameters.empty()) result.joint.tongue = result.parameters.front().tongue;
    if (design.verdict == Verdict::unresolved) {
      result.joint.outcome = Outcome::tolerance_not_reached;
      result.joint.error = HUGE_VAL;
    }
  }
  return result;
}

}  // namespace strutt
