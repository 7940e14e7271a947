#include "floquet/propagators.hpp"

namespace strutt {
namespace {

// Of a step of SUNDIALS. Below the lowest, rounding grows faster than truncation falls.
constexpr double kLowestLocalTolerance = 1e-14;
constexpr double kHighestLocalTolerance = 1e-4;
constexpr double kLocalShare = 0.01;  // local tolerance to global tolerance

// Of a whole piece, by power series.
constexpr double kLowestSeriesTolerance = 1e-16;
constexpr double kSeriesShare = 0.5;

}  // namespace

PropagatorOptions propagator_options(const MonodromyOptions& options, double local_tolerance,
                                     int highest_order) {
  return {.local_tolerance = local_tolerance,
          .highest_frequency = static_cast<double>(highest_order),
          .estimate_error = options.estimate_error,
          .max_seconds = options.max_seconds,
          .cancel = options.cancel};
}

ToleranceLadder tolerance_ladder(Method method, double tolerance) {
  if (method == Method::propagator) return {kSeriesShare * tolerance, kLowestSeriesTolerance};
  return {std::clamp(kLocalShare * tolerance, kLowestLocalTolerance, kHighestLocalTolerance),
          kLowestLocalTolerance};
}

}  // namespace strutt
