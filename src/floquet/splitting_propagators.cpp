#include "floquet/splitting_propagators.hpp"

#include <cmath>
#include <cstdlib>

namespace strutt {
namespace {

constexpr std::size_t kMostFamilies = 64;

/// Calls visit(name, weight) for each term of W besides its mean, named as in SplittingPropagators::Key.
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

/// Writes the results of a group to the members' places.
void unpack(const HillGroup& group, std::span<const SplittingJob> jobs, std::span<const std::size_t> members,
            std::vector<SplittingPropagation>& results) {
  for (std::size_t l = 0; l < group.lanes.size(); ++l) {
    const std::size_t member = members[group.lanes[l]];
    const auto& job = jobs[member];
    auto& result = results[member];
    if (group.full == nullptr) continue;
    result.matrix.value = scaled(group.result, l, job.kappa);
    const double size = result.matrix.value.mantissa.cwiseAbs().maxCoeff();
    const double radians = std::sqrt(job.w.bound()) * (job.piece.to - job.piece.from);
    result.matrix.error =
        Eigen::Matrix2d::Constant(size * (group.full->rounding() + job.coefficient_error * radians));
    result.matrix.normalise();
    result.check = result.matrix.value;
    result.cost = {
        .steps = group.plan.steps, .rejections = 0, .right_hand_sides = group.full->evaluations()};
    if (group.half == nullptr) continue;
    result.check = scaled(group.check, l, job.kappa);
    result.check.normalise();
    result.truncation_share = halving_share(group.plan.order);
    result.check_cost = {
        .steps = group.plan.steps / 2, .rejections = 0, .right_hand_sides = group.half->evaluations()};
  }
}

}  // namespace

HillFamily& SplittingPropagators::family(const Key& key) {
  const auto found = families_.find(key);
  if (found != families_.end()) return found->second;
  if (families_.size() >= kMostFamilies) families_.clear();
  std::vector<PeriodicFunction> basis;
  for (const int name : key.harmonics) {
    basis.push_back(
        PeriodicFunction::fourier(0.0, {{std::abs(name), name > 0 ? 1.0 : 0.0, name > 0 ? 0.0 : 1.0}}));
  }
  return families_.try_emplace(key, std::move(basis), key.from, key.to, key.tolerance).first->second;
}

std::vector<SplittingPropagation> SplittingPropagators::propagate(std::span<const SplittingJob> jobs,
                                                                  double tolerance, bool with_check) {
  std::vector<SplittingPropagation> results(jobs.size());
  std::map<Key, std::vector<std::size_t>> groups;
  Key key{.from = 0.0, .to = 0.0, .tolerance = tolerance, .harmonics = {}};
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    key.from = jobs[i].piece.from;
    key.to = jobs[i].piece.to;
    key.harmonics.clear();
    for_each_term(jobs[i].w, [&](int name, double) { key.harmonics.push_back(name); });
    groups[key].push_back(i);
  }
  for (const auto& [common, members] : groups) {
    const Lanes lanes(jobs, members, common.harmonics.size());
    family(common).propagate(lanes.batch(), with_check,
                             [&](const HillGroup& group) { unpack(group, jobs, members, results); });
  }
  return results;
}

}  // namespace strutt
