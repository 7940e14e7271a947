#include "chart/box_error.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"

namespace strutt {
namespace {

constexpr double kLeastRounding = 64.0 * kUnit;  // of transform and sum, relative to the factors

}  // namespace

Eigen::Index tail_length(Eigen::Index coefficients) { return std::max<Eigen::Index>(3, coefficients / 10); }

double transform_error(int nx, int ny, double largest) { return 8.0 * kUnit * std::sqrt(nx + ny) * largest; }

void set_unit(SurrogateBox& box, const PropagatorSample& middle, std::span<const PropagatorSample> samples) {
  box.kappa = middle.kappa;
  box.exponent = middle.exponent;
  for (const auto& sample : samples) box.exponent = std::max(box.exponent, sample.exponent);
}

std::vector<PointPropagator> in_unit_of(const SurrogateBox& box, std::span<const PropagatorSample> samples) {
  std::vector<PointPropagator> result;
  for (const auto& sample : samples) {
    auto scaled = at_kappa(sample.value, sample.error, box.kappa);
    const auto shift = static_cast<int>(std::max(sample.exponent - box.exponent, -2000L));
    for (auto* m : {&scaled.value, &scaled.error})
      *m = m->unaryExpr([shift](double v) { return std::ldexp(v, shift); });
    result.push_back(std::move(scaled));
  }
  return result;
}

double worst_error(const SurrogateBox& box, SurrogateKind kind, std::span<const PropagatorSample> samples,
                   const Eigen::MatrixXd& error) {
  double worst = 0.0;
  const auto scaled_samples = in_unit_of(box, samples);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto scaled = at_kappa(scaled_samples[k].value, error, samples[k].kappa / box.kappa);
    worst = std::max(worst, error_of_monodromy(kind, scaled, box.exponent, samples[k]));
  }
  return worst;
}

bool is_hopeless(SurrogateKind kind, std::span<const PropagatorSample> samples, double tolerance) {
  std::size_t missed = 0;
  for (const auto& sample : samples) {
    const Eigen::MatrixXd error = kNodeErrorGrowth * sample.error + kLeastRounding * sample.value.cwiseAbs();
    const auto scaled = at_kappa(sample.value, error, sample.kappa);
    if (error_of_monodromy(kind, scaled, sample.exponent, sample) > kShareAtNodes * tolerance) ++missed;
  }
  return 2 * missed > samples.size();
}

double log2_size(const PropagatorSample& sample, double kappa) {
  const auto scaled = at_kappa(sample.value, sample.error, kappa);
  return std::log2(scaled.value.cwiseAbs().maxCoeff()) + static_cast<double>(sample.exponent);
}

}  // namespace strutt
