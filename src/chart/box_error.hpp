#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "chart/propagator_sample.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {

// The rounding of nodes is independent from one to the next, and the squares of the Lagrange polynomials of
// Chebyshev points sum to at most 1: it does not grow between nodes. Their truncation is as smooth as the
// factors and does not either.
inline constexpr double kNodeErrorGrowth = 2.0;
inline constexpr double kShareAtNodes = 0.4;   // of the tolerance: between nodes the factors can be smaller
inline constexpr double kShareAfterCut = 0.8;  // the same, once coefficients that do not matter are dropped
inline constexpr int kFirstDegree = 8, kHighestDegree = 64;

/// How many of the last coefficients stand for what lies beyond them.
Eigen::Index tail_length(Eigen::Index coefficients);

/// Bound of the rounding of the transform from values up to `largest` at nx + ny nodes: it errs like a random
/// walk of its terms.
double transform_error(int nx, int ny, double largest);

/// Unit and state of a box from its samples: kappa of the one in the middle, the largest exponent.
void set_unit(SurrogateBox& box, const PropagatorSample& middle, std::span<const PropagatorSample> samples);

/// The samples in the unit and the state of the box.
std::vector<PointPropagator> in_unit_of(const SurrogateBox& box, std::span<const PropagatorSample> samples);

/// The largest scaled error of M at the samples with these bounds of the entries, in the unit of the box.
double worst_error(const SurrogateBox& box, SurrogateKind kind, std::span<const PropagatorSample> samples,
                   const Eigen::MatrixXd& error);

/// Whether most samples miss the tolerance by their own errors, whatever stands beside them: a smaller box
/// would not help.
bool is_hopeless(SurrogateKind kind, std::span<const PropagatorSample> samples, double tolerance);

/// Log of the size of a propagator, in the state scaled by the box's kappa.
double log2_size(const PropagatorSample& sample, double kappa);

}  // namespace strutt
