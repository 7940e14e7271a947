#include "strutt/floquet/hill_discriminants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/constants.hpp"
#include "floquet/discriminant_kernel.hpp"
#include "floquet/propagators.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

// Every lane has its bound looked at, so that the first attempt may use more of the tolerance than where all
// lanes have to do with it.
constexpr double kFirstAttempt = 4.0;

/// Chosen lanes of a batch.
struct Selection {
  std::vector<double> mean;
  std::vector<std::vector<double>> weights;

  Selection(const HillBatch& batch, const std::vector<std::size_t>& lanes) {
    const auto chosen = [&](std::span<const double> from) {
      std::vector<double> result;
      for (const std::size_t l : lanes) result.push_back(from[l]);
      return result;
    };
    mean = chosen(batch.mean);
    for (const auto& w : batch.weights) weights.push_back(chosen(w));
  }

  HillBatch batch() const { return {mean, {weights.begin(), weights.end()}}; }
};

std::vector<PeriodicFunction> cosines(const std::vector<int>& orders) {
  std::vector<PeriodicFunction> result;
  for (const int order : orders) {
    if (order < 1 || std::count(orders.begin(), orders.end(), order) > 1)
      throw InvalidInput("orders", std::to_string(order), "at least 1, each once");
    result.push_back(PeriodicFunction::fourier(0.0, {{order, 1.0, 0.0}}));
  }
  return result;
}

}  // namespace

HillDiscriminants::HillDiscriminants(std::vector<int> orders, double tolerance)
    : tolerance_(tolerance), basis_(cosines(orders)) {
  MonodromyOptions{.tolerance = tolerance}.validate();
  const int highest = orders.empty() ? 0 : *std::max_element(orders.begin(), orders.end());
  coefficient_error_ = HillSeries::evaluation_error(highest);
  const auto [first, lowest] = series_ladder({.tolerance = tolerance});
  local_tolerances_.push_back(kFirstAttempt * first);
  while (local_tolerances_.back() > lowest)
    local_tolerances_.push_back(std::max(kLadderStep * local_tolerances_.back(), lowest));
}

HillFamily& HillDiscriminants::family(std::size_t rung) {
  while (families_.size() <= rung)
    families_.emplace_back(basis_, 0.0, pi, local_tolerances_[families_.size()]);
  return families_[rung];
}

void HillDiscriminants::combine(const HillGroup& group) {
  const std::size_t lanes = group.lanes.size();
  value_.resize(std::max(value_.size(), lanes));
  error_.resize(value_.size());
  if (group.plan.steps == 0) {
    std::fill_n(value_.begin(), lanes, std::numeric_limits<double>::quiet_NaN());
    std::fill_n(error_.begin(), lanes, kInfinity);
    return;
  }
  std::vector<const double*> weights;
  for (const auto& w : group.batch.weights) weights.push_back(w.data());
  detail::combine({.half = &group.result,
                   .mean = group.batch.mean.data(),
                   .weights = weights.data(),
                   .functions = static_cast<int>(basis_.size()),
                   .coefficient_error = pi * coefficient_error_,
                   .value = value_.data(),
                   .error = error_.data(),
                   .lanes = lanes});
}

std::vector<std::size_t> HillDiscriminants::attempt(std::size_t rung, const HillBatch& batch,
                                                    std::span<double> value, std::span<double> error) {
  std::vector<std::size_t> missed;
  family(rung).propagate(batch, [&](const HillGroup& group) {
    combine(group);
    for (std::size_t l = 0; l < group.lanes.size(); ++l) {
      const std::size_t lane = group.lanes[l];
      value[lane] = value_[l];
      error[lane] = error_[l];
      if (error_[l] > tolerance_ && error_[l] < kInfinity) missed.push_back(lane);
    }
  });
  return missed;
}

void HillDiscriminants::compute(const HillBatch& batch, std::span<double> value, std::span<double> error) {
  const DefaultFloatingPoint environment;
  const std::size_t lanes = batch.mean.size();
  if (value.size() != lanes || error.size() != lanes)
    throw InvalidInput("value, error", std::to_string(value.size()), "as long as the means");
  auto missed = attempt(0, batch, value, error);
  for (std::size_t rung = 1; rung < local_tolerances_.size() && !missed.empty(); ++rung) {
    const Selection again(batch, missed);
    std::vector<double> values(missed.size()), errors(missed.size());
    auto still = attempt(rung, again.batch(), values, errors);
    for (std::size_t i = 0; i < missed.size(); ++i) {
      if (!(errors[i] < error[missed[i]])) continue;
      value[missed[i]] = values[i];
      error[missed[i]] = errors[i];
    }
    for (auto& place : still) place = missed[place];
    missed = std::move(still);
  }
}

}  // namespace strutt
