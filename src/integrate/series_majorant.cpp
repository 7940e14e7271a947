#include "integrate/series_majorant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace strutt::detail {
namespace {

constexpr int kMostMiddles = 16;              // that are looked at one by one
constexpr double kSumRounding = 1.0 + 1e-12;  // of sums of positive terms

/// At any phase.
CoefficientBounds anywhere(const PeriodicFunction& f, double r) {
  CoefficientBounds result{r * r * std::abs(f.mean())};
  for (const auto& h : f.harmonics()) {
    double term = r * r * std::hypot(h.cosine, h.sine);
    for (std::size_t j = 0; j < result.size(); ++j) {
      result[j] += term;
      term *= h.order * r / static_cast<double>(j + 1);
    }
  }
  return result;
}

/// Of what Darboux's relation of order 2 q leaves out: (2q+1) B(1/2, q+1) C(q+i, i) at [q][i].
using DarbouxWeights = std::array<std::array<double, kMajorantTerms / 2>, kMajorantTerms / 2>;
DarbouxWeights darboux_weights() {
  DarbouxWeights result;
  double first = 2.0;
  for (std::size_t q = 0; q < result.size(); ++q) {
    if (q > 0) first *= 2.0 * static_cast<double>(q) / static_cast<double>(2 * q + 1);
    double weight = static_cast<double>(2 * q + 1) * first;
    for (std::size_t i = 0; i < result[q].size(); ++i) {
      result[q][i] = weight;
      weight *= static_cast<double>(q + 1 + i) / static_cast<double>(i + 1);
    }
  }
  return result;
}

/// What Darboux's relation of order 2 q leaves out of sum_k a_k s^k. Its terms fall faster and faster: after
/// the last, each is less than half the one before.
double left_out(std::size_t q, std::span<const double> a) {
  static const DarbouxWeights weights = darboux_weights();
  double sum = 0.0, last = 0.0, before = 0.0;
  for (std::size_t i = 0; 2 * q + 1 + 2 * i < a.size(); ++i) {
    before = last;
    last = weights[q][i] * a[2 * q + 1 + 2 * i];
    sum += last;
  }
  return last <= 0.5 * before ? sum + last : std::numeric_limits<double>::infinity();
}

}  // namespace

CoefficientBounds middle_bounds(const SeriesNodes& nodes, const PeriodicFunction& f) {
  const double r = std::abs(nodes.radius());
  if (nodes.steps() > kMostMiddles) return anywhere(f, r);
  CoefficientBounds result{};
  for (int i = 0; i < nodes.steps(); ++i) {
    CoefficientBounds series;
    expand(f, nodes.phase(i + 0.5), r, series);
    for (std::size_t j = 0; j < result.size(); ++j) result[j] = std::max(result[j], std::abs(series[j]));
  }
  return result;
}

SeriesMajorant::SeriesMajorant(const CoefficientBounds& bounds) : first_{1.0, 0.0}, second_{0.0, 1.0} {
  std::array<std::size_t, kMajorantTerms> occurring{};
  std::size_t count = 0;
  for (std::size_t j = 0; j < bounds.size(); ++j)
    if (bounds[j] > 0.0) occurring[count++] = j;
  for (std::size_t k = 0; k + 2 < first_.size(); ++k) {
    double first = 0.0, second = 0.0;  // side by side: each addition waits for the one before
    for (std::size_t i = 0; i < count && occurring[i] <= k; ++i) {
      const double bound = bounds[occurring[i]];
      first += bound * first_[k - occurring[i]];
      second += bound * second_[k - occurring[i]];
    }
    const auto divisor = static_cast<double>((k + 1) * (k + 2));
    first_[k + 2] = first / divisor;
    second_[k + 2] = second / divisor;
  }
  for (std::size_t k = 0; k < first_slope_.size(); ++k) {
    first_slope_[k] = static_cast<double>(k + 1) * first_[k + 1];
    second_slope_[k] = static_cast<double>(k + 1) * second_[k + 1];
  }
}

double SeriesMajorant::tail(int terms) const {
  const auto q = static_cast<std::size_t>(terms);
  const auto of = [q](std::span<const double> value, std::span<const double> slope) {
    return std::max(left_out(q - 1, value) / kValueShare, left_out(q - 2, slope));
  };
  return kSumRounding * std::max(of(first_, first_slope_), 2.0 * of(second_, second_slope_));
}

}  // namespace strutt::detail
