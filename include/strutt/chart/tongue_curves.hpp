#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "strutt/chart/tongues.hpp"

namespace strutt {

/// A point of the edge of a tongue in the plane of two parameters.
struct CurvePoint {
  enum class Kind : signed char {
    lower,  ///< the tongue lies at larger values of the first parameter
    upper,
    tip,  ///< where the curve turns back: extremal in the second parameter
  };
  Kind kind = Kind::lower;
  double along = 0.0;  ///< value of the first parameter
  double over = 0.0;   ///< value of the second
  /// Of `along`, as TongueEdge::error; at a tip that of `over`, relative to max(1, |over|), but where nothing
  /// is excited, which is known exactly, that of `along`.
  double error = 0.0;
  Mechanism mechanism = Mechanism::plus_one;
  Method method = Method::fourier;
  Outcome outcome = Outcome::converged;
};

/// As written to files: `lower`, `upper`, `tip`.
std::string_view to_string(CurvePoint::Kind kind);

/// A piece of the edge of a tongue without gaps, its points in order.
struct TongueCurve {
  int order = 0;  ///< kNoOrder for systems
  std::vector<CurvePoint> points;
};

struct CurveOptions {
  double tolerance = 1e-12;  ///< largest `error` wanted of a point, 1e-13 <= tolerance <= 1e-2
  /// Straight lines between the points leave the curve by no more than this part of the window, 1e-6 <= chord
  /// <= 0.1.
  double chord = 1e-3;
  bool log_along = false, log_over = false;  ///< parts of the window are those of the parameter's logarithm
  int count = 0;                             ///< tongues n = 0 ... count - 1; 0: all that the window can meet
  int slices = 16;           ///< steps of the second parameter that the search begins with, >= 1
  int system_steps = 250;    ///< see TongueOptions
  double resolution = 1e-7;  ///< see TongueOptions; edges that touch a line take long at 1e-9
  /// Of all tongues together: margins of stability and, in proportion to their cost, which grows with the
  /// order of the harmonics, edges of undamped tongues and the widths that narrow damped ones need.
  std::int64_t max_evaluations = std::numeric_limits<std::int64_t>::max();
  int threads = 1;  ///< 0: one per core
  const std::atomic<bool>* cancel = nullptr;
};

/// The edges of all tongues as curves over two parameters, by order.
///
/// The window is cut into lines along the first parameter at values of the second; each gives all edges of a
/// tongue, with its index (tongues()), so no curve can be taken for another and none folds over itself. The
/// edges of neighbouring lines are joined in their order. Lines are added in the middle until every edge
/// there lies within `chord` of the straight line between its neighbours. Where edges appear between two
/// lines in pairs the curve turns back: as the distance of the pair grows with the square root, its square is
/// followed to the tip by the secant method. A closed curve, or a tip and back, between two of the first
/// lines may be missed. Without damping, and without excitation at over.from or over.to, both edges of a
/// tongue meet there: that is a tip, too.
///
/// Systems: pairs of edges closer than 1e-6 of the line, or than `resolution`, are left out. Without damping,
/// and without excitation at over.from, tongues begin there with a tip at T (w_i + w_j) = 2 pi k, w_i the
/// frequencies of the system at rest, if that is within four `chord` of where the tongue first shows: in a
/// straight line, which a tongue that leaves its resonance like a parabola then follows within `chord`. The
/// crossing of two tongues is a tip, too.
///
/// Cost: that of tongues() for some 30 to 60 values of the second parameter. Throws InvalidInput as tongues()
/// at both ends of `over`, for a logarithm of a range with 0, and where only one of them has tongues with an
/// index; NumericalFailure where max_evaluations are not enough.
std::vector<TongueCurve> tongue_curves(const Scene& scene, const TongueLine& along, const TongueLine& over,
                                       const CurveOptions& options = {});

}  // namespace strutt
