#include "integrate/series_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "integrate/series_kernel.hpp"

namespace strutt::detail {
namespace {

constexpr std::array kTerms{8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32, 36, 40, 44, 48};
constexpr std::array kRatios{1.3, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 13.0, 17.0, 22.0};
// Cauchy's inequality, and what becomes of an error on its way, are by so much too careful; found by trial.
// What was reached is known from the terms themselves.
constexpr double kCare = 300.0;
constexpr double kThinning = 1.06;     // a plan is left out where another serves as much for so much more
constexpr double kLargestWave = 40.0;  // cosh of more is beyond any use

std::vector<int> step_ladder() {
  std::vector<int> result{1, 2, 3, 4, 5, 6, 7};
  for (int octave = 8; octave <= kMostHillSteps; octave *= 2) {
    for (const int eighths : {8, 9, 10, 11, 12, 13, 14, 15}) {
      if (octave * eighths / 8 <= kMostHillSteps) result.push_back(octave * eighths / 8);
    }
  }
  return result;
}

/// The largest g = r sqrt|W| whose rounding, (6 + g^2) cosh(g) units a step, stays below the tolerance; at
/// least kSmallestStep, since more steps would not help much.
double largest_step(double tolerance, int steps) {
  constexpr double kSmallestStep = 1.2, kGreatestStep = 4.0, kUnits = 10.0 * 0x1p-53;
  double g = kGreatestStep;
  while (g > kSmallestStep && (6.0 + g * g) * std::cosh(g) * kUnits * steps > tolerance) g -= 0.1;
  return g;
}

struct Row {
  HillSeriesPlan plan;
  double cost = 0.0;
  std::vector<double> shares;
};

/// Multiply-adds a lane.
double cost_of(const HillSeriesPlan& plan, std::size_t functions) {
  const double terms = plan.terms;
  return plan.steps * (terms * terms + terms * (6.0 + static_cast<double>(functions)) + 120.0);
}

bool serves_all_of(const Row& row, const Row& other) {
  for (std::size_t i = 0; i < row.shares.size(); ++i) {
    if (row.shares[i] > other.shares[i]) return false;
  }
  return true;
}

}  // namespace

double largest_within(const PeriodicFunction& f, double distance) {
  double sum = std::abs(f.mean());
  for (const auto& h : f.harmonics()) sum += std::hypot(h.cosine, h.sine) * std::cosh(h.order * distance);
  return sum;
}

SeriesPlanner::SeriesPlanner(std::span<const PeriodicFunction> basis, double length, double tolerance)
    : functions_(basis.size()) {
  int highest = 0;
  for (const auto& f : basis) highest = std::max(highest, f.highest_order());
  std::vector<Row> rows;
  for (const int steps : step_ladder()) {
    const double r = 0.5 * length / steps;
    for (const double rho : kRatios) {
      if (highest * rho * r > kLargestWave) break;
      std::vector<double> largest;
      for (const auto& f : basis) largest.push_back(largest_within(f, rho * r));
      for (const int terms : kTerms) {
        const double rest = (1.0 - 1.0 / rho) * (1.0 - 1.0 / rho);
        const double allowed = kCare * tolerance * std::min(r, 1.0) * rest * std::pow(rho, terms - 1) /
                               (8.0 * terms * std::sqrt(steps));
        if (!(allowed > 1.0)) continue;
        const double g = std::min(std::acosh(allowed) / rho, largest_step(tolerance, steps));
        const double limit = (g / r) * (g / r);
        Row row{{steps, terms}, 0.0, {1.0 / limit}};
        for (const double size : largest) row.shares.push_back(size / limit);
        row.cost = cost_of(row.plan, functions_);
        rows.push_back(std::move(row));
      }
    }
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.cost < b.cost; });
  std::vector<Row> kept;
  for (auto& row : rows) {
    const auto serves = [&](const Row& better) { return serves_all_of(better, row); };
    if (std::none_of(kept.rbegin(), kept.rend(), serves)) kept.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    bool needed = true;
    for (std::size_t j = i + 1; j < kept.size() && needed && kept[j].cost <= kThinning * kept[i].cost; ++j)
      needed = !serves_all_of(kept[j], kept[i]);
    if (!needed) kept[i].plan.steps = 0;
  }
  std::erase_if(kept, [](const Row& row) { return row.plan.steps == 0; });
  for (const auto& row : kept) {
    plans_.push_back(row.plan);
    shares_.insert(shares_.end(), row.shares.begin(), row.shares.end());
  }
}

void SeriesPlanner::choose(const HillBatch& batch, std::size_t first, std::span<std::int64_t> rows) const {
  std::vector<const double*> weights;
  for (const auto& w : batch.weights) weights.push_back(w.data() + first);
  detail::choose({.shares = shares_.data(),
                  .rows = plans_.size(),
                  .functions = static_cast<int>(functions_),
                  .mean = batch.mean.data() + first,
                  .weights = weights.data(),
                  .row = rows.data(),
                  .lanes = rows.size()});
}

}  // namespace strutt::detail
