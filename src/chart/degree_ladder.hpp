#pragma once

#include <algorithm>

#include "chart/box_error.hpp"
#include "chart/surrogate_box.hpp"

namespace strutt {

/// What lies beyond the degrees of a fit, of the worst entry.
struct Tail {
  double x = 0.0, y = 0.0;
};

/// How raise_degrees ended: `interpolated` with the degrees and the largest scaled error of M at the nodes.
struct DegreeLadder {
  BoxOutcome outcome = BoxOutcome::given_up;
  int nx = 0, ny = 0;  ///< of the last nodes; 0: none
  double error = 0.0;
};

/// Doubles the degree in the direction with the larger tail until the error of the box fits; or says how to
/// cut it. Degrees for which a full grid would have more nodes than `affordable` are not tried. `Nodes`:
///   bool refine(int nx, int ny)                  samples nodes of these degrees; false: cancelled
///   const std::vector<PropagatorSample>& samples()
///   Tail fit()                                   unit and error bounds of the box from them
///   BoxOutcome steeper()                         the direction along which sizes change more
template <typename Nodes>
DegreeLadder raise_degrees(Nodes& nodes, SurrogateBox& box, SurrogateKind kind, double tolerance,
                           double affordable) {
  DegreeLadder ladder;
  for (int nx = kFirstDegree, ny = kFirstDegree;;) {
    if ((nx + 1.0) * (ny + 1.0) > affordable) return ladder;
    if (!nodes.refine(nx, ny)) return {.outcome = BoxOutcome::cancelled};
    ladder.nx = nx;
    ladder.ny = ny;
    const auto& samples = nodes.samples();
    if (!std::all_of(samples.begin(), samples.end(), [](const auto& s) { return s.valid; })) return ladder;
    const Tail tail = nodes.fit();
    ladder.error = worst_error(box, kind, samples, error_matrix(box));
    if (ladder.error <= kShareAtNodes * tolerance) {
      ladder.outcome = BoxOutcome::interpolated;
      return ladder;
    }
    // Nothing but the bounds of nodes and rounding left: more nodes do not help, less range of sizes does.
    const auto n = samples[0].value.rows();
    const Eigen::MatrixXd from_tail = Eigen::MatrixXd::Constant(n, n, 2.0 * (tail.x + tail.y));
    if (worst_error(box, kind, samples, from_tail) <= 0.1 * ladder.error) {
      if (!is_hopeless(kind, samples, tolerance)) ladder.outcome = nodes.steeper();
      return ladder;
    }
    const bool in_x = tail.x >= tail.y;
    if ((in_x ? nx : ny) >= kHighestDegree) {
      ladder.outcome = in_x ? BoxOutcome::split_x : BoxOutcome::split_y;
      return ladder;
    }
    (in_x ? nx : ny) *= 2;
  }
}

}  // namespace strutt
