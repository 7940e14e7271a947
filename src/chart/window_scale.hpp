#pragma once

#include <cmath>
#include <numeric>

#include "strutt/chart/tongues.hpp"

namespace strutt {

/// Lengths on one side of a window, linear or logarithmic.
class WindowScale {
 public:
  WindowScale(const TongueLine& line, bool logarithmic)
      : from_(line.from), to_(line.to), logarithmic_(logarithmic) {}

  /// 0 at from, 1 at to.
  double part(double value) const { return length(from_, value) / length(from_, to_); }
  double at(double part) const {
    if (part == 1.0) return to_;
    return logarithmic_ ? from_ * std::pow(to_ / from_, part) : std::lerp(from_, to_, part);
  }
  double middle(double a, double b) const {
    return logarithmic_ ? std::copysign(std::sqrt(std::abs(a)) * std::sqrt(std::abs(b)), a)
                        : std::midpoint(a, b);
  }
  /// From a to b, in units of the whole.
  double share(double a, double b) const { return length(a, b) / length(from_, to_); }

 private:
  double length(double a, double b) const { return logarithmic_ ? std::log(b / a) : b - a; }

  double from_, to_;
  bool logarithmic_;
};

}  // namespace strutt
