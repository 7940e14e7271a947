#pragma once

#include <optional>
#include <vector>

#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/model/periodic_function.hpp"

namespace strutt {

inline constexpr int kLargestTongue = 1000;

/// Tongue n of X'' + (mean + V(theta)) X = 0, V of period 2 pi and mean zero: the equation is unstable for
/// lower < mean < upper, and has a solution of period 2 pi (n even) or antiperiod 2 pi (n odd) at both edges.
/// Tongue 0 has no lower edge.
struct TongueEdges {
  int order = 0;
  std::optional<CharacteristicValue> lower;
  CharacteristicValue upper;
};

/// The edges of the tongues first <= n <= last, as values of the mean; V is `coefficient` without its own
/// mean.
///
/// The Fourier coefficients of the solutions make -X'' - V X = mean X an eigenvalue problem of a Hermitian
/// banded matrix: exponent 0 for even n, 1/2 for odd n, its eigenvalues paired by order; if V is even about
/// some phase, two real ones for each, of cosines and of sines, and each edge has an index of its own. The
/// matrix is not truncated: what lies outside a finite core is positive definite there, and its Schur
/// complement enters the core with a proved enclosure. LAPACK's eigenvalues of the core lead to the edge; two
/// counts of negative pivots, below and above it, prove index and value (where the elimination loses too much
/// for that, a generous estimate of LAPACK's error stands in).
///
/// `error` bounds truncation, rounding and iteration. With sum |V_k| the sum of the amplitudes of the
/// harmonics, it is some 1e-14 of 1 + sum |V_k| + n^2/4 for few harmonics and sums to 10, up to 5e-13 of it
/// at 5000. Edges closer than that are not told apart: lower may pass upper within their errors. Cost: that
/// of about four banded eigenvalue problems with n + 4 sqrt(sum |V_k|) rows for each edge.
///
/// A square wave (Meissner) has closed forms: each edge is a zero of one half-period factor, a product of two
/// constant propagators, its index told by Pruefer's angle and its error by the sign of the factor on both
/// sides.
///
/// Throws InvalidInput unless 0 <= first <= last <= 1000, V has finitely many harmonics or is a square wave
/// (none of its antiderivatives) and sum |V_k|, the amplitude of the square wave, is at most 1e6. Source:
/// Magnus, Winkler, Hill's Equation (1966), chapters 1 and 2.
std::vector<TongueEdges> tongue_edges(const PeriodicFunction& coefficient, int first, int last);

/// The mean at which X'' + (mean + V) X = 0 has this winding number: a curve of constant exponent between two
/// tongues, n/2 < winding < (n + 1)/2. It is eigenvalue n of the same matrix with the exponent i winding.
/// Bound and cost as above. Throws InvalidInput unless 0 < winding < 500 and 2 winding is not an integer.
CharacteristicValue mean_of_winding(const PeriodicFunction& coefficient, double winding);

}  // namespace strutt
