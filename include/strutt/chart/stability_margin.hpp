#pragma once

#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/base/outcome.hpp"
#include "strutt/floquet/verdict.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

struct MarginOptions {
  double tolerance = 1e-12;  ///< largest `error` wanted, 1e-13 <= tolerance <= 1e-2
  /// How far edges are looked for, >= 2: from p/reach to p reach for parameters that have one sign only, from
  /// p - reach |p| to p + reach |p| for others, and to +-reach from p = 0.
  double reach = 100.0;
  int threads = 0;  ///< 0: all; the result does not depend on it
  const std::atomic<bool>* cancel = nullptr;
};

/// How far one parameter is from the edges of stability, all others kept.
struct ParameterMargin {
  std::string parameter;
  double value = 0.0;
  std::optional<double> lower_edge, upper_edge;  ///< the nearest edge below and above; nothing within reach
  /// From the value to the nearer edge, in the unit of the parameter: positive from a stable design, negative
  /// from an unstable one, 0 on the edge; +-inf if there is no edge within reach.
  double distance = std::numeric_limits<double>::infinity();
  double relative_distance =
      std::numeric_limits<double>::quiet_NaN();  ///< distance/|value|; NaN for the value 0
  std::optional<int> tongue;                     ///< that the nearer edge belongs to; nothing for systems
  double error = 0.0;  ///< bound of the error of the nearer edge, divided by max(1, |edge|)
  Method method = Method::fourier;
  Outcome outcome = Outcome::converged;
};

/// How far all parameters together are from the edge: the smallest r = sqrt(sum_i ((p_i' - p_i)/p_i)^2) of a
/// change that reaches it, over the parameters among those asked for that are not 0 and belong to
/// stability_parameters. Never more than the smallest relative_distance of one alone.
struct JointMargin {
  double distance =
      std::numeric_limits<double>::infinity();  ///< r, with the sign of ParameterMargin::distance
  std::optional<int> tongue;
  std::vector<std::string> parameters;  ///< those that take part
  std::vector<double> edge;             ///< their values on the nearest edge; empty if there is none
  double error = 0.0;  ///< of r: that of the edge along the ray, and r tan^2 of its angle to the normal
  Method method = Method::fourier;
  Outcome outcome = Outcome::converged;
};

struct StabilityMargin {
  Verdict verdict = Verdict::unresolved;  ///< of the design
  std::vector<ParameterMargin> parameters;
  JointMargin joint;
};

/// The parameters of a scene that move its stability, in the order of the file. Of a system whose multipliers
/// are reciprocal (symmetric, damping c mass) only those that leave it so.
std::vector<std::string> stability_parameters(const Scene& scene);

/// The distances of a design to the nearest edges of stability.
///
/// Along one parameter: windows that grow from the value outwards are searched for unstable intervals until
/// one has an edge. Undamped equations of second order, with finitely many harmonics or a square wave, by
/// tongues(): no edge is missed, however thin its tongue. Elsewhere by the sign of the margin, at 32 points a
/// window and at its minima between them: a tongue narrower than that may be missed; edges that are found lie
/// between certain verdicts.
///
/// Jointly, undamped with finitely many harmonics: the stable region of the design is bounded by two
/// surfaces, F = mean(W) - e(V) = 0 with the upper edge e of the tongue below and the lower edge of that
/// above (an unstable one: the two edges of its tongue). Elsewhere F is the margin. The nearest point of F =
/// 0 has its ray along the normal: the direction is turned into the normal (sensitivity.hpp), by BFGS, as
/// long as the ray becomes shorter, from edges found along one parameter and from the gradient at the design.
/// Then points with F <= 0 are looked for on the sphere of 0.999 times that length, among 512 pseudo-random
/// directions and the axes and by descents of F from the best twelve that are apart, and the search begins
/// again from each. The result is an edge for certain, and its error that of its distance; that no edge is
/// nearer is not proved.
///
/// Distance NaN, with outcome tolerance_not_reached: the search would pass more than kLargestTongue tongues
/// of an undamped equation. A design on the edge (boundary, or unresolved) has the distance 0; unresolved:
/// with outcome tolerance_not_reached. Throws InvalidInput for an unknown parameter, a scene that does not
/// validate, options out of range.
StabilityMargin stability_margin(const Scene& scene, const std::vector<std::string>& parameters,
                                 const MarginOptions& options = {});

}  // namespace strutt
