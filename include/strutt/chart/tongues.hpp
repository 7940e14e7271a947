#pragma once

#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <vector>

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

/// Where a tongue begins or ends on a line.
struct TongueEdge {
  int order = 0;
  bool upper = false;  ///< the end with the larger value of the parameter
  int crossing = 0;    ///< which time the line meets this tongue, from 0
  double position = 0.0;
  double error = 0.0;  ///< bound of |position - true| / max(1, |position|)
  /// Of the tongue on the line, in the parameter; NaN where it has one edge only in the window, and for n =
  /// 0.
  double width = std::numeric_limits<double>::quiet_NaN();
  double width_relative_error = std::numeric_limits<double>::quiet_NaN();
  /// The largest growth between both edges of a pair, ln of the spectral radius per period, and where; NaN unless asked for.
  double growth = std::numeric_limits<double>::quiet_NaN();
  double growth_position = std::numeric_limits<double>::quiet_NaN();
  Outcome outcome = Outcome::converged;
};

struct TongueOptions {
  double tolerance = 1e-12;  ///< largest `error` wanted, 1e-13 <= tolerance <= 1e-2
  int count = 0;             ///< tongues n = 0 ... count - 1; 0: all that the line can meet
  bool growth = false;       ///< find the largest growth of each pair, to a relative accuracy of about 1e-6
  const std::atomic<bool>* cancel = nullptr;
};

/// Throws InvalidInput unless tongues() can work on this line, whatever the count.
void require_tongue_line(const Scene& scene, const TongueLine& line);

/// The orders that a line can meet are less than this: tongue n has mean(W) >= n^2/4 - sum of the amplitudes
/// of W.
int tongue_count(const Scene& scene, const TongueLine& line);

/// All edges of tongues on a line, by order, then crossing, then lower before upper; those outside the line
/// are left out.
///
/// The equation in canonical time at the value p is X'' + (mean(p) + V(p)) X = 0. Edge e of tongue n, an
/// eigenvalue with a proved index, gives F(p) = mean(p) - e(V(p)); the line is inside tongue n where mean(p)
/// lies between both edges. As |e(V) - e(V')| <= sum of |V_k - V'_k|, F has no zero in an interval whose ends
/// are further from zero than it can change inside: the line is bisected until each piece is proved empty or
/// is as short as the resolution of the zero found next to it.
///
/// The width in p of a pair is that of the tongue in the mean (tongue_width, relative accuracy) divided by
/// the mean slope of F between the edges; wide pairs are subtracted. A row whose width is not good to 1e-10
/// says tolerance_not_reached, unless the tongue is closed there as far as can be said (relative error 1).
///
/// Throws InvalidInput for a line that is not finite or not from < to, a scene or parameter that does not fit
/// at one of its ends, [linear], damping, square waves.
std::vector<TongueEdge> tongues(const Scene& scene, const TongueLine& line,
                                const TongueOptions& options = {});

}  // namespace strutt
