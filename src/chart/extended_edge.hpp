#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "chart/reference_equation.hpp"

namespace strutt {

/// Zeros of |trace M| - 1 - det M along a parameter, where a multiplier is 1 or -1, by the monodromy matrix M
/// of the judge, to about 40 digits: beside the tip of a damped tongue, a nearly double zero, double
/// precision leaves an error that grows like its own size over the distance to the other edge.
class ExtendedEdges {
 public:
  ExtendedEdges(const Scene& scene, const std::string& path, const std::atomic<bool>* cancel)
      : scene_(scene), value_(&parameter(scene_, path)), cancel_(cancel) {}
  ExtendedEdges(const ExtendedEdges&) = delete;

  struct Zero {
    double position = 0.0;   ///< a double beside the zero
    double remainder = 0.0;  ///< zero = position + remainder
  };

  /// The simple zero within `reach` of a place, if Newton's method finds it: enclosed by a change of sign
  /// between doubles a few units of the last place apart. Nothing otherwise, and where the coefficient is so
  /// large that the judge would take long.
  std::optional<Zero> near(double place, double reach);

 private:
  std::optional<judge::Real> excess(double parameter);

  Scene scene_;
  double* value_;
  const std::atomic<bool>* cancel_;
};

}  // namespace strutt
