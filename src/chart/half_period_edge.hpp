#pragma once

#include "chart/stability_line.hpp"
#include "strutt/chart/tongues.hpp"

namespace strutt {

/// Sharpens a change of stability of an undamped symmetric system that is even in time, through +1 or -1;
/// leaves any other as it is. With the propagator [A, B; C, D] over half a period, +1 is a multiplier where B
/// or C is singular (odd, even periodic solutions) and -1 where A or D is. Each edge of a tongue is a simple
/// zero of the determinant of one of them, whereas the margin is the product of both.
void sharpen(StabilityLine& line, StabilityChange& change, Mechanism mechanism);

}  // namespace strutt
