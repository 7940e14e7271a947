#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "chart/propagator_sample.hpp"
#include "strutt/chart/axis.hpp"
#include "strutt/floquet/monodromy.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// Canonical kappa of an equation from |mean| of its coefficient.
inline double canonical_kappa(double kappa_square) { return std::max(1.0, std::sqrt(kappa_square)); }

/// A point of a chart as the equation of y = exp(ct/2) x, seen from an even point of its coefficient if it
/// has one: Y'' + W(theta) Y = 0 (canonical time).
struct PointEquation {
  HillEquation equation;      ///< undamped; the shift by -c^2/4 is in its mean
  double half_damping = 0.0;  ///< h = cT/2
  bool shifted = false;       ///< the even point is not the phase 0
  double kappa = 1.0;         ///< canonical kappa of the equation of x, canonical_kappa(kappa_square)
  double kappa_square = 0.0;  ///< |mean of its coefficient|; 0 where kappa is 1 whatever that is
};

/// One thread's scene with two parameters in place, and the engine for its points. Not copied: it points into
/// itself.
class HillModel {
 public:
  HillModel(const Scene& scene, const Axis& x, const Axis& y, const std::optional<double>& even_phase);
  HillModel(const HillModel&) = delete;

  /// Nothing where the parameters make no Hill equation with a smooth coefficient, even about the phase if
  /// there is one.
  std::optional<PointEquation> at(double x, double y);

  /// The propagator from the engine, its scaled error at most about `tolerance` where that can be reached.
  PropagatorSample sample(double x, double y, double tolerance, const std::atomic<bool>* cancel);

 private:
  Scene scene_;
  double* x_;
  double* y_;
  std::optional<double> even_phase_;
  MonodromyEngine engine_;
};

}  // namespace strutt
