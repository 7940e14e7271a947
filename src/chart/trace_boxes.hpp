#pragma once

#include <vector>

#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// What is known of all cells besides their factors.
struct TraceScale {
  double least_kappa = 1.0, largest_kappa = 1.0;  ///< canonical
  bool damped = false;
  bool shifted = false;  ///< see FactorScale
};

/// For charts that show nothing but the discriminant: in each box of half-period factors D = 2 (u1 u2' + u1'
/// u2), with the powers of two in it, becomes one function of its own, where its bound stays below the
/// tolerance. Such boxes have a single function; the others stay as they are.
std::vector<SurrogateBox> trace_boxes(const std::vector<SurrogateBox>& boxes, double tolerance,
                                      const TraceScale& scale);

/// A bound of the error of D itself in such a box, from that relative to M and the box of the factors.
double trace_bound(double error, const SurrogateBox& factors, const TraceScale& scale);

}  // namespace strutt
