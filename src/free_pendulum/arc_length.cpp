#include "free_pendulum/arc_length.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace strutt::detail {
namespace {

// A panel is at most half as wide as its far end is away from the singularities: the rule's error is below
// 1e-25.
constexpr unsigned kNodes = 20;
constexpr double kLeastPanel = 1e-17;
constexpr int kNewtonSteps = 60;

double integral(const std::function<double(double)>& speed, double from, double to) {
  return boost::math::quadrature::gauss<double, kNodes>::integrate(speed, from, to);
}

}  // namespace

ArcLength::ArcLength(std::function<double(double)> speed, double end, double sharpness)
    : speed_(std::move(speed)), ends_{end} {
  const double least = std::max(sharpness / 2.0, kLeastPanel * end);
  while (ends_.back() > least) ends_.push_back(ends_.back() / 2.0);
  ends_.push_back(0.0);
  std::reverse(ends_.begin(), ends_.end());
  lengths_.push_back(0.0);
  for (std::size_t i = 1; i < ends_.size(); ++i) {
    lengths_.push_back(lengths_.back() + integral(speed_, ends_[i - 1], ends_[i]));
  }
}

double ArcLength::parameter(double length) const {
  if (!(length > 0.0)) return 0.0;
  if (!(length < total())) return ends_.back();
  const auto above = std::upper_bound(lengths_.begin(), lengths_.end(), length);
  const auto panel = static_cast<std::size_t>(above - lengths_.begin());
  const double from = ends_[panel - 1], rest = length - lengths_[panel - 1];
  double low = from, high = ends_[panel];
  double x = std::lerp(low, high, rest / (lengths_[panel] - lengths_[panel - 1]));
  // Newton's iteration, kept inside the bracket by bisection.
  for (int step = 0; step < kNewtonSteps; ++step) {
    const double excess = integral(speed_, from, x) - rest;
    (excess > 0.0 ? high : low) = x;
    double next = x - excess / speed_(x);
    if (!(next > low && next < high)) next = low + (high - low) / 2.0;
    const double change = std::abs(next - x);
    x = next;
    if (change <= 4e-16 * x) break;
  }
  return x;
}

}  // namespace strutt::detail
