#pragma once

#include <functional>
#include <vector>

namespace strutt::detail {

/// Arc length along a curve with the parameter x in [0, end], measured from a point at x = 0 near which the
/// curve bends within a range of about `sharpness` of x (a turning point of a libration next to the
/// separatrix, say).
class ArcLength {
 public:
  /// `speed` is ds/dx > 0 (0 only at single points), smooth but for singularities of its complex continuation
  /// that lie `sharpness` or more away from x = 0.
  ArcLength(std::function<double(double)> speed, double end, double sharpness);

  double total() const { return lengths_.back(); }

  /// x where the arc length from 0 is `length`, 0 <= length <= total().
  double parameter(double length) const;

 private:
  std::function<double(double)> speed_;
  std::vector<double> ends_;     // of panels that double in width away from 0; begins with 0
  std::vector<double> lengths_;  // arc length up to each of them
};

}  // namespace strutt::detail
