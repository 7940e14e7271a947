#include "integrate/series_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "strutt/integrate/hill_series.hpp"

namespace strutt::detail {
namespace {

/// A harmonic and its derivative divided by its order, at theta.
struct HarmonicAt {
  double value, slope;

  HarmonicAt(const Harmonic& h, long double theta) {
    const long double angle = h.order * theta;
    const auto c = static_cast<double>(std::cos(angle)), s = static_cast<double>(std::sin(angle));
    const double negligible = HillSeries::evaluation_error(h.order) * std::hypot(h.cosine, h.sine);
    value = h.cosine * c + h.sine * s;
    slope = h.sine * c - h.cosine * s;
    if (std::abs(value) <= negligible) value = 0.0;
    if (std::abs(slope) <= negligible) slope = 0.0;
  }
};

}  // namespace

void expand(const PeriodicFunction& f, long double theta, double r, std::span<double> series) {
  std::ranges::fill(series, 0.0);
  series[0] = r * r * f.mean();
  for (const auto& h : f.harmonics()) {
    const HarmonicAt at(h, theta);
    double factor = r * r;
    for (std::size_t j = 0; j < series.size(); ++j) {
      series[j] += factor * (j % 4 < 2 ? 1.0 : -1.0) * (j % 2 == 0 ? at.value : at.slope);
      factor *= h.order * r / static_cast<double>(j + 1);
    }
  }
}

Parity parity_of(std::span<const double> series, std::size_t terms) {
  bool even = true, odd = true;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::size_t j = i % terms;
    if (j == 0 || series[i] == 0.0) continue;
    (j % 2 == 0 ? odd : even) = false;
  }
  return even ? Parity::even : odd ? Parity::odd : Parity::neither;
}

double largest_within(const PeriodicFunction& f, double distance) {
  double sum = std::abs(f.mean());
  for (const auto& h : f.harmonics()) sum += std::hypot(h.cosine, h.sine) * std::cosh(h.order * distance);
  return sum;
}

}  // namespace strutt::detail
