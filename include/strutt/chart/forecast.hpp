#pragma once

#include <cstddef>
#include <span>

#include "strutt/chart/axis.hpp"
#include "strutt/floquet/stability.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// What is expected of points that are computed one by one; the mean where there are several.
struct PointForecast {
  Method method = Method::automatic;  ///< the one a computation begins with
  double points = 0.0;                ///< of those tried, how many make an equation; 0: nothing is known
  double steps = 0.0;                 ///< of the propagator; 0: closed form, or adaptive
  double right_hand_sides = 0.0;      ///< coefficients of W, products with K, or evaluations
  double seconds = 0.0;               ///< of one thread, with what else is asked for

  /// Order of the propagator's method, from the work of a step (even; 0 without steps): of Hill equations
  /// twice the terms of a series less four, of systems with order (order + 1)/2 products.
  int order = 0;
};

/// Work is counted: the propagator is run, SUNDIALS' evaluations follow from how far the solutions turn and
/// from the tolerance. Seconds are the counts times the constants of src/chart/cost_table.hpp; nothing is
/// timed. The same arguments give the same forecast. Throws InvalidInput as method_for does.
PointForecast forecast_point(const LinearModel& model, const MonodromyOptions& options,
                             const StabilityParts& parts = {});

/// Mean of some points.
PointForecast forecast_points(std::span<const LinearModel> models, const MonodromyOptions& options,
                              const StabilityParts& parts = {});

/// Mean over a chart, by Simpson's rule from the corners, the middles of the edges and the centre.
PointForecast forecast_points(const Scene& scene, const Axis& x, const Axis& y,
                              const MonodromyOptions& options, const StabilityParts& parts = {});

/// What is expected of a surrogate over a chart, from trial propagators along the edges of its boxes.
struct SurrogateForecast {
  std::size_t boxes = 0;           ///< interpolated
  std::size_t boxes_left_out = 0;  ///< left to point by point
  int highest_degree = 0;
  double nodes = 0.0;             ///< points to integrate
  double right_hand_sides = 0.0;  ///< of a node, on average
  double cells = 0.0;             ///< interpolated, of all cells of the chart
  double multiply_adds = 0.0;     ///< of all cells together
  double bytes = 0.0;             ///< of the boxes, their tables and the nodes of the largest one
};

}  // namespace strutt
