#pragma once

#include <vector>

#include "chart/propagator_sample.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// What to do with a box.
enum class BoxOutcome { interpolated, split_x, split_y, given_up, cancelled };

struct BoxBuild {
  BoxOutcome outcome = BoxOutcome::given_up;
  std::size_t nodes = 0;
  long right_hand_sides = 0;
};

/// Raises the degree of `box` (its ends are given) until the error fits, and fills it; or says how to split
/// it. `coordinate_error`: bound of the absolute rounding of a coordinate, per axis. Where nodes would be
/// more than `affordable` the box is given up.
BoxBuild build_box(SurrogateBox& box, SurrogateKind kind, const Sampling& sampling,
                   const std::array<double, 2>& coordinate_error, double tolerance, double affordable);

/// The bounds of the entries, n x n.
Eigen::MatrixXd error_matrix(const SurrogateBox& box);

/// The propagator at a point in axis coordinates, n x n, state and unit of the box.
Eigen::MatrixXd evaluate(const SurrogateBox& box, double x, double y);

}  // namespace strutt
