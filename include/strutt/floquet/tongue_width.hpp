#pragma once

#include "strutt/floquet/tongue_edges.hpp"

namespace strutt {

/// How wide a tongue is: the true width lies within value (1 +- relative_error). A relative error of 1 or
/// more means that the tongue may be closed, down to 2 value; 0 with the error 0: it is closed, proved.
struct TongueWidth {
  double value = 0.0;
  double relative_error = 0.0;
};

/// The relative error that is aimed at.
inline constexpr double kWidthAccuracy = 1e-11;

/// upper - lower of a tongue of X'' + (mean + V) X = 0 (n >= 1), to a relative error of 1e-11 however narrow
/// it is.
///
/// Tongue n of Mathieu's equation is about epsilon^n wide; the difference of two doubles says nothing about
/// it. So all Fourier modes but the two that resonate, exp(+-i n theta/2), are eliminated. What is left of
/// the matrix minus x is
///   [h(x)  beta(x); conj(beta(x))  h(x)],    h' <= -1,
/// the edges are where h = +-|beta|, and
///   width = (|beta(lower)| + |beta(upper)|)/|h'| with h' somewhere between them,
/// a number without cancellation. beta is the way from one mode to the other through all others. Everything
/// is computed with balls (multi-precision midpoint and radius: the result is proved, as far as the edges
/// are), at 34, 110 and 350 digits until the relative error is reached. `coefficient_error` bounds the
/// relative error of each coefficient of V: the balls of the harmonics hold it, so that what is left of ways
/// that cancel is as uncertain as they are (34 digits are then all that is of use). Where it never is, the
/// tongue is taken for closed (coexistence): the relative error is then 1 and 2 value is a bound.
///
/// A square wave has a closed form: both edges in the sum s1 + s2 of the frequencies of its pieces, without
/// cancellation (below mean = amplitude, where tongues are wide, by subtraction); some 1e-15 but next to a
/// closed tongue.
///
/// Cost: 0.1 to 1 ms for one harmonic. Widths below 1e-300 lose digits as doubles do; relative_error says so.
/// Throws as tongue_edges.
TongueWidth tongue_width(const PeriodicFunction& coefficient, const TongueEdges& edges,
                         double coefficient_error = 0.0);

/// The largest growth inside a narrow tongue, ln of the spectral radius per period: in its middle, to lowest
/// order in the width,
///   2 pi |beta|/|dh/dnu| = pi width |h'|/|dh/dnu|,
/// nu the exponent. Its relative error is that of the width plus about the square of the width over the
/// distance to the next tongue. 0 for a closed tongue.
double narrow_tongue_growth(const PeriodicFunction& coefficient, const TongueEdges& edges,
                            const TongueWidth& width);

}  // namespace strutt
