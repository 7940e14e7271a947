#pragma once

#include <array>
#include <span>

#include "integrate/series_kernel.hpp"
#include "strutt/model/periodic_function.hpp"

namespace strutt::detail {

/// Where the power series of an interval are centred: at the ends of equal steps of length 2 r.
class SeriesNodes {
 public:
  SeriesNodes(double from, double to, int steps) : from_(from), to_(to), steps_(steps) {}

  int count() const { return steps_ + 1; }
  double radius() const { return 0.5 * (to_ - from_) / steps_; }
  int steps() const { return steps_; }
  /// Of node i, and for i + 1/2 of the middle of the step after it.
  long double phase(double i) const { return from_ + (static_cast<long double>(to_) - from_) * i / steps_; }

 private:
  double from_, to_;
  int steps_;
};

/// Writes r^(j+2)/j! f^(j)(theta) for all j. What is negligible by HillSeries::evaluation_error is 0.
void expand(const PeriodicFunction& f, long double theta, double r, std::span<double> series);

/// Which of the series, each `terms` long and one after the other, have terms j > 0.
Parity parity_of(std::span<const double> series, std::size_t terms);

/// max |f| within `distance` of the real axis, bounded harmonic by harmonic.
double largest_within(const PeriodicFunction& f, double distance);

}  // namespace strutt::detail
