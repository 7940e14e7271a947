#pragma once

#include <string>
#include <vector>

#include "strutt/chart/axis.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// A mark on an axis: where (0 at `from`, 1 at `to`) and what it says; minor marks say nothing.
struct Tick {
  double position = 0.0;
  std::string label;
};

/// Marks at round numbers, for linear and logarithmic, reversed, tiny and huge ranges. One point has one mark
/// in the middle.
std::vector<Tick> axis_ticks(const Axis& axis);

/// `label [unit]`.
std::string axis_label(const Axis& axis, const ParameterInfo& info);

/// The largest 1, 2 or 5 times a power of ten that is not above `value` > 0.
double round_down_125(double value);

}  // namespace strutt
