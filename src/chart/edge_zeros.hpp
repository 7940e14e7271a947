#pragma once

#include <atomic>
#include <vector>

#include "chart/edge_function.hpp"

namespace strutt {

/// A zero of F for one edge of a tongue.
struct EdgeZero {
  bool upper = false;   ///< the edge with the larger mean
  bool rising = false;  ///< F grows with the parameter
  double position = 0.0;
};

/// All zeros of F on a line; that there are no others is proved but for pairs of zeros of the same edge
/// closer to each other than `resolution` of the line, or than the errors of F can tell apart. Throws
/// NumericalFailure where too many pieces are needed for that.
std::vector<EdgeZero> edge_zeros(EdgeFunction& function, bool upper, const TongueLine& line,
                                 double resolution, const std::atomic<bool>* cancel);

}  // namespace strutt
