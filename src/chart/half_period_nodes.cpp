#include "chart/half_period_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "strutt/integrate/hill_propagator.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kUnit = 0x1p-53;
constexpr std::size_t kLanes = 64;  // of a job
constexpr std::size_t kMostTables = 256;

using Points = std::vector<std::optional<CentredEquation>>;

/// The points that share a plan, and its tables.
struct Group {
  HillStepPlan plan;
  std::vector<std::size_t> members;
  const HillPropagator* full = nullptr;
  const HillPropagator* half = nullptr;
};

std::vector<int> orders_of(const Points& points) {
  std::set<int> orders;
  for (const auto& point : points) {
    if (!point) continue;
    for (const auto& h : point->equation.coefficient.harmonics()) orders.insert(h.order);
  }
  return {orders.begin(), orders.end()};
}

std::vector<Group> groups_of(const Points& points, double tolerance) {
  std::map<std::pair<int, int>, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i]) continue;
    const auto plan = plan_hill_steps(points[i]->equation.coefficient, 0.0, pi, tolerance);
    if (plan.steps > 0) members[{plan.order, plan.steps}].push_back(i);
  }
  std::vector<Group> groups;
  for (auto& [key, list] : members) {
    groups.push_back({{key.first, key.second}, std::move(list)});
  }
  return groups;
}

/// Means and weights of some lanes.
struct Lanes {
  std::vector<double> mean;
  std::vector<std::vector<double>> weights;

  Lanes(const Points& points, std::span<const std::size_t> members, const std::vector<int>& orders)
      : weights(orders.size(), std::vector<double>(members.size(), 0.0)) {
    for (std::size_t l = 0; l < members.size(); ++l) {
      const auto& w = points[members[l]]->equation.coefficient;
      mean.push_back(w.mean());
      for (const auto& h : w.harmonics()) {
        const auto place = std::lower_bound(orders.begin(), orders.end(), h.order) - orders.begin();
        weights[static_cast<std::size_t>(place)][l] = h.cosine;
      }
    }
  }

  HillBatch batch() const {
    HillBatch result{mean, {}};
    for (const auto& w : weights) result.weights.emplace_back(w);
    return result;
  }
};

/// The factors of one lane in the state (Y, Y'/kappa).
std::array<double, 4> scaled(const HillPropagators& lanes, std::size_t l, double kappa, long exponent) {
  const auto shift = static_cast<int>(std::clamp(lanes.exponent[l] - exponent, -5000L, 5000L));
  return {std::ldexp(lanes.u1[l], shift), std::ldexp(lanes.u2[l], shift) * kappa,
          std::ldexp(lanes.du1[l], shift) / kappa, std::ldexp(lanes.du2[l], shift)};
}

/// `relative_rounding`: of the largest factor.
HalfPeriodSample sample_of(const CentredEquation& point, const HillPropagators& full,
                           const HillPropagators& half, std::size_t l, double relative_rounding,
                           double share) {
  HalfPeriodSample result;
  result.exponent = full.exponent[l];
  result.half_damping = point.half_damping;
  result.kappa = point.kappa;
  result.shifted = point.shifted;
  result.value = scaled(full, l, point.kappa, result.exponent);
  const auto check = scaled(half, l, point.kappa, result.exponent);
  double size = 0.0, difference = 0.0;
  for (std::size_t f = 0; f < 4; ++f) {
    size = std::max(size, std::abs(result.value[f]));
    difference = std::max(difference, std::abs(result.value[f] - check[f]));
  }
  const double radians = pi * std::sqrt(point.equation.coefficient.bound());
  const double evaluation = (2.0 + 2.0 * pi * point.equation.coefficient.highest_order()) * kUnit;
  const double error = share * difference +
                       size * (relative_rounding + (evaluation + point.equation.coefficient_error) * radians);
  result.error.fill(error);
  result.value[1] /= point.kappa;
  result.value[2] *= point.kappa;
  result.error[1] = error / point.kappa + 2.0 * kUnit * std::abs(result.value[1]);
  result.error[2] = error * point.kappa + 2.0 * kUnit * std::abs(result.value[2]);
  result.valid = std::isfinite(error) && std::isfinite(size);
  return result;
}

}  // namespace

HalfPeriodNodes::HalfPeriodNodes(const Scene& scene, const Axis& x, const Axis& y, double even_phase,
                                 const ParallelOptions& parallel)
    : parallel_(parallel), model_(scene, x, y, even_phase) {}

const HillPropagator& HalfPeriodNodes::table(const HillStepPlan& plan, const std::vector<int>& harmonics) {
  const std::tuple key{plan.order, plan.steps, harmonics};
  const auto found = tables_.find(key);
  if (found != tables_.end()) return found->second;
  std::vector<PeriodicFunction> basis;
  for (const int order : harmonics) basis.push_back(PeriodicFunction::fourier(0.0, {{order, 1.0, 0.0}}));
  return tables_.emplace(key, HillPropagator(plan, basis, 0.0, pi)).first->second;
}

bool HalfPeriodNodes::sample(const std::vector<std::array<double, 2>>& values, double tolerance,
                             std::vector<HalfPeriodSample>& result) {
  result.assign(values.size(), {});
  Points points;
  for (const auto& value : values) points.push_back(model_.at(value[0], value[1]));
  const auto orders = orders_of(points);
  auto groups = groups_of(points, tolerance);
  if (tables_.size() + 2 * groups.size() > kMostTables) tables_.clear();
  for (auto& group : groups) {
    group.full = &table(group.plan, orders);
    group.half = &table({group.plan.order, group.plan.steps / 2}, orders);
  }
  std::vector<std::pair<const Group*, std::size_t>> jobs;
  for (const auto& group : groups) {
    for (std::size_t first = 0; first < group.members.size(); first += kLanes)
      jobs.emplace_back(&group, first);
  }
  const bool complete = parallel_for(jobs.size(), parallel_, [&](std::size_t job, int) {
    const auto& [group, first] = jobs[job];
    const auto members =
        std::span(group->members).subspan(first, std::min(kLanes, group->members.size() - first));
    const Lanes lanes(points, members, orders);
    HillPropagators full, half;
    group->full->propagate(lanes.batch(), full);
    group->half->propagate(lanes.batch(), half);
    const double rounding = group->full->rounding(), share = halving_share(group->plan.order);
    for (std::size_t l = 0; l < members.size(); ++l) {
      const auto& point = *points[members[l]];
      auto& sample = result[members[l]];
      sample = sample_of(point, full, half, l, rounding, share);
      sample.right_hand_sides = group->full->evaluations() + group->half->evaluations();
    }
  });
  return complete && !(parallel_.cancel != nullptr && parallel_.cancel->load());
}

}  // namespace strutt
