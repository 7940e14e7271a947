#pragma once

#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// From interpolated propagators over a whole period to what a chart says of a cell. One per thread.
class MatrixCell {
 public:
  MatrixCell(const Scene& scene, const ChartRequest& request);
  MatrixCell(const MatrixCell&) = delete;

  /// `value` and `error`: n x n, in the unit and the state of the box.
  Stability assess(double x, double y, const SurrogateBox& box, const Eigen::MatrixXd& value,
                   const Eigen::MatrixXd& error);

 private:
  Scene scene_;
  double* x_;
  double* y_;
  double tolerance_;
  StabilityParts parts_;
};

}  // namespace strutt
