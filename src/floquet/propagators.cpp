#include "floquet/propagators.hpp"

namespace strutt {
namespace {

// Of a step of SUNDIALS. Below the lowest, rounding grows faster than truncation falls.
constexpr double kLowestLocalTolerance = 1e-14;
constexpr double kHighestLocalTolerance = 1e-4;
constexpr double kLocalShare = 0.01;  // local tolerance to global tolerance

// Of a whole piece or period, by fixed steps.
constexpr double kLowestSeriesTolerance = 1e-16;
constexpr double kSeriesShare = 0.5;
constexpr double kLowestTaylorTolerance = 1e-15;
constexpr double kTaylorShare = 0.01;  // less, for the bounds of the steps add up

}  // namespace

PropagatorOptions propagator_options(const MonodromyOptions& options, double local_tolerance,
                                     int highest_order) {
  return {.local_tolerance = local_tolerance,
          .highest_frequency = static_cast<double>(highest_order),
          .estimate_error = options.estimate_error,
          .max_seconds = options.max_seconds,
          .cancel = options.cancel};
}

ToleranceLadder sundials_ladder(const MonodromyOptions& options) {
  const double first =
      std::clamp(kLocalShare * options.tolerance, kLowestLocalTolerance, kHighestLocalTolerance);
  return {options.sharpest ? kLowestLocalTolerance : first, kLowestLocalTolerance};
}

ToleranceLadder series_ladder(const MonodromyOptions& options) {
  return {options.sharpest ? kLowestSeriesTolerance : kSeriesShare * options.tolerance,
          kLowestSeriesTolerance};
}

ToleranceLadder taylor_ladder(const MonodromyOptions& options) {
  return {options.sharpest ? kLowestTaylorTolerance : kTaylorShare * options.tolerance,
          kLowestTaylorTolerance};
}

}  // namespace strutt
