#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strutt/integrate/hill_series.hpp"

namespace strutt::detail {

/// max |f| within `distance` of the real axis, bounded harmonic by harmonic.
double largest_within(const PeriodicFunction& f, double distance);

/// Plans for equations Y'' + W Y = 0 with W = mean + sum_f weight_f f over an interval. With r half a step
/// and Omega >= |W| within rho r of the middle of a step, Cauchy's inequality bounds the terms left out,
///   sum_(k >= K) k |a_k| <= K rho^(1-K) cosh(rho r sqrt Omega)/(1 - 1/rho)^2,
/// so that (steps, K) serves all W with Omega below a limit. Rows of such pairs, each with its rho, by rising
/// cost; |mean| + sum_f |weight_f| max|f| stands for Omega.
class SeriesPlanner {
 public:
  /// For a truncation below about `tolerance` in the propagator of the whole interval, relative to its size.
  SeriesPlanner(std::span<const PeriodicFunction> basis, double length, double tolerance);

  /// The first row that serves each lane; plans().size() where none does. Depends on the lane only.
  void choose(const HillBatch& batch, std::size_t first, std::span<std::int64_t> rows) const;

  std::span<const HillSeriesPlan> plans() const { return plans_; }

 private:
  std::vector<HillSeriesPlan> plans_;
  std::vector<double> shares_;  // row by row: 1/limit, and max|f|/limit of each function
  std::size_t functions_;
};

}  // namespace strutt::detail
