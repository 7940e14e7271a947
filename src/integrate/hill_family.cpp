#include "strutt/integrate/hill_family.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr std::size_t kChunk = 2048;  // lanes: what belongs to them stays in the second level of the cache

constexpr long kMostStoredSteps = 200'000;  // some 100 MB of tables

int highest_order_of(const std::vector<PeriodicFunction>& basis) {
  int highest = 0;
  for (const auto& f : basis) highest = std::max(highest, f.highest_order());
  return highest;
}

}  // namespace

HillFamily::HillFamily(std::vector<PeriodicFunction> basis, double from, double to, double tolerance)
    : basis_(std::move(basis)),
      from_(from),
      to_(to),
      planner_(highest_order_of(basis_), to - from, tolerance),
      tables_(planner_.plans().size()) {
  require(to > from, "to", to, "above from");
  require(tolerance > 0.0, "tolerance", tolerance, "positive");
}

/// Counting sort: lanes of plan i are sorted_[begin_[i]] ... sorted_[begin_[i + 1] - 1], in order; those without
/// a plan come last.
void HillFamily::sort_by_plan(const HillBatch& batch, std::size_t first, std::size_t count) {
  plan_.resize(count);
  mean_.resize(count);
  for (std::size_t l = 0; l < count; ++l) mean_[l] = std::abs(batch.mean[first + l]);
  for (std::size_t j = 0; j < basis_.size(); ++j) {
    const double size = basis_[j].bound();
    for (std::size_t l = 0; l < count; ++l) mean_[l] += size * std::abs(batch.weights[j][first + l]);
  }
  planner_.choose(mean_, plan_);
  begin_.assign(tables_.size() + 2, 0);
  for (const auto plan : plan_) ++begin_[plan + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  sorted_.resize(count);
  auto place = begin_;
  for (std::size_t l = 0; l < count; ++l) sorted_[place[plan_[l]]++] = static_cast<std::uint32_t>(first + l);
}

const HillFamily::Tables& HillFamily::tables_of(std::size_t plan, bool with_check) {
  auto& [full, half] = tables_[plan];
  if (full && (half || !with_check)) return tables_[plan];
  const auto [order, steps] = planner_.plans()[plan];
  if (stored_steps_ + steps > kMostStoredSteps) {
    for (auto& tables : tables_) tables = {};
    stored_steps_ = 0;
  }
  if (!full) full = std::make_unique<HillPropagator>(HillStepPlan{order, steps}, basis_, from_, to_);
  if (with_check && !half) {
    half = std::make_unique<HillPropagator>(HillStepPlan{order, steps / 2}, basis_, from_, to_);
  }
  stored_steps_ += steps;
  return tables_[plan];
}

void HillFamily::run(const HillBatch& batch, std::size_t plan, std::span<const std::uint32_t> lanes,
                     bool with_check, const std::function<void(const HillGroup&)>& receive) {
  const std::size_t count = lanes.size();
  mean_.resize(count);
  weights_.resize(count * basis_.size());
  HillBatch own{std::span(mean_).first(count), {}};
  for (std::size_t l = 0; l < count; ++l) mean_[l] = batch.mean[lanes[l]];
  for (std::size_t j = 0; j < basis_.size(); ++j) {
    double* const weights = weights_.data() + j * count;
    for (std::size_t l = 0; l < count; ++l) weights[l] = batch.weights[j][lanes[l]];
    own.weights.emplace_back(weights, count);
  }
  HillGroup group{.lanes = lanes, .batch = std::move(own), .plan = {}, .result = result_, .check = check_};
  if (plan < tables_.size()) {
    group.plan = planner_.plans()[plan];
    const Tables& tables = tables_of(plan, with_check);
    tables.full->propagate(group.batch, result_);
    group.full = tables.full.get();
    if (with_check) {
      tables.half->propagate(group.batch, check_);
      group.half = tables.half.get();
    }
  }
  receive(group);
}

void HillFamily::propagate(const HillBatch& batch, bool with_check,
                           const std::function<void(const HillGroup&)>& receive) {
  batch.validate(basis_.size());
  for (std::size_t first = 0; first < batch.mean.size(); first += kChunk) {
    sort_by_plan(batch, first, std::min(kChunk, batch.mean.size() - first));
    for (std::size_t plan = 0; plan <= tables_.size(); ++plan) {
      const std::size_t begin = begin_[plan], end = begin_[plan + 1];
      if (begin < end) run(batch, plan, std::span(sorted_).subspan(begin, end - begin), with_check, receive);
    }
  }
}

}  // namespace strutt
