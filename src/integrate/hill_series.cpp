#include "strutt/integrate/hill_series.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "integrate/series_kernel.hpp"
#include "integrate/series_majorant.hpp"
#include "strutt/base/error.hpp"

namespace strutt {

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
    : plan_(plan), basis_(basis.begin(), basis.end()), from_(from), to_(to) {
  require(plan.steps >= 1 && plan.steps <= kMostHillSteps, "steps", plan.steps, "from 1 to 20000");
  require(plan.terms >= detail::kFewestSeriesTerms && plan.terms <= detail::kMostSeriesTerms, "terms",
          plan.terms, "from 4 to 20");
  const detail::SeriesNodes nodes(from, to, plan.steps);
  const auto terms = static_cast<std::size_t>(plan.terms);
  series_.resize(static_cast<std::size_t>(nodes.count()) * basis.size() * terms);
  std::span<double> rest(series_);
  for (int i = 0; i < nodes.count(); ++i) {
    const auto here = rest.first(basis.size() * terms);
    for (std::size_t f = 0; f < basis.size(); ++f)
      detail::expand(basis[f], nodes.phase(i), nodes.radius(), here.subspan(f * terms, terms));
    parity_.push_back(detail::parity_of(here, terms));
    rest = rest.subspan(here.size());
  }
  for (const auto& f : basis) {
    largest_.push_back(detail::largest_within(f, std::abs(nodes.radius())));
    highest_order_ = std::max(highest_order_, f.highest_order());
  }
}

double HillSeries::tail(double mean, std::span<const double> weights) const {
  require(weights.size() == basis_.size(), "weights", static_cast<double>(weights.size()),
          "one for each function");
  const detail::SeriesNodes nodes(from_, to_, plan_.steps);
  detail::CoefficientBounds sum{nodes.radius() * nodes.radius() * std::abs(mean)};
  for (std::size_t f = 0; f < basis_.size(); ++f) {
    const auto bounds = detail::middle_bounds(nodes, basis_[f]);
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += std::abs(weights[f]) * bounds[j];
  }
  return detail::SeriesMajorant(sum).tail(plan_.terms);
}

void HillSeries::propagate(const HillBatch& batch, std::span<const double> tails,
                           HillPropagators& result) const {
  batch.validate(basis_.size());
  require(tails.size() == batch.mean.size(), "tails", static_cast<double>(tails.size()),
          "as long as the means");
  std::vector<const double*> weights;
  for (const auto& w : batch.weights) weights.push_back(w.data());
  const std::size_t lanes = batch.mean.size();
  for (auto* entry : {&result.u1, &result.u2, &result.du1, &result.du2, &result.u1_error, &result.u2_error,
                      &result.du1_error, &result.du2_error}) {
    entry->resize(lanes);
  }
  result.exponent.resize(lanes);
  detail::sweep({.nodes = static_cast<int>(parity_.size()),
                 .terms = plan_.terms,
                 .functions = static_cast<int>(basis_.size()),
                 .radius = 0.5 * (to_ - from_) / plan_.steps,
                 .span = std::abs(0.5 * (to_ - from_) / plan_.steps) * highest_order_,
                 .series = series_.data(),
                 .parity = parity_.data(),
                 .largest = largest_.data(),
                 .mean = batch.mean.data(),
                 .weights = weights.data(),
                 .tail = tails.data(),
                 .entry = {result.u1.data(), result.u2.data(), result.du1.data(), result.du2.data()},
                 .error = {result.u1_error.data(), result.u2_error.data(), result.du1_error.data(),
                           result.du2_error.data()},
                 .exponent = result.exponent.data(),
                 .lanes = lanes});
}

}  // namespace strutt
