#pragma once

#include <span>
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

/// The propagator at points in axis coordinates, state and unit of the box, by Clenshaw's recurrence: entry
/// f, row by row, of point p at values[f * points + p].
void evaluate(const SurrogateBox& box, std::span<const double> x, std::span<const double> y, double* values);

/// The same at one point, n x n, to the same bits.
Eigen::MatrixXd evaluate(const SurrogateBox& box, double x, double y);

/// Bounds of what `evaluate` gives, n x n: those of the entries, and the rounding of Clenshaw's recurrence.
/// (It takes b_k = c_k + 2s b_(k+1) - b_(k+2) = sum_(j >= k) c_j U_(j-k)(s), rounds it by three units at
/// most, and that becomes |U_k| <= k + 1 times as much: 3 units sum_j |c_j| (j + 1)(j + 2)(j + 3)/6 in each
/// direction.)
Eigen::MatrixXd evaluation_error(const SurrogateBox& box);

}  // namespace strutt
