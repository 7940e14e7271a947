#pragma once

#include <array>
#include <optional>
#include <string>

#include "strutt/chart/axis.hpp"
#include "strutt/floquet/monodromy.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// A point of a chart as the equation of y = exp(ct/2) x, seen from an even point of its coefficient:
/// Y'' + W(theta) Y = 0 with W a sum of cosines (canonical time).
struct CentredEquation {
  HillEquation equation;      ///< undamped; the shift by -c^2/4 is in its mean
  double half_damping = 0.0;  ///< h = cT/2
  bool shifted = false;       ///< the even point is not the phase 0
  double kappa = 1.0;         ///< canonical kappa of the equation of x, max(1, sqrt(kappa_square))
  double kappa_square = 0.0;  ///< |mean of its coefficient|; 0 where kappa is 1 whatever that is
};

/// The half-period factors of one point, [u1, u2; u1', u2'] = value * 2^exponent, canonical time, with
/// bounds.
struct HalfPeriodSample {
  std::array<double, 4> value{};  ///< u1, u2, u1', u2'
  std::array<double, 4> error{};
  long exponent = 0;
  double half_damping = 0.0, kappa = 1.0;
  bool shifted = false;  ///< seen from another phase than 0
  long right_hand_sides = 0;
  bool valid = false;
};

/// The phase about which the coefficient is even at every corner and in the middle of the chart. Where there
/// is none, or the scene does not fit otherwise, `reason` says why.
struct EvenPoint {
  double phase = 0.0;
  std::string reason;  ///< empty: the scene fits
};
EvenPoint even_point(const Scene& scene, const Axis& x, const Axis& y);

/// One thread's scene with two parameters in place, and the engine for its points. Not copied: it points into
/// itself.
class HalfPeriodModel {
 public:
  HalfPeriodModel(const Scene& scene, const Axis& x, const Axis& y, double even_phase);
  HalfPeriodModel(const HalfPeriodModel&) = delete;

  /// Nothing where the parameters do not make a model or the coefficient is not even about the phase.
  std::optional<CentredEquation> at(double x, double y);

  /// The factors from the engine, their scaled error at most about `tolerance` where that can be reached.
  HalfPeriodSample sample(double x, double y, double tolerance, const std::atomic<bool>* cancel);

 private:
  Scene scene_;
  double* x_;
  double* y_;
  double even_phase_;
  MonodromyEngine engine_;
};

}  // namespace strutt
