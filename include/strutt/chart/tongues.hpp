#pragma once

#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/base/outcome.hpp"
#include "strutt/floquet/tongue_width.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// A line through the stability chart of a scene: one parameter from `from` to `to`, from < to.
struct TongueLine {
  std::string parameter;
  double from = 0.0;
  double to = 0.0;
};

/// Which multiplier leaves the unit circle where a system becomes unstable: one through +1 or -1 (simple
/// parametric resonance), or a pair of complex ones (combination resonance).
enum class Mechanism : signed char { plus_one, minus_one, complex_pair };

/// As written to files: `+1`, `-1`, `complex`.
std::string_view to_string(Mechanism mechanism);

/// The order of a tongue of a system, which has no winding number.
inline constexpr int kNoOrder = -1;

/// Systems that are no equation of second order are looked at in so many steps of the line.
inline constexpr int kSystemSteps = 1000;

/// Where a tongue begins or ends on a line.
struct TongueEdge {
  int order = 0;       ///< n; kNoOrder for systems
  bool upper = false;  ///< the end with the larger value of the parameter
  int crossing = 0;    ///< which time the line meets this tongue, from 0
  double position = 0.0;
  double error = 0.0;  ///< bound of |position - true| / max(1, |position|)
  /// Of the tongue on the line, in the parameter; NaN where it has one edge only in the window, and for n =
  /// 0.
  double width = std::numeric_limits<double>::quiet_NaN();
  double width_relative_error = std::numeric_limits<double>::quiet_NaN();
  /// The largest growth between both edges of a pair, ln of the spectral radius per period, and where; NaN
  /// unless asked for.
  double growth = std::numeric_limits<double>::quiet_NaN();
  double growth_position = std::numeric_limits<double>::quiet_NaN();
  Mechanism mechanism = Mechanism::plus_one;  ///< of equations of second order: +1 for even n, -1 for odd
  Method method = Method::fourier;            ///< that found the position
  Outcome outcome = Outcome::converged;
};

struct TongueOptions {
  double tolerance = 1e-12;         ///< largest `error` wanted, 1e-13 <= tolerance <= 1e-2
  int count = 0;                    ///< tongues n = 0 ... count - 1; 0: all that the line can meet
  int system_steps = kSystemSteps;  ///< of a line of a system, >= 2
  double resolution = 1e-9;  ///< of the line: pairs of zeros of one edge closer than that may be missed
  bool widths = true;        ///< false: without widths, `width` NaN; faster
  bool growth = false;       ///< find the largest growth of each pair, to a relative accuracy of about 1e-6
  const std::atomic<bool>* cancel = nullptr;
};

/// Throws InvalidInput unless tongues() can work on this line, whatever the count.
void require_tongue_line(const Scene& scene, const TongueLine& line);

/// Whether tongues have an index on this line: all scenes but [linear] that is not x'' + c x' + w x = 0, c >=
/// 0.
bool has_tongue_index(const Scene& scene, const TongueLine& line);

/// The method that tongues() uses on a line: exact for square waves, fourier for all else without damping,
/// propagator with damping and for systems.
Method tongue_method(const Scene& scene, const TongueLine& line);

/// The orders that a line can meet are less than this: tongue n has mean(W) >= n^2/4 - sum of the amplitudes
/// of W. Throws InvalidInput where tongues have no index.
int tongue_count(const Scene& scene, const TongueLine& line);

/// All edges of tongues on a line, by order, then crossing, then lower before upper; those outside the line
/// are left out.
///
/// Without damping. The equation in canonical time at the value p is X'' + (mean(p) + V(p)) X = 0. Edge e of
/// tongue n, an eigenvalue with a proved index, gives F(p) = mean(p) - e(V(p)); the line is inside tongue n
/// where mean(p) lies between both edges. As |e(V) - e(V')| <= sum of |V_k - V'_k|, F has no zero in an
/// interval whose ends are further from zero than it can change inside: the line is bisected until each piece
/// is proved empty or is as short as the resolution. Square waves alike, with
/// edges in closed form.
///
/// The width in p of a pair is that of the tongue in the mean (tongue_width, relative accuracy) divided by
/// the mean slope of F between the edges; wide pairs are subtracted. A row whose width is not good to 1e-10
/// says tolerance_not_reached, unless the tongue is closed there as far as can be said (relative error 1).
///
/// With damping c >= 0, the undamped tongue of Y'' + (mean - (c/Omega)^2/4 + V) Y = 0 holds that of index n;
/// the edges are the zeros of the margin 1 - |D|/(2 cosh(cT/2)) in it, none where damping has closed it.
/// Along a parameter that moves the mean alone |D| has a single maximum there, so that none is missed. On
/// other lines ln |D| - ln(2 cosh(cT/2)), which is analytic in the undamped tongue, is interpolated in pieces
/// that are halved until it has one sign, is monotone, or is convex or concave on each (in nine Chebyshev
/// points, whose last two coefficients are taken for what is left out): an interval is missed only where the
/// function has a feature that leaves no trace in nine points. `error` reaches to where the margin is certain
/// on both sides. Beside a tip, where that is more than the tolerance or leaves the width less than 1e-10,
/// Newton's method in 50 digits encloses the edge in a few roundings of its position (coefficients below 1e4
/// in canonical time, and only with `widths`). A tongue that is open by less than the errors of the margin is
/// left out.
///
/// Tongues whose undamped width in the mean is below 2e-6, and across which h/h0 changes by less than a
/// hundredth, lie about the middle of the undamped one and have the width
///   width of the undamped tongue . sqrt(1 - (h/h0)^2),   h = cT/2, h0 = narrow_tongue_growth.
/// h0 the mean of both edges. Near the tip, h = h0, the width is as uncertain as h0 and the factor make it:
/// width_relative_error says so. A tongue that is open by less than the errors is left out.
///
/// Systems (see has_tongue_index): where the line enters and leaves what is unstable, as seen in kSystemSteps
/// steps and in the minima of the margin and of the gap between multipliers that these surround. `crossing`
/// counts the unstable intervals. Narrower ones may be missed; `error` is proved for those found, and
/// `outcome` judges it alone: widths are differences of positions. Where stability is never proved
/// (gyroscopic systems) an edge is where instability ceases to be certain, and its error a step.
///
/// Throws InvalidInput for a line that is not finite or not from < to, a scene or parameter that does not fit
/// at one of its ends, a coefficient beyond tongue_edges, and a count > 0 where tongues have no index.
std::vector<TongueEdge> tongues(const Scene& scene, const TongueLine& line,
                                const TongueOptions& options = {});

}  // namespace strutt
