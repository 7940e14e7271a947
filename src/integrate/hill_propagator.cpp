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
constexpr double kLargestWaveStep = 1.2;
constexpr double kShareOfOrder = 0.7;
constexpr int kMidpoints = 16;  // of the integral in the error formula, per harmonic
constexpr double kHalvingSafety = 16.0;

/// The steps are rounded up to a few values per octave, so that many cells share a table.
int rounded_up(double steps) {
  for (int octave = 16;; octave *= 2) {
    for (const int eighths : {4, 5, 6, 7, 8}) {
      const int candidate = octave * eighths / 8;
      if (candidate % 2 == 0 && candidate >= steps) return candidate;
    }
  }
}

/// |W| at the middles of equal parts of the piece.
std::vector<double> sampled_size(const PeriodicFunction& w, double from, double to) {
  const int points = w.is_constant() ? 1 : kMidpoints * w.highest_order();
  std::vector<double> size;
  for (int j = 0; j < points; ++j) size.push_back(std::abs(w(std::lerp(from, to, (j + 0.5) / points))));
  return size;
}

/// Integral of |W| (sqrt|W| + k)^(p-1), by the midpoint rule.
double error_integral(const std::vector<double>& size, double k, double length, int order) {
  double sum = 0.0;
  for (const double value : size) {
    const double base = std::sqrt(value) + k;
    double term = value;
    for (int i = 1; i < order; ++i) term *= base;
    sum += term;
  }
  return sum * length / static_cast<double>(size.size());
}

std::size_t stages_of(const HillStepPlan& plan) {
  return static_cast<std::size_t>(plan.steps) * detail::splitting(plan.order).drifts.size();
}

}  // namespace

HillStepPlan plan_hill_steps(const PeriodicFunction& w, double from, double to, double tolerance) {
  const auto size = sampled_size(w, from, to);
  const double k = kShareOfOrder * w.highest_order(), length = to - from;
  const double largest = std::min(kLargestStep / std::sqrt(std::max(w.bound(), 1e-300)),
                                  kLargestWaveStep / std::max(w.highest_order(), 1));
  HillStepPlan best;
  for (const int order : {6, 4}) {
    const double scale = detail::splitting(order).error_constant * error_integral(size, k, length, order);
    const double steps = length / std::min(std::pow(tolerance / scale, 1.0 / order), largest);
    const HillStepPlan plan{order, steps <= kMostHillSteps ? rounded_up(steps) : 0};
    if (plan.steps > 0 && (best.steps == 0 || stages_of(plan) < stages_of(best))) best = plan;
  }
  return best;
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
