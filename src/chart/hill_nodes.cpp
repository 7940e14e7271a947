#include "chart/hill_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

using Points = std::vector<std::optional<PointEquation>>;

/// The points that share a plan, and its tables.
struct Group {
  HillStepPlan plan;
  std::vector<std::size_t> members;
  const HillPropagator* full = nullptr;
  const HillPropagator* half = nullptr;
};

/// The functions of the phase that occur: k for cos(k theta), -k for sin(k theta).
std::vector<int> basis_of(const Points& points) {
  std::set<int> names;
  for (const auto& point : points) {
    if (!point) continue;
    for (const auto& h : point->equation.coefficient.harmonics()) {
      if (h.cosine != 0.0) names.insert(h.order);
      if (h.sine != 0.0) names.insert(-h.order);
    }
  }
  return {names.begin(), names.end()};
}

std::vector<Group> groups_of(const Points& points, double length, double tolerance) {
  std::map<int, HillStepPlanner> planners;  // by the highest order
  std::map<std::pair<int, int>, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i]) continue;
    const auto& w = points[i]->equation.coefficient;
    const int highest = w.highest_order();
    const auto plan = planners.try_emplace(highest, highest, length, tolerance).first->second.plan(w.bound());
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

  Lanes(const Points& points, std::span<const std::size_t> members, const std::vector<int>& basis)
      : weights(basis.size(), std::vector<double>(members.size(), 0.0)) {
    for (std::size_t l = 0; l < members.size(); ++l) {
      const auto& w = points[members[l]]->equation.coefficient;
      mean.push_back(w.mean());
      for (const auto& h : w.harmonics()) {
        for (const auto& [name, weight] : {std::pair{h.order, h.cosine}, std::pair{-h.order, h.sine}}) {
          const auto place = std::lower_bound(basis.begin(), basis.end(), name);
          if (weight != 0.0) weights[static_cast<std::size_t>(place - basis.begin())][l] = weight;
        }
      }
    }
  }

  HillBatch batch() const {
    HillBatch result{mean, {}};
    for (const auto& w : weights) result.weights.emplace_back(w);
    return result;
  }
};

/// The propagator of one lane in the state (Y, Y'/kappa).
Eigen::Matrix2d scaled(const HillPropagators& lanes, std::size_t l, double kappa, long exponent) {
  const auto shift = static_cast<int>(std::clamp(lanes.exponent[l] - exponent, -5000L, 5000L));
  return Eigen::Matrix2d{{std::ldexp(lanes.u1[l], shift), std::ldexp(lanes.u2[l], shift) * kappa},
                         {std::ldexp(lanes.du1[l], shift) / kappa, std::ldexp(lanes.du2[l], shift)}};
}

/// `rounding`: relative to the largest entry. `share`: of the difference to the run with half of the steps.
PropagatorSample sample_of(const PointEquation& point, const HillPropagators& full,
                           const HillPropagators& half, std::size_t l, double length, double rounding,
                           double share) {
  PropagatorSample result;
  result.exponent = full.exponent[l];
  result.half_damping = point.half_damping;
  result.kappa = point.kappa;
  result.shifted = point.shifted;
  const Eigen::Matrix2d value = scaled(full, l, point.kappa, result.exponent);
  const double difference = (value - scaled(half, l, point.kappa, result.exponent)).cwiseAbs().maxCoeff();
  const double size = value.cwiseAbs().maxCoeff();
  const auto& w = point.equation.coefficient;
  const double evaluation = (2.0 + 2.0 * pi * w.highest_order()) * kUnit;
  const double coefficients = (evaluation + point.equation.coefficient_error) * length * std::sqrt(w.bound());
  const double error = share * difference + size * (rounding + coefficients);
  const auto canonical = at_kappa(value, Eigen::Matrix2d::Constant(error), 1.0 / point.kappa);
  result.value = canonical.value;
  result.error = canonical.error;
  result.valid = std::isfinite(error) && std::isfinite(size);
  return result;
}

}  // namespace

HillNodes::HillNodes(const Scene& scene, const Axis& x, const Axis& y,
                     const std::optional<double>& even_phase, const ParallelOptions& parallel)
    : parallel_(parallel), model_(scene, x, y, even_phase), length_(even_phase ? pi : 2.0 * pi) {}

const HillPropagator& HillNodes::table(const HillStepPlan& plan, const std::vector<int>& harmonics) {
  const std::tuple key{plan.order, plan.steps, harmonics};
  const auto found = tables_.find(key);
  if (found != tables_.end()) return found->second;
  std::vector<PeriodicFunction> basis;
  for (const int name : harmonics) {
    basis.push_back(
        PeriodicFunction::fourier(0.0, {{std::abs(name), name > 0 ? 1.0 : 0.0, name > 0 ? 0.0 : 1.0}}));
  }
  return tables_.emplace(key, HillPropagator(plan, basis, 0.0, length_)).first->second;
}

bool HillNodes::sample(const std::vector<std::array<double, 2>>& values, double tolerance,
                       std::vector<PropagatorSample>& result) {
  result.assign(values.size(), {});
  Points points;
  for (const auto& value : values) points.push_back(model_.at(value[0], value[1]));
  const auto basis = basis_of(points);
  auto groups = groups_of(points, length_, tolerance);
  if (tables_.size() + 2 * groups.size() > kMostTables) tables_.clear();
  for (auto& group : groups) {
    group.full = &table(group.plan, basis);
    group.half = &table({group.plan.order, group.plan.steps / 2}, basis);
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
    const Lanes lanes(points, members, basis);
    HillPropagators full, half;
    group->full->propagate(lanes.batch(), full);
    group->half->propagate(lanes.batch(), half);
    const double rounding = group->full->rounding(), share = halving_share(group->plan.order);
    for (std::size_t l = 0; l < members.size(); ++l) {
      const auto& point = *points[members[l]];
      auto& sample = result[members[l]];
      sample = sample_of(point, full, half, l, length_, rounding, share);
      sample.right_hand_sides = group->full->evaluations() + group->half->evaluations();
    }
  });
  return complete && !(parallel_.cancel != nullptr && parallel_.cancel->load());
}

}  // namespace strutt
