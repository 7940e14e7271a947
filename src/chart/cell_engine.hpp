#pragma once

#include <array>
#include <span>
#include <vector>

#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// What must be computed of a cell for the layers of a chart.
StabilityParts parts_of(const std::vector<Layer>& layers);

/// Point by point: one thread's model and integrators. Pointers into the scene let a cell set its two
/// parameters in place.
class CellEngine {
 public:
  CellEngine(const Scene& scene, const ChartRequest& request);
  CellEngine(const CellEngine&) = delete;

  /// One result for each of the points (x, y).
  std::vector<Stability> compute(std::span<const std::array<double, 2>> points);

 private:
  Scene scene_;
  double* x_;
  double* y_;
  MonodromyOptions options_;
  StabilityParts parts_;
  MonodromyEngine engine_;
};

/// What a layer holds for a cell.
double layer_value(const Stability& cell, Layer layer);

/// The trace of M as written to charts: beyond 1e300 it is infinite.
double written_trace(double trace);

}  // namespace strutt
