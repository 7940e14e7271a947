#pragma once

#include <cstddef>
#include <string>

namespace strutt {

enum class AxisScale { linear, logarithmic };

/// One axis of a chart: `points` values of a scene parameter from `from` to `to`, both ends exact. Reversed
/// ranges (from > to) are kept in that order; one point needs from == to.
struct Axis {
  std::string parameter;  ///< path, e.g. "support.frequency"
  double from = 0.0;
  double to = 1.0;
  std::size_t points = 2;
  AxisScale scale = AxisScale::linear;

  /// from + (to - from) j/(points - 1) by std::lerp; on a logarithmic axis in ln|value|. j in [0, points).
  double value(std::size_t j) const;

  /// Finite ends; points >= 1; from != to unless points == 1 (then from == to); a logarithmic axis with both
  /// ends positive or both negative. Throws InvalidInput with `name` ("x" or "y") in the field.
  void validate(const std::string& name) const;
};

}  // namespace strutt
