#include "floquet/splitting_propagators.hpp"

#include <cmath>
#include <cstdlib>

namespace strutt {
namespace {

constexpr std::size_t kMostTables = 256;

/// Calls visit(name, weight) for each term of W besides its mean, named as in SplittingPropagators::Group.
template <typename Visit>
void for_each_term(const PeriodicFunction& w, const Visit& visit) {
  for (const auto& h : w.harmonics()) {
    if (h.cosine != 0.0) visit(h.order, h.cosine);
    if (h.sine != 0.0) visit(-h.order, h.sine);
  }
}

ScaledMatrix2 scaled(const HillPropagators& lanes, std::size_t l, double kappa) {
  ScaledMatrix2 result{
      Eigen::Matrix2d{{lanes.u1[l], kappa * lanes.u2[l]}, {lanes.du1[l] / kappa, lanes.du2[l]}},
      lanes.exponent[l]};
  return result;
}

/// The coefficients of the members, in arrays.
struct Lanes {
  std::vector<double> mean, weights;

  Lanes(std::span<const SplittingJob> jobs, std::span<const std::size_t> members, std::size_t functions)
      : mean(members.size()), weights(members.size() * functions) {
    for (std::size_t l = 0; l < members.size(); ++l) {
      const auto& w = jobs[members[l]].w;
      mean[l] = w.mean();
      std::size_t place = l;
      for_each_term(w, [&](int, double weight) {
        weights[place] = weight;
        place += members.size();
      });
    }
  }

  HillBatch batch() const {
    HillBatch result{mean, {}};
    for (std::size_t begin = 0; begin < weights.size(); begin += mean.size()) {
      result.weights.emplace_back(weights.data() + begin, mean.size());
    }
    return result;
  }
};

}  // namespace

HillStepPlan SplittingPropagators::plan(const SplittingJob& job, double tolerance) {
  const int highest = job.w.highest_order();
  const double length = job.piece.to - job.piece.from;
  const auto [planner, is_new] =
      planners_.try_emplace({highest, length, tolerance}, highest, length, tolerance);
  return planner->second.plan(job.w.bound());
}

const HillPropagator& SplittingPropagators::table(const Group& group) {
  const auto found = tables_.find(group);
  if (found != tables_.end()) return found->second;
  std::vector<PeriodicFunction> basis;
  for (const int name : group.harmonics) {
    basis.push_back(
        PeriodicFunction::fourier(0.0, {{std::abs(name), name > 0 ? 1.0 : 0.0, name > 0 ? 0.0 : 1.0}}));
  }
  HillPropagator made({group.order, group.steps}, basis, group.from, group.to);
  return tables_.emplace(group, std::move(made)).first->second;
}

void SplittingPropagators::run(const Group& group, std::span<const SplittingJob> jobs,
                               std::span<const std::size_t> members, bool with_check,
                               std::vector<SplittingPropagation>& results) {
  if (tables_.size() + 2 > kMostTables) tables_.clear();
  const Lanes lanes(jobs, members, group.harmonics.size());
  const HillBatch batch = lanes.batch();
  HillPropagators found;
  const auto& full = table(group);
  full.propagate(batch, found);
  for (std::size_t l = 0; l < members.size(); ++l) {
    const auto& job = jobs[members[l]];
    auto& result = results[members[l]];
    result.matrix.value = scaled(found, l, job.kappa);
    const double size = result.matrix.value.mantissa.cwiseAbs().maxCoeff();
    const double radians = std::sqrt(job.w.bound()) * (job.piece.to - job.piece.from);
    result.matrix.error =
        Eigen::Matrix2d::Constant(size * (full.rounding() + job.coefficient_error * radians));
    result.matrix.normalise();
    result.check = result.matrix.value;
    result.cost = {.steps = group.steps, .rejections = 0, .right_hand_sides = full.evaluations()};
  }
  if (!with_check) return;
  Group halved = group;
  halved.steps /= 2;
  const auto& half = table(halved);
  half.propagate(batch, found);
  for (std::size_t l = 0; l < members.size(); ++l) {
    auto& result = results[members[l]];
    result.check = scaled(found, l, jobs[members[l]].kappa);
    result.check.normalise();
    result.truncation_share = halving_share(group.order);
    result.check_cost = {.steps = halved.steps, .rejections = 0, .right_hand_sides = half.evaluations()};
  }
}

std::vector<SplittingPropagation> SplittingPropagators::propagate(std::span<const SplittingJob> jobs,
                                                                  double tolerance, bool with_check) {
  std::vector<SplittingPropagation> results(jobs.size());
  std::map<Group, std::vector<std::size_t>> groups;
  Group group;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const HillStepPlan plan = this->plan(jobs[i], tolerance);
    if (plan.steps == 0) continue;
    group.order = plan.order;
    group.steps = plan.steps;
    group.from = jobs[i].piece.from;
    group.to = jobs[i].piece.to;
    group.harmonics.clear();
    for_each_term(jobs[i].w, [&](int name, double) { group.harmonics.push_back(name); });
    groups[group].push_back(i);
  }
  for (const auto& [common, members] : groups) run(common, jobs, members, with_check, results);
  return results;
}

}  // namespace strutt
