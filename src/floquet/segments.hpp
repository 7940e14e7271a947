#pragma once

#include <vector>

#include "strutt/model/periodic_function.hpp"

namespace strutt {

/// A sub-interval of the phase on which the coefficient is smooth.
struct Segment {
  double from = 0.0;
  double to = 0.0;
};

/// [from, to] cut at the jumps of w, and at `cut` if it lies inside.
std::vector<Segment> smooth_pieces(const PeriodicFunction& w, double from, double to, double cut);

/// The pieces cut so often that in each part a solution of Y'' + w Y = 0 grows by at most about exp(8)
/// (numerical extremes N1, N15) and turns by at most 8 radians: the time is local to the part, and its
/// rounding in each step then costs little phase (N13, N16). Empty where that takes more than kMostSegments.
inline constexpr double kMostSegments = 10'000;
std::vector<Segment> subdivided(const std::vector<Segment>& pieces, const PeriodicFunction& w);

}  // namespace strutt
