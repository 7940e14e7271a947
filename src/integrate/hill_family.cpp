#include "strutt/integrate/hill_family.hpp"

#include <algorithm>
#include <numeric>

#include "integrate/series_plan.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

// Lanes that are sorted at a time, which stay in the second level of the cache, and lanes that are integrated
// at a time, which stay in the first with their results.
constexpr std::size_t kChunk = 16384, kGroup = 512;
constexpr long kMostStoredTerms = 1L << 22;  // 32 MB of tables

}  // namespace

struct HillFamily::Workspace {
  std::vector<PeriodicFunction> basis;
  double from, to;
  detail::SeriesPlanner planner;
  std::vector<std::unique_ptr<HillSeries>> series;  // one per plan
  long stored_terms = 0;
  // Of a chunk: class, plan (counted from 1; 0: none), tail and place of each lane,
  std::vector<std::int64_t> classes;
  std::vector<std::uint32_t> plan, place;
  std::vector<double> tail;
  // and sorted by plan: places in the batch, tails, means, and weights, function by function. Lanes of plan i
  // are begin[i] ... begin[i + 1] - 1, in order.
  std::vector<std::uint32_t> lanes, begin;
  std::vector<double> tails, mean, weights;
  HillPropagators result;

  Workspace(std::vector<PeriodicFunction> functions, double start, double end, double tolerance)
      : basis(std::move(functions)), from(start), to(end), planner(basis, start, end, tolerance) {}

  void choose_plans(const HillBatch& batch, std::size_t first, std::size_t count) {
    classes.resize(count);
    plan.resize(count);
    tail.resize(count);
    planner.classify(batch, first, classes);
    for (std::size_t l = 0; l < count; ++l) {
      const auto& choice = planner.choice(classes[l]);
      plan[l] = static_cast<std::uint32_t>(choice.plan + 1);  // 0: none
      tail[l] = choice.tail;
    }
    series.resize(planner.plans().size());
  }

  /// Counting sort.
  void sort_by_plan(const HillBatch& batch, std::size_t first, std::size_t count) {
    choose_plans(batch, first, count);
    begin.assign(series.size() + 2, 0);
    for (const auto p : plan) ++begin[p + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    place.resize(count);
    lanes.resize(count);
    auto next = begin;
    for (std::size_t l = 0; l < count; ++l) {
      place[l] = next[plan[l]]++;
      lanes[place[l]] = static_cast<std::uint32_t>(first + l);
    }
    tails.resize(count);
    mean.resize(count);
    weights.resize(count * basis.size());
    move_to_place(tail, tails.data());
    move_to_place(batch.mean.subspan(first), mean.data());
    for (std::size_t f = 0; f < basis.size(); ++f)
      move_to_place(batch.weights[f].subspan(first), weights.data() + f * count);
  }

  void move_to_place(std::span<const double> values, double* sorted) const {
    for (std::size_t l = 0; l < place.size(); ++l) sorted[place[l]] = values[l];
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
      batch.weights.push_back(std::span(weights).subspan(f * mean.size() + first, count));
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
        if (plan > 0) own.integrate(plan - 1, group);
        receive(group);
      }
    }
  }
}

}  // namespace strutt
