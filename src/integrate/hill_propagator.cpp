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
// Below this product of step and frequency the asymptotic error formula holds.
constexpr double kLargestStep = 0.6;

/// The steps are rounded up to a few values per octave, so that many cells share a table.
int rounded_up(double steps) {
  for (int octave = 4;; octave *= 2) {
    for (const int numerator : {8, 9, 10, 11, 12, 13, 14, 15}) {
      const int candidate = octave * numerator / 8;
      if (candidate >= steps) return candidate;
    }
  }
}

HillStepPlan plan_with(const detail::Splitting& scheme, double rho, double length, double tolerance) {
  const double p = scheme.order;
  const double scale = scheme.error_constant * std::pow(rho, p + 1.0) * length;
  const double step = std::min(std::pow(tolerance / scale, 1.0 / p), kLargestStep / rho);
  if (!(length / step <= kMostHillSteps)) return {scheme.order, 0, 0.0};
  const int steps = rounded_up(length / step);
  return {scheme.order, steps, scale * std::pow(length / steps, p)};
}

std::size_t stages_of(const HillStepPlan& plan) {
  return static_cast<std::size_t>(plan.steps) * detail::splitting(plan.order).drifts.size();
}

}  // namespace

HillStepPlan plan_hill_steps(const PeriodicFunction& w, double length, double tolerance) {
  const double order = w.highest_order();
  const double rho = std::sqrt(std::max(w.bound() + order * order, 1e-300));
  const auto fourth = plan_with(detail::splitting(4), rho, length, tolerance);
  const auto sixth = plan_with(detail::splitting(6), rho, length, tolerance);
  return fourth.steps > 0 && stages_of(fourth) < stages_of(sixth) ? fourth : sixth;
}

HillPropagator::HillPropagator(const HillStepPlan& plan, std::span<const PeriodicFunction> basis, double from, double to)
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
    throw InvalidInput("weights", std::to_string(batch.weights.size()), "as many as there are basis functions");
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
  return kUnit * (4.0 + 10.0 * std::sqrt(2.0 * static_cast<double>(drift_.size())));
}

}  // namespace strutt
