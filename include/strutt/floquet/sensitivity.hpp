#pragma once

#include <limits>
#include <string_view>

#include "strutt/floquet/monodromy.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// A derivative with respect to a parameter, per unit of it, with a first-order bound of its error. NaN where
/// it does not exist.
struct Derivative {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::infinity();
};

/// How the stability of a scene changes with one of its parameters p.
struct Sensitivity {
  Derivative growth;           ///< of ln of the spectral radius per period
  Derivative growth_per_time;  ///< of growth/T
  Derivative winding;          ///< of the winding number; 0 inside a tongue, NaN for more than two states
  Derivative margin;           ///< of 1 - |D|/(2 cosh(cT/2)); NaN for more than two states
  /// On an edge of stability: proportional to the speed at which p carries the point across it, with the same
  /// factor for every parameter, so that a change of p' moves the edge along p by -edge(p')/edge(p) of it.
  Derivative edge;
  Outcome outcome = Outcome::failed;
};

/// Exact sensitivities, from the variational equations: with S = dq/dp,
///   [M 0; M_p M] (q, S)'' + [C 0; C_p C] (q, S)' + [K 0; K_p K] (q, S) = 0
/// is a system like any other, in the phase so that a change of the period is one of M and C. Its monodromy
/// matrix holds dM/dp = M(T) * integral of M(t)^-1 A_p M(t) dt beside M; square waves in closed form piece by
/// piece.
///
/// Hill's equation, N with det N = 1 of y = exp(ct/2) x and D = trace N: dD/dp = trace(dN/dp) = trace((N -+
/// 1) G), G = N^-1 dN/dp, the second without cancellation beside an edge. Then
///   growth  sign(D) dD/sqrt(D^2 - 4) - d(cT/2)    in a tongue, -d(cT/2) between tongues,
///   winding -dD/(4 pi sin(2 pi winding)),
///   edge    integral of W_p X^2 over a period, X the solution that is periodic on the edge, where W is even
///   and
///           there is no damping: right in the thinnest tongues; else that of 2 cosh(cT/2) - |D|.
/// Systems: d ln|lambda| = Re(y M_p x/(lambda y x)) with left and right eigenvectors, of the largest
/// multiplier; NaN where several have the largest modulus and their moduli would not stay equal. `edge` is
/// then that of -growth.
///
/// On an edge growth and winding have infinite slopes there; the values are then as large as rounding leaves
/// them. Throws InvalidInput for an unknown path and what linear_model refuses.
Sensitivity sensitivity(MonodromyEngine& engine, const Scene& scene, std::string_view path,
                        const MonodromyOptions& options = {.tolerance = 1e-12});

/// How far an edge of stability on the line `along` moves for a change of the parameter `by`:
/// d(position)/d(by), at a scene that lies on the edge; -edge(by)/edge(along), and its error. 0 for
/// `along` itself, NaN where the edge has no such slope.
Derivative edge_shift(MonodromyEngine& engine, const Scene& on_edge, std::string_view along,
                      std::string_view by, const MonodromyOptions& options = {.tolerance = 1e-12});

}  // namespace strutt
