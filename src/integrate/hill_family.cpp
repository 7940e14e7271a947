#include "strutt/integrate/hill_family.hpp"

#include <algorithm>

#include "integrate/series_plan.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr std::size_t kChunk =
    8192;  // lanes that are sorted at a time: they stay in the second level of the cache,
constexpr std::size_t kGroup =
    512;  // and those that are integrated at a time, with their results, in the first
constexpr long kMostStoredTerms = 1L << 22;  // 32 MB of tables

}  // namespace

struct HillFamily::Workspace {
  std::vector<PeriodicFunction> basis;
  double from, to;
  detail::SeriesPlanner planner;
  std::vector<std::unique_ptr<HillSeries>> series;  // one per plan
  long stored_terms = 0;
  std::vector<std::int64_t> classes;
  // Of a chunk, sorted by plan: places in the batch, tails, means, and weights, kChunk of each function.
  // Lanes of plan i are begin[i] ... begin[i + 1] - 1, in order; those without a plan come last.
  std::vector<std::uint32_t> lanes, begin;
  std::vector<double> tails, mean, weights;
  HillPropagators result;

  Workspace(std::vector<PeriodicFunction> functions, double start, double end, double tolerance)
      : basis(std::move(functions)),
        from(start),
        to(end),
        planner(basis, start, end, tolerance),
        lanes(kChunk),
        tails(kChunk),
        mean(kChunk),
        weights(kChunk * basis.size()) {}

  /// Counting sort.
  void sort_by_plan(const HillBatch& batch, std::size_t first, std::size_t count) {
    classes.resize(count);
    planner.classify(batch, first, classes);
    for (const auto number : classes) planner.choice(number);
    series.resize(planner.plans().size());
    begin.assign(series.size() + 2, 0);
    for (const auto number : classes) ++begin[place_of(number) + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    auto next = begin;
    for (std::size_t l = 0; l < count; ++l) {
      const std::size_t place = next[place_of(classes[l])]++;
      lanes[place] = static_cast<std::uint32_t>(first + l);
      tails[place] = planner.choice(classes[l]).tail;
      mean[place] = batch.mean[first + l];
      for (std::size_t f = 0; f < basis.size(); ++f)
        weights[f * kChunk + place] = batch.weights[f][first + l];
    }
  }

  /// Of the plan of a class among all groups.
  std::size_t place_of(std::int64_t number) {
    const int plan = planner.choice(number).plan;
    return plan < 0 ? series.size() : static_cast<std::size_t>(plan);
  }

  const HillSeries& series_of(std::size_t number) {
    auto& made = series[number];
    if (made) return *made;
    const auto& chosen = planner.plans()[number];
    const long terms =
        static_cast<long>(chosen.steps + 1) * chosen.terms * static_cast<long>(basis.size() + 1);
    if (stored_terms + terms > kMostStoredTerms) {
      for (auto& old : series) old.reset();
      stored_terms = 0;
    }
    stored_terms += terms;
    made = std::make_unique<HillSeries>(chosen, basis, from, to);
    return *made;
  }

  void integrate(std::size_t number, HillGroup& group) {
    group.plan = planner.plans()[number];
    series_of(number).propagate(group.batch, group.tails, result);
  }

  /// Lanes that were sorted to the places from `first` on.
  HillGroup group(std::size_t first, std::size_t count) const {
    HillBatch batch{std::span(mean).subspan(first, count), {}};
    for (std::size_t f = 0; f < basis.size(); ++f)
      batch.weights.push_back(std::span(weights).subspan(f * kChunk + first, count));
    return {std::span(lanes).subspan(first, count),
            std::move(batch),
            {},
            std::span(tails).subspan(first, count),
            result};
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
  for (std::size_t first = 0; first < batch.mean.size(); first += kChunk) {
    own.sort_by_plan(batch, first, std::min(kChunk, batch.mean.size() - first));
    for (std::size_t plan = 0; plan + 1 < own.begin.size(); ++plan) {
      for (std::size_t place = own.begin[plan]; place < own.begin[plan + 1]; place += kGroup) {
        auto group = own.group(place, std::min<std::size_t>(kGroup, own.begin[plan + 1] - place));
        if (plan < own.series.size()) own.integrate(plan, group);
        receive(group);
      }
    }
  }
}

}  // namespace strutt
