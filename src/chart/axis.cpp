#include "strutt/chart/axis.hpp"

#include <cmath>

#include "strutt/base/error.hpp"

namespace strutt {

double Axis::value(std::size_t j) const {
  if (j == 0 || points <= 1) return from;
  if (j + 1 == points) return to;
  const double share = static_cast<double>(j) / static_cast<double>(points - 1);
  if (scale == AxisScale::linear) return std::lerp(from, to, share);
  return std::copysign(std::exp(std::lerp(std::log(std::abs(from)), std::log(std::abs(to)), share)), from);
}

void Axis::validate(const std::string& name) const {
  require(std::isfinite(from), name + " axis: from", from, "finite");
  require(std::isfinite(to), name + " axis: to", to, "finite");
  require(points >= 1, name + " axis: points", static_cast<double>(points), "at least 1");
  if (points == 1) {
    require(from == to, name + " axis: to", to,
            "equal to from (" + to_text(from) + ") when there is one point");
  } else {
    require(from != to, name + " axis: to", to,
            "different from from (" + to_text(from) + ") for " + std::to_string(points) +
                " points: the range is empty");
  }
  require(scale == AxisScale::linear || from * to > 0.0 || (from > 0.0) == (to > 0.0), name + " axis: from",
          from, "of the same sign as to (" + to_text(to) + ") on a logarithmic axis");
  require(scale == AxisScale::linear || (from != 0.0 && to != 0.0), name + " axis: range", 0.0,
          "without 0 on a logarithmic axis");
}

}  // namespace strutt
