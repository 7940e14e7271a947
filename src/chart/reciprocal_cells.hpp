#pragma once

#include <Eigen/Core>
#include <optional>

#include "chart/product_table.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// From interpolated propagators of systems with four states and reciprocal multipliers to what a chart says
/// of a cell, in closed form and without a model per cell: as MatrixCell, but for the last digits of the
/// bounds.
class ReciprocalCells {
 public:
  /// Nothing unless at the corners, in the middles of the edges and in the centre the system has two degrees
  /// of freedom, symmetric stiffness, damping c mass with c >= 0, one and the same symmetric mass, and cT is
  /// a product of functions of the two parameters.
  static std::optional<ReciprocalCells> of(const Scene& scene, const ChartRequest& request);

  /// Whether the systems there are such ones, whatever cT is.
  static bool serves(const Scene& scene, const Axis& x, const Axis& y);

  /// The cell in column i and row j; `value` is the propagator in the unit and the state of the box.
  Stability assess(std::size_t i, std::size_t j, const SurrogateBox& box, const Eigen::Matrix4d& value) const;

 private:
  Eigen::Matrix2d mass_, inverse_mass_;
  ProductTable half_damping_;
  double tolerance_ = 0.0;
};

}  // namespace strutt
