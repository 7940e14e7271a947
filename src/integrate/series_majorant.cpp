#include "integrate/series_majorant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace strutt::detail {
namespace {

constexpr int kMostMiddles = 16;             // that are looked at one by one
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

CoefficientBounds solution(const CoefficientBounds& bounds, double value, double slope) {
  std::array<std::size_t, kMajorantTerms> occurring{};
  std::size_t count = 0;
  for (std::size_t j = 0; j < bounds.size(); ++j)
    if (bounds[j] > 0.0) occurring[count++] = j;
  CoefficientBounds a{value, slope};
  for (std::size_t k = 0; k + 2 < a.size(); ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count && occurring[i] <= k; ++i)
      sum += bounds[occurring[i]] * a[k - occurring[i]];
    a[k + 2] = sum / static_cast<double>((k + 1) * (k + 2));
  }
  return a;
}

/// What Darboux's relation of order 2 q leaves out of sum_k a_k s^k. Its terms fall faster and faster: after
/// the last, each is less than half the one before.
double left_out(int q, std::span<const double> a) {
  double weight = 2.0 * (2 * q + 1);
  for (int i = 1; i <= q; ++i) weight *= 2.0 * i / (2 * i + 1);
  double sum = 0.0, last = 0.0, before = 0.0;
  for (int i = 0; 2 * q + 1 + 2 * i < static_cast<int>(a.size()); ++i) {
    before = last;
    last = weight * a[static_cast<std::size_t>(2 * q + 1 + 2 * i)];
    sum += last;
    weight *= static_cast<double>(q + 1 + i) / (i + 1);
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

SeriesMajorant::SeriesMajorant(const CoefficientBounds& bounds)
    : first_(solution(bounds, 1.0, 0.0)), second_(solution(bounds, 0.0, 1.0)) {}

double SeriesMajorant::tail(int terms) const {
  const auto of = [terms](const CoefficientBounds& a) {
    CoefficientBounds slope;  // coefficients of the derivative
    for (std::size_t k = 0; k + 1 < slope.size(); ++k) slope[k] = static_cast<double>(k + 1) * a[k + 1];
    const auto known = std::span(slope).first(slope.size() - 1);
    return std::max(left_out(terms - 1, a) / kValueShare, left_out(terms - 2, known));
  };
  return kSumRounding * std::max(of(first_), 2.0 * of(second_));
}

}  // namespace strutt::detail
