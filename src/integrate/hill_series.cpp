#include "strutt/integrate/hill_series.hpp"

#include <cmath>
#include <string>

#include "integrate/series_kernel.hpp"
#include "integrate/series_plan.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

/// Writes r^(j+2)/j! f^(j)(theta) for all j.
void expand(const PeriodicFunction& f, long double theta, double r, std::span<double> series) {
  for (auto& term : series) term = 0.0;
  series[0] = r * r * f.mean();
  for (const auto& h : f.harmonics()) {
    const long double angle = h.order * theta;
    const auto c = static_cast<double>(std::cos(angle)), s = static_cast<double>(std::sin(angle));
    const double negligible = HillSeries::evaluation_error(h.order) * std::hypot(h.cosine, h.sine);
    double value = h.cosine * c + h.sine * s, slope = h.sine * c - h.cosine * s;
    if (std::abs(value) <= negligible) value = 0.0;
    if (std::abs(slope) <= negligible) slope = 0.0;
    double factor = r * r;
    for (std::size_t j = 0; j < series.size(); ++j) {
      series[j] += factor * (j % 4 < 2 ? 1.0 : -1.0) * (j % 2 == 0 ? value : slope);
      factor *= h.order * r / static_cast<double>(j + 1);
    }
  }
}

}  // namespace

void HillBatch::validate(std::size_t functions) const {
  if (weights.size() != functions) {
    throw InvalidInput("weights", std::to_string(weights.size()), "as many as there are basis functions");
  }
  for (const auto& w : weights) {
    if (w.size() != mean.size()) {
      throw InvalidInput("weights", std::to_string(w.size()), "as long as the means");
    }
  }
}

HillSeries::HillSeries(const HillSeriesPlan& plan, std::span<const PeriodicFunction> basis, double from,
                       double to)
    : plan_(plan), radius_(0.5 * (to - from) / plan.steps), functions_(basis.size()) {
  require(plan.steps >= 1 && plan.steps <= kMostHillSteps, "steps", plan.steps, "from 1 to 20000");
  require(plan.terms >= 6 && plan.terms <= detail::kMostSeriesTerms && plan.terms % 2 == 0, "terms",
          plan.terms, "even, from 6 to 48");
  const auto terms = static_cast<std::size_t>(plan.terms);
  series_.resize(static_cast<std::size_t>(plan.steps) * functions_ * terms);
  std::span<double> rest(series_);
  for (int step = 0; step < plan.steps; ++step) {
    const long double middle = from + (static_cast<long double>(to) - from) * (step + 0.5L) / plan.steps;
    bool odd_only = true;
    for (const auto& f : basis) {
      const auto series = rest.first(terms);
      expand(f, middle, radius_, series);
      for (std::size_t j = 2; j < terms; j += 2) odd_only = odd_only && series[j] == 0.0;
      rest = rest.subspan(terms);
    }
    odd_only_.push_back(odd_only ? 1 : 0);
  }
  for (const auto& f : basis) largest_.push_back(detail::largest_within(f, std::abs(radius_)));
}

void HillSeries::propagate(const HillBatch& batch, HillPropagators& result) const {
  batch.validate(functions_);
  std::vector<const double*> weights;
  for (const auto& w : batch.weights) weights.push_back(w.data());
  const std::size_t lanes = batch.mean.size();
  for (auto* entry : {&result.u1, &result.u2, &result.du1, &result.du2, &result.u1_error, &result.u2_error,
                      &result.du1_error, &result.du2_error}) {
    entry->resize(lanes);
  }
  result.exponent.resize(lanes);
  detail::sweep({.steps = plan_.steps,
                 .terms = plan_.terms,
                 .functions = static_cast<int>(functions_),
                 .radius = radius_,
                 .series = series_.data(),
                 .odd_only = odd_only_.data(),
                 .largest = largest_.data(),
                 .mean = batch.mean.data(),
                 .weights = weights.data(),
                 .entry = {result.u1.data(), result.u2.data(), result.du1.data(), result.du2.data()},
                 .error = {result.u1_error.data(), result.u2_error.data(), result.du1_error.data(),
                           result.du2_error.data()},
                 .exponent = result.exponent.data(),
                 .lanes = lanes});
}

}  // namespace strutt
