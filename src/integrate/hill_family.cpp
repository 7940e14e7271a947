#include "strutt/integrate/hill_family.hpp"

#include <algorithm>

#include "integrate/series_plan.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr std::size_t kChunk = 2048;  // lanes: what belongs to them stays in the second level of the cache
constexpr long kMostStoredTerms = 1L << 22;  // 32 MB of tables

}  // namespace

struct HillFamily::Workspace {
  std::vector<PeriodicFunction> basis;
  double from, to;
  detail::SeriesPlanner planner;
  std::vector<std::unique_ptr<HillSeries>> series;  // one per plan
  long stored_terms = 0;
  std::vector<std::int64_t> plan;
  std::vector<std::uint32_t> sorted, begin;
  std::vector<double> mean, weights;
  HillPropagators result;

  Workspace(std::vector<PeriodicFunction> functions, double start, double end, double tolerance)
      : basis(std::move(functions)),
        from(start),
        to(end),
        planner(basis, end - start, tolerance),
        series(planner.plans().size()) {}

  /// Counting sort: lanes of plan i are sorted[begin[i]] ... sorted[begin[i + 1] - 1], in order; those
  /// without a plan come last.
  void sort_by_plan(const HillBatch& batch, std::size_t first, std::size_t count) {
    plan.resize(count);
    planner.choose(batch, first, plan);
    begin.assign(series.size() + 2, 0);
    for (const auto p : plan) ++begin[static_cast<std::size_t>(p) + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    sorted.resize(count);
    auto place = begin;
    for (std::size_t l = 0; l < count; ++l)
      sorted[place[static_cast<std::size_t>(plan[l])]++] = static_cast<std::uint32_t>(first + l);
  }

  const HillSeries& series_of(std::size_t number) {
    auto& made = series[number];
    if (made) return *made;
    const auto& chosen = planner.plans()[number];
    const long terms = static_cast<long>(chosen.steps) * chosen.terms * static_cast<long>(basis.size() + 1);
    if (stored_terms + terms > kMostStoredTerms) {
      for (auto& old : series) old.reset();
      stored_terms = 0;
    }
    stored_terms += terms;
    made = std::make_unique<HillSeries>(chosen, basis, from, to);
    return *made;
  }

  HillBatch gathered(const HillBatch& batch, std::span<const std::uint32_t> lanes) {
    const std::size_t count = lanes.size();
    mean.resize(count);
    weights.resize(count * basis.size());
    for (std::size_t l = 0; l < count; ++l) mean[l] = batch.mean[lanes[l]];
    HillBatch own{mean, {}};
    for (std::size_t j = 0; j < basis.size(); ++j) {
      double* const to_weights = weights.data() + j * count;
      for (std::size_t l = 0; l < count; ++l) to_weights[l] = batch.weights[j][lanes[l]];
      own.weights.emplace_back(to_weights, count);
    }
    return own;
  }
};

HillFamily::HillFamily(std::vector<PeriodicFunction> basis, double from, double to, double tolerance) {
  require(to > from, "to", to, "above from");
  require(tolerance > 0.0, "tolerance", tolerance, "positive");
  workspace_ = std::make_unique<Workspace>(std::move(basis), from, to, tolerance);
}
HillFamily::~HillFamily() = default;
HillFamily::HillFamily(HillFamily&&) noexcept = default;
HillFamily& HillFamily::operator=(HillFamily&&) noexcept = default;

void HillFamily::propagate(const HillBatch& batch, const std::function<void(const HillGroup&)>& receive) {
  auto& own = *workspace_;
  batch.validate(own.basis.size());
  const std::size_t plans = own.series.size();
  for (std::size_t first = 0; first < batch.mean.size(); first += kChunk) {
    own.sort_by_plan(batch, first, std::min(kChunk, batch.mean.size() - first));
    for (std::size_t plan = 0; plan <= plans; ++plan) {
      const std::size_t begin = own.begin[plan], end = own.begin[plan + 1];
      if (begin == end) continue;
      const auto lanes = std::span(own.sorted).subspan(begin, end - begin);
      HillGroup group{.lanes = lanes, .batch = own.gathered(batch, lanes), .plan = {}, .result = own.result};
      if (plan < plans) {
        group.plan = own.planner.plans()[plan];
        own.series_of(plan).propagate(group.batch, own.result);
      }
      receive(group);
    }
  }
}

}  // namespace strutt
