#include "floquet/series_propagators.hpp"

#include <cmath>
#include <cstdlib>

#include "base/constants.hpp"

namespace strutt {
namespace {

constexpr std::size_t kMostFamilies = 64;

/// Calls visit(name, weight) for each term of W besides its mean, named as in SeriesPropagators::Key.
template <typename Visit>
void for_each_term(const PeriodicFunction& w, const Visit& visit) {
  for (const auto& h : w.harmonics()) {
    if (h.cosine != 0.0) visit(h.order, h.cosine);
    if (h.sine != 0.0) visit(-h.order, h.sine);
  }
}

/// The coefficients of the members, in arrays.
struct Lanes {
  std::vector<double> mean, weights;

  Lanes(std::span<const SeriesJob> jobs, std::span<const std::size_t> members, std::size_t functions)
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
void unpack(const HillGroup& group, std::span<const SeriesJob> jobs, std::span<const std::size_t> members,
            std::vector<SeriesPropagation>& results) {
  if (group.plan.steps == 0) return;
  const auto& r = group.result;
  for (std::size_t l = 0; l < group.lanes.size(); ++l) {
    const std::size_t member = members[group.lanes[l]];
    const auto& job = jobs[member];
    const double kappa = job.kappa;
    auto& [matrix, cost] = results[member];
    matrix.value = {Eigen::Matrix2d{{r.u1[l], kappa * r.u2[l]}, {r.du1[l] / kappa, r.du2[l]}}, r.exponent[l]};
    matrix.error =
        Eigen::Matrix2d{{r.u1_error[l], kappa * r.u2_error[l]}, {r.du1_error[l] / kappa, r.du2_error[l]}};
    const double size = matrix.value.mantissa.cwiseAbs().maxCoeff();
    const double radians = std::sqrt(job.w.bound()) * (job.piece.to - job.piece.from);
    matrix.error.array() +=
        size *
        (kUnit + (job.coefficient_error + HillSeries::evaluation_error(job.w.highest_order())) * radians);
    matrix.normalise();
    cost = {.steps = group.plan.steps,
            .rejections = 0,
            .right_hand_sides = static_cast<long>(group.plan.steps) * group.plan.terms};
  }
}

}  // namespace

HillFamily& SeriesPropagators::family(const Key& key) {
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

std::vector<SeriesPropagation> SeriesPropagators::propagate(std::span<const SeriesJob> jobs,
                                                            double tolerance) {
  std::vector<SeriesPropagation> results(jobs.size());
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
    family(common).propagate(lanes.batch(),
                             [&](const HillGroup& group) { unpack(group, jobs, members, results); });
  }
  return results;
}

}  // namespace strutt
