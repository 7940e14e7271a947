#pragma once

#include <array>

#include "integrate/series_nodes.hpp"

namespace strutt::detail {

inline constexpr int kMajorantTerms = 56;

/// Bounds of the coefficients v_j of W about the middle of a step, in units of r.
using CoefficientBounds = std::array<double, kMajorantTerms>;

/// Bounds of r^(j+2)/j! f^(j) in the middle of any step.
CoefficientBounds middle_bounds(const SeriesNodes& nodes, const PeriodicFunction& f);

/// The power series of both solutions of Y'' + v Y = 0 from (1, 0) and (0, 1) in the middle of a step are
/// majorised by those of Y'' = sum_j bounds[j] s^j Y, whose coefficients are positive.
class SeriesMajorant {
 public:
  explicit SeriesMajorant(const CoefficientBounds& bounds);

  /// HillSeries::tail for series with so many terms. Darboux's relation of order 2 q between -1 and 1 leaves
  /// out
  ///   1/(2q)! integral_(-1)^1 (1 - s^2)^q f^(2q+1)(s) ds = (2q+1) B(1/2, q+1) sum_i C(q+i, i) a_(2q+1+2i)
  /// of f = sum_k a_k s^k. Infinite where this falls too slowly.
  double tail(int terms) const;

 private:
  CoefficientBounds first_, second_;
  std::array<double, kMajorantTerms - 1> first_slope_, second_slope_;  // of their derivatives
};

}  // namespace strutt::detail
