#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/chart/axis.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// The axes of a chart.
struct ChartBox {
  Axis x, y;
};

/// Where a scene is measured: values of parameters, one row a point.
struct TradeoffPoints {
  std::vector<std::string> parameters;
  std::vector<std::vector<double>> rows;
  std::optional<ChartBox> box =
      std::nullopt;  ///< that the rows are taken from; only with one is the surrogate measured
};

/// The scene as it stands, one point.
TradeoffPoints scene_point();

/// `count` points scattered evenly over the box of two axes, the same on every call: the additive sequence of
/// Roberts, with the reciprocal plastic number and its square as steps. Logarithmic axes are filled evenly in
/// the logarithm.
TradeoffPoints scattered_points(const Axis& x, const Axis& y, std::size_t count);

/// What to measure.
struct TradeoffRequest {
  TradeoffPoints points = scene_point();
  std::vector<Method> methods = {};     ///< empty: all that fit the scene, `automatic` first
  std::vector<double> tolerances = {};  ///< empty: 1e-2, 1e-3, ..., 1e-13; each in [1e-13, 1e-2]
  int repeats = 5;                      ///< measurements of every time, >= 1; their median counts
  double seconds = 0.02;                ///< that a measurement takes at least, >= 0
  int threads = 0;                      ///< for the reference only; what is timed runs on one. 0: all
  const std::atomic<bool>* cancel = nullptr;
};

/// One method at one tolerance.
struct TradeoffRow {
  Method method = Method::automatic;
  double tolerance = 0.0;
  std::vector<Method>
      used;  ///< by which the results came about, most points first; more than `method` for `automatic` only
  std::size_t points = 0;     ///< measured
  std::size_t converged = 0;  ///< of them, those with Outcome::converged
  std::size_t exceeded =
      0;               ///< of them, those whose true error is above the bound reported: 0, or there is a bug
  double error = 0.0;  ///< largest bound of the error that was reported
  double true_error = 0.0;  ///< largest difference from the reference; both scaled as Stability::error is
  double median_true_error = 0.0;
  double points_per_second = 0.0;          ///< of one thread
  double spread = 0.0;                     ///< (slowest - fastest measurement)/median
  double steps = 0.0;                      ///< per point, of the runs that gave the values
  double right_hand_sides = 0.0;           ///< per point, of the same runs
  double estimate_right_hand_sides = 0.0;  ///< per point, of the runs that gave the bounds
  bool pareto = false;                     ///< no other method or tolerance is both faster and more accurate
};

/// The speed and the accuracy of every method that fits a scene.
struct Tradeoff {
  std::vector<TradeoffRow> rows;  ///< by method, then from the largest tolerance to the smallest
  std::size_t points = 0;         ///< measured: those asked for but the ones that make no equation
  bool cancelled = false;         ///< `rows` are then incomplete
};

/// Parts done of all, from the calling thread.
using TradeoffProgress = std::function<void(std::size_t done, std::size_t total)>;

/// The methods and tolerances of a request with its defaults filled in. Throws InvalidInput for a method that
/// does not fit the scene and for a tolerance out of range.
TradeoffRequest completed(const Scene& scene, TradeoffRequest request);

/// Forecast of the time that measure_tradeoff takes, for orientation, in seconds.
double expected_seconds(const Scene& scene, const TradeoffRequest& completed_request);

/// Measures. The truth is a Taylor series of 50 digits that starts from the numbers of the scene and shares
/// no code with the methods it judges. Times are processor times of one thread for `analyse` of all points at
/// once, verdict, growth, margin and error bound of each, without winding and matrix; where that takes less
/// than request.seconds, the points are repeated up to 256, as many as a chart hands over. All rows are timed
/// in turn, `repeats` times over, so that a slow spell of the machine meets all of them. The front of Pareto
/// is that of the methods; `automatic`, which is one of them, stays out. `surrogate` is timed as a chart over
/// the box with verdict, growth and margin, building included, for each of its cells; its right-hand sides
/// are those of nodes and checks for each cell, and points that it does not answer for are those of
/// `automatic`. Where it is seen from another phase than 0 its true error is that of the trace. Throws
/// InvalidInput for a bad request and where no point makes an equation, NumericalFailure where the reference
/// fails.
Tradeoff measure_tradeoff(const Scene& scene, const TradeoffRequest& request,
                          const TradeoffProgress& progress = {});

}  // namespace strutt
