#pragma once

#include <array>
#include <functional>
#include <vector>

#include "chart/surrogate_box.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// The box of the whole chart, in axis coordinates.
SurrogateBox whole_box(const Axis& x, const Axis& y);

/// Bounds of the rounding between parameter values and their coordinates, both ways.
std::array<double, 2> coordinate_errors(const Axis& x, const Axis& y);

/// Parameter values of points in axis coordinates.
std::vector<std::array<double, 2>> parameter_values(const Axis& x, const Axis& y,
                                                    const std::vector<std::array<double, 2>>& points);

/// Cells of the chart in a box, as if they were spread evenly (they are, in axis coordinates).
double cells_in(const SurrogateBox& box, const Axis& x, const Axis& y);

/// Tries to interpolate in a box, with no more nodes than `affordable`.
using BoxAttempt = std::function<BoxBuild(SurrogateBox& box, double affordable)>;
/// Takes a box that stays, interpolated or not, and how the attempt on it ended.
using BoxReceiver = std::function<void(SurrogateBox&& box, BoxOutcome outcome)>;

/// Begins with the whole chart and halves boxes as attempts say, level by level, while all nodes are few next
/// to the cells. Together the boxes received are the chart. False: an attempt was cancelled.
bool subdivide(const Axis& x, const Axis& y, const BoxAttempt& attempt, const BoxReceiver& receive);

}  // namespace strutt
