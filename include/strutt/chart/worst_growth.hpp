#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/base/outcome.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// All that is known of an uncertain parameter: from <= value <= to.
struct ParameterRange {
  std::string parameter;
  double from = 0.0;
  double to = 0.0;
};

struct WorstGrowthOptions {
  double tolerance = 1e-3;           ///< largest error wanted, 1e-13 <= tolerance <= 1e-2
  std::size_t evaluations = 20'000;  ///< at most, 100 to 1e8
  const std::atomic<bool>* cancel = nullptr;
};

/// The largest growth in a box of parameters.
struct WorstGrowth {
  double growth = -std::numeric_limits<double>::infinity();  ///< ln of the spectral radius per period
  double error =
      std::numeric_limits<double>::infinity();  ///< the largest growth lies in [growth, growth + error]
  bool proved = false;                          ///< false: `error` is an estimate (systems)
  std::vector<double> at;  ///< the values of the parameters where `growth` is, in the order of the box
  std::size_t evaluations = 0;
  Method method = Method::propagator;
  Outcome outcome = Outcome::converged;
};

inline constexpr std::size_t kMostUncertain = 8;

/// The worst growth over a box of uncertain parameters.
///
/// Equations of second order: branch and bound. Beside W, with |W' - W| <= r all through the period,
///   |D(W')| <= |D(W)| + min(e^E (e^x - 1),  r S + e^E (e^x - 1 - x)),   x = 2 pi r/kappa,
///   S = integral of |n12(theta)| over the period >= |dD| per unit of change,  n12 = Y at theta + 2 pi for Y
///   = 0, Y' = 1 at theta, E = integral of |kappa^2 - W|/(2 kappa), any kappa > 0,
/// the terms of the Neumann series of D, so that acosh(|D|/2) less the least cT/2 of a cell bounds its
/// growth; and growth <= E + x/2 - cT/2. Cells are halved, the one with the largest bound first, until that
/// bound is within the tolerance of the largest growth found, or the evaluations run out; the largest growth
/// found is improved by a pattern search. Rounding is not bounded (1e-12 of D). Systems: pattern searches
/// from the best of two disjoint sets of points of a low-discrepancy sequence; the error is the difference of
/// the two results, an estimate.
///
/// Throws InvalidInput for an unknown parameter, one given twice or without influence, a range that is not
/// finite or not from <= to, more than kMostUncertain parameters or none, a corner of the box that does not
/// validate, options out of range.
WorstGrowth worst_growth(const Scene& scene, const std::vector<ParameterRange>& box,
                         const WorstGrowthOptions& options = {});

}  // namespace strutt
