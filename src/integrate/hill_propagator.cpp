#include "strutt/integrate/hill_propagator.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "integrate/hill_kernel.hpp"
#include "integrate/splitting.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;
// Beyond these products of step and frequency, of the solution and of the coefficient, the error of half the
// steps says nothing of that of all.
constexpr double kLargestStep = 0.7;
constexpr double kLargestWaveStep = 0.45;
constexpr double kShareOfOrder = 0.7;
constexpr double kHalvingSafety = 16.0;

/// Few numbers of steps, all even, so that many cells share a table: four an octave.
std::vector<int> step_ladder() {
  std::vector<int> result;
  for (int octave = 8; octave <= kMostHillSteps; octave *= 2) {
    for (const int quarters : {4, 5, 6, 7}) {
      const int steps = octave * quarters / 4;
      if (steps <= kMostHillSteps) result.push_back(steps);
    }
  }
  return result;
}

/// The largest bound B of |W| that steps of length h serve.
double largest_bound(double h, double k, double length, int order, double tolerance) {
  if (h * k > kShareOfOrder * kLargestWaveStep) return -1.0;
  const double allowed = tolerance / (detail::splitting(order).error_constant * std::pow(h, order) * length);
  const double root = kLargestStep / h;  // of the largest B whatever the tolerance
  double low = 0.0, high = root;         // of sqrt B, by bisection: the error grows with it
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (middle * middle * std::pow(middle + k, order - 1) <= allowed ? low : high) = middle;
  }
  return low * low;
}

}  // namespace

HillStepPlanner::HillStepPlanner(int highest_order, double length, double tolerance) {
  struct Row {
    HillStepPlan plan;
    double cost, limit;
  };
  const double k = kShareOfOrder * highest_order;
  std::vector<Row> rows;
  for (const int steps : step_ladder()) {
    for (const int order : {6, 4}) {
      const auto stages = static_cast<double>(detail::splitting(order).drifts.size());
      rows.push_back({{order, steps}, steps * stages, largest_bound(length / steps, k, length, order, tolerance)});
    }
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.cost < b.cost; });
  for (const auto& row : rows) {
    if (row.limit < 0.0 || (!limits_.empty() && row.limit <= limits_.back())) continue;
    limits_.push_back(row.limit);
    plans_.push_back(row.plan);
  }
}

HillStepPlan HillStepPlanner::plan(double bound) const {
  const auto found = std::lower_bound(limits_.begin(), limits_.end(), bound) - limits_.begin();
  if (found == static_cast<std::ptrdiff_t>(limits_.size())) return {};
  return plans_[static_cast<std::size_t>(found)];
}

double halving_share(int order) { return kHalvingSafety / (std::exp2(order) - 1.0); }

HillPropagator::HillPropagator(const HillStepPlan& plan, std::span<const PeriodicFunction> basis, double from,
                               double to)
    : functions_(static_cast<int>(basis.size())) {
  require(plan.steps >= 1, "steps", plan.steps, "at least 1");
  const auto& scheme = detail::splitting(plan.order);
  const double h = (to - from) / plan.steps;
  for (int step = 0; step < plan.steps; ++step) {
    double share = 0.0;  // of the step that the drifts have covered
    for (std::size_t i = 0; i < scheme.kicks.size(); ++i) {
      // The last kick of a step and the first of the next are one.
      const bool joined = i == 0 && step > 0;
      const double b = joined ? 2.0 * scheme.kicks[0] : scheme.kicks[i];
      const bool replaced = i + 1 == scheme.kicks.size() && step + 1 < plan.steps;
      if (replaced) continue;
      const double theta = from + (to - from) * ((step + share) / plan.steps);
      kick_.push_back(b * h);
      for (const auto& f : basis) basis_.push_back(b * h * f(theta));
      if (i < scheme.drifts.size()) {
        drift_.push_back(scheme.drifts[i] * h);
        share += scheme.drifts[i];
      }
    }
  }
}

void HillPropagator::propagate(const HillBatch& batch, HillPropagators& result) const {
  if (batch.weights.size() != static_cast<std::size_t>(functions_)) {
    throw InvalidInput("weights", std::to_string(batch.weights.size()),
                       "as many as there are basis functions");
  }
  std::vector<const double*> weights;
  for (const auto& w : batch.weights) {
    if (w.size() != batch.mean.size()) {
      throw InvalidInput("weights", std::to_string(w.size()), "as long as the means");
    }
    weights.push_back(w.data());
  }
  const std::size_t lanes = batch.mean.size();
  for (auto* entry : {&result.u1, &result.du1, &result.u2, &result.du2}) entry->resize(lanes);
  result.exponent.resize(lanes);
  detail::sweep({.drift = drift_.data(),
                 .kick = kick_.data(),
                 .basis = basis_.data(),
                 .stages = drift_.size(),
                 .functions = functions_,
                 .mean = batch.mean.data(),
                 .weights = weights.data(),
                 .u1 = result.u1.data(),
                 .du1 = result.du1.data(),
                 .u2 = result.u2.data(),
                 .du2 = result.du2.data(),
                 .exponent = result.exponent.data(),
                 .lanes = lanes});
}

double HillPropagator::rounding() const {
  return kUnit * (4.0 + 4.0 * std::sqrt(2.0 * static_cast<double>(drift_.size())));
}

}  // namespace strutt
