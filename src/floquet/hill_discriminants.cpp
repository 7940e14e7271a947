#include "strutt/floquet/hill_discriminants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "floquet/discriminant_kernel.hpp"
#include "floquet/propagators.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

HillDiscriminants::HillDiscriminants(std::vector<int> orders, double tolerance) : tolerance_(tolerance) {
  MonodromyOptions{.tolerance = tolerance}.validate();
  const auto basis = cosines(orders);
  const int highest = orders.empty() ? 0 : *std::max_element(orders.begin(), orders.end());
  coefficient_error_ = HillSeries::evaluation_error(highest);
  const auto [first, lowest] = series_ladder(tolerance);
  for (double local = first;; local = std::max(kLadderStep * local, lowest)) {
    families_.emplace_back(basis, 0.0, pi, local);
    if (local <= lowest) break;
  }
}

void HillDiscriminants::attempt(HillFamily& family, const HillBatch& batch, std::span<double> value,
                                std::span<double> error) {
  std::vector<double> bound;
  family.propagate(batch, [&](const HillGroup& group) {
    const std::size_t lanes = group.lanes.size();
    value_.assign(lanes, std::numeric_limits<double>::quiet_NaN());
    error_.assign(lanes, kInfinity);
    if (group.plan.steps > 0) {
      bound.resize(lanes);
      for (std::size_t l = 0; l < lanes; ++l) bound[l] = std::abs(group.batch.mean[l]);
      for (const auto& w : group.batch.weights)
        for (std::size_t l = 0; l < lanes; ++l) bound[l] += std::abs(w[l]);
      detail::combine({.half = &group.result,
                       .mean = group.batch.mean.data(),
                       .bound = bound.data(),
                       .coefficient_error = coefficient_error_,
                       .value = value_.data(),
                       .error = error_.data(),
                       .lanes = lanes});
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      value[group.lanes[l]] = value_[l];
      error[group.lanes[l]] = error_[l];
    }
  });
}

void HillDiscriminants::compute(const HillBatch& batch, std::span<double> value, std::span<double> error) {
  const DefaultFloatingPoint environment;
  const std::size_t lanes = batch.mean.size();
  if (value.size() != lanes || error.size() != lanes)
    throw InvalidInput("value, error", std::to_string(value.size()), "as long as the means");
  attempt(families_.front(), batch, value, error);
  std::vector<std::size_t> missed;
  for (std::size_t rung = 1; rung < families_.size(); ++rung) {
    missed.clear();
    for (std::size_t l = 0; l < lanes; ++l)
      if (error[l] > tolerance_ && std::isfinite(error[l])) missed.push_back(l);
    if (missed.empty()) break;
    const Selection again(batch, missed);
    std::vector<double> values(missed.size()), errors(missed.size());
    attempt(families_[rung], again.batch(), values, errors);
    for (std::size_t i = 0; i < missed.size(); ++i) {
      if (!(errors[i] < error[missed[i]])) continue;
      value[missed[i]] = values[i];
      error[missed[i]] = errors[i];
    }
  }
  for (std::size_t l = 0; l < lanes; ++l)
    if (std::isnan(error[l]) || std::isnan(value[l])) error[l] = kInfinity;
}

}  // namespace strutt
