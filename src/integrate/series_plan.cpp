#include "integrate/series_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "integrate/darboux.hpp"

namespace strutt::detail {
namespace {

constexpr double kTailShare = 0.05;    // of the tolerance: what becomes of a tail on its way, found by trial
constexpr double kGreatestStep = 7.0;  // r sqrt|W|; more is never cheaper
constexpr double kSmallestStep = 1.2;  // less does not reduce rounding much
constexpr int kMostCountedSteps = 16;  // whose nodes are looked at one by one
constexpr double kPatience = 1.25;     // costs rise again once they are so much above the least

std::vector<int> step_ladder() {
  std::vector<int> result{1, 2, 3, 4, 5, 6, 7};
  for (int octave = 8; octave <= kMostHillSteps; octave *= 2) {
    for (const int eighths : {8, 9, 10, 11, 12, 13, 14, 15}) {
      if (octave * eighths / 8 <= kMostHillSteps) result.push_back(octave * eighths / 8);
    }
  }
  return result;
}

const std::vector<int>& ladder() {
  static const std::vector<int> steps = step_ladder();
  return steps;
}

/// How much of its size a function varies by the time it has left the real axis by 1.
double variability(const PeriodicFunction& f) { return largest_within(f, 1.0) / largest_within(f, 0.0); }

/// kMostSeriesTerms + 1: none. `growth`: the kernel's bound of what is lost in the middle of a step, by
/// darboux_loss.
int fewest_terms(const SeriesMajorant& majorant, double growth, double allowed) {
  int low = kFewestSeriesTerms, high = kMostSeriesTerms + 1;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (majorant.tail(middle) * (1.0 + darboux_loss(middle) * growth) <= allowed) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

}  // namespace

/// Operations on a register of lanes, by what they took.
double SeriesPlanner::Rung::cost(int terms) const {
  const double k = terms;
  const auto [even, odd, neither] = kinds;
  return even * (0.18 * k * k + 3.4 * k + 40.0) + odd * (0.4 * k * k + 6.3 * k + 90.0) +
         neither * (0.85 * k * k + 7.0 * k + 90.0) + 60.0;
}

SeriesPlanner::SeriesPlanner(std::span<const PeriodicFunction> basis, double from, double to,
                             double tolerance)
    : basis_(basis.begin(), basis.end()),
      from_(from),
      to_(to),
      tolerance_(tolerance),
      rungs_(ladder().size()),
      choices_(static_cast<std::size_t>(kClassRows) << kColumnBits, Choice{.plan = kUnmade}) {
  double most = 0.0;  // of those that share the last column
  const int count = static_cast<int>(basis_.size());
  for (int f = kMostColumns - 1; f < count; ++f)
    most = std::max(most, variability(basis_[static_cast<std::size_t>(f)]));
  for (int f = 0; f < count; ++f) {
    const auto& function = basis_[static_cast<std::size_t>(f)];
    column_.push_back(std::min(f, kMostColumns - 1));
    largest_.push_back(largest_within(function, 0.0));
    share_.push_back(f < kMostColumns - 1 ? largest_.back() : largest_.back() * variability(function) / most);
  }
  columns_ = std::min(count, kMostColumns);
}

const SeriesPlanner::Rung& SeriesPlanner::rung(std::size_t place) {
  auto& made = rungs_[place];
  if (made) return *made;
  const SeriesNodes nodes(from_, to_, ladder()[place]);
  made = Rung{.steps = ladder()[place], .radius = nodes.radius(), .growth = 1.0, .kinds = {}, .bounds = {}};
  made->bounds.resize(static_cast<std::size_t>(columns_));
  for (std::size_t f = 0; f < basis_.size(); ++f) {
    made->growth = std::max(made->growth, largest_within(basis_[f], nodes.radius()) / largest_[f]);
    const auto own = middle_bounds(nodes, basis_[f]);
    auto& bounds = made->bounds[static_cast<std::size_t>(column_[f])];
    for (std::size_t j = 0; j < own.size(); ++j) bounds[j] = std::max(bounds[j], own[j] / share_[f]);
  }
  count_kinds(*made, nodes);
  return *made;
}

void SeriesPlanner::count_kinds(Rung& rung, const SeriesNodes& nodes) const {
  constexpr std::size_t kTerms = 4;  // tell all
  std::vector<double> series(basis_.size() * kTerms);
  for (int i = 0; i < nodes.count(); ++i) {
    if (nodes.steps() > kMostCountedSteps && i > 0 && i < nodes.steps()) continue;
    for (std::size_t f = 0; f < basis_.size(); ++f)
      expand(basis_[f], nodes.phase(i), rung.radius, std::span(series).subspan(f * kTerms, kTerms));
    ++rung.kinds[static_cast<std::size_t>(parity_of(series, kTerms))];
  }
  rung.kinds[static_cast<std::size_t>(Parity::neither)] +=
      nodes.count() - rung.kinds[0] - rung.kinds[1] - rung.kinds[2];
}

SeriesPlanner::Corner SeriesPlanner::corner(std::int64_t number) const {
  const auto row = number >> (kColumnBits * columns_);
  const double octave = std::exp2(static_cast<double>((row + 1) / kShares) + kSmallestOctave);
  const double unit = std::exp2(static_cast<double>(row / kShares) + kSmallestOctave) / kShares;
  Corner result;
  result.size = result.mean = octave * (1.0 + static_cast<double>((row + 1) % kShares) / kShares);
  for (int c = 0; c < columns_; ++c) {
    const auto column = (number >> (kColumnBits * (columns_ - 1 - c))) & ((1 << kColumnBits) - 1);
    result.varying.push_back(std::min(result.size, unit * static_cast<double>(column + 1)));
    result.mean -= unit * static_cast<double>(column);
  }
  result.mean = std::max(result.mean, 0.0);
  return result;
}

double SeriesPlanner::allowed_tail(const Rung& rung, const Corner& equation) const {
  const double phase = rung.radius * std::sqrt(equation.size);
  return kTailShare * tolerance_ * std::min(1.0, std::max(rung.radius, phase)) / rung.steps;
}

double SeriesPlanner::growth(const Rung& rung, const Corner& equation) const {
  const double square = rung.radius * rung.radius * equation.size * rung.growth;
  return square * std::cosh(std::sqrt(square)) * (1.0 + 0.5 * std::max(1.0, square));
}

bool SeriesPlanner::too_much_rounding(const Rung& rung, const Corner& equation) const {
  const double square = rung.radius * rung.radius * equation.size * rung.growth, g = std::sqrt(square);
  return g > kSmallestStep && (6.0 + square) * std::cosh(g) * 10.0 * 0x1p-53 * rung.steps > tolerance_;
}

SeriesMajorant SeriesPlanner::majorant(const Rung& rung, const Corner& equation) const {
  CoefficientBounds v{rung.radius * rung.radius * equation.mean};
  for (std::size_t c = 0; c < equation.varying.size(); ++c)
    for (std::size_t j = 0; j < v.size(); ++j) v[j] += rung.bounds[c][j] * equation.varying[c];
  return SeriesMajorant(v);
}

SeriesPlanner::Choice SeriesPlanner::cheapest(std::int64_t number) {
  if (number >> (kColumnBits * columns_) >= kClassRows - 1) return {};
  const Corner equation = corner(number);
  HillSeriesPlan best;
  double tail = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t place = 0; place < ladder().size(); ++place) {
    const double length = 0.5 * (to_ - from_) / ladder()[place];
    if (length * std::sqrt(equation.size) > kGreatestStep) continue;
    const Rung& here = rung(place);
    if (here.cost(std::max(kFewestSeriesTerms, best.terms / 2)) >= least) break;
    if (too_much_rounding(here, equation)) continue;
    const auto series = majorant(here, equation);
    const int terms = fewest_terms(series, growth(here, equation), allowed_tail(here, equation));
    if (terms > kMostSeriesTerms) continue;
    const double cost = here.cost(terms);
    if (cost > kPatience * least) break;
    if (cost >= least) continue;
    least = cost;
    best = {here.steps, terms};
    tail = series.tail(terms);
  }
  return best.steps > 0 ? Choice{number_of(best), tail} : Choice{};
}

int SeriesPlanner::number_of(const HillSeriesPlan& plan) {
  const auto same = [&plan](const HillSeriesPlan& other) {
    return other.steps == plan.steps && other.terms == plan.terms;
  };
  const auto found = std::ranges::find_if(plans_, same);
  const auto number = static_cast<int>(found - plans_.begin());
  if (found == plans_.end()) plans_.push_back(plan);
  return number;
}

void SeriesPlanner::classify(const HillBatch& batch, std::size_t first,
                             std::span<std::int64_t> classes) const {
  std::vector<const double*> weights;
  for (const auto& w : batch.weights) weights.push_back(w.data() + first);
  detail::classify({.functions = static_cast<int>(basis_.size()),
                    .columns = columns_,
                    .largest = largest_.data(),
                    .share = share_.data(),
                    .column = column_.data(),
                    .mean = batch.mean.data() + first,
                    .weights = weights.data(),
                    .number = classes.data(),
                    .lanes = classes.size()});
}

}  // namespace strutt::detail
