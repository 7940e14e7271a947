#pragma once

#include <vector>

#include "strutt/base/bounded_matrix.hpp"
#include "strutt/floquet/monodromy.hpp"

namespace strutt {

/// The propagator of an equation Y'' + W Y = 0 over an interval mirrored about an even centre of W: for det P
/// = 1 it is J P^-1 J with J = diag(1, -1), that is P with its diagonal swapped.
BoundedMatrix2 mirrored(BoundedMatrix2 propagator);

/// N over a whole period from the propagators of the half period [theta0, theta0 + pi], in order; the first
/// `before` of them cover [theta0, 2 theta0], the mirror image of [0, theta0].
BoundedMatrix2 period_from_half(const std::vector<BoundedMatrix2>& half, std::size_t before);

/// M = exp(-h) L N L^-1 with slope = c/(2 kappa); see BasicMonodromy.
template <typename Matrix>
BasicBoundedMatrix<Matrix> restore_damping(const BasicBoundedMatrix<Matrix>& undamped, double half_damping,
                                           double slope);

/// A computation that ended before it had anything to show.
template <typename Matrix>
BasicMonodromy<Matrix> without_result(Method method, Outcome outcome) {
  BasicMonodromy<Matrix> result;
  result.method = method;
  result.outcome = outcome;
  return result;
}

/// BasicMonodromy::error of a matrix.
template <typename Matrix>
double scaled_error(const BasicBoundedMatrix<Matrix>& matrix);

/// |det P - 1|/|P|^2 of a 2 x 2 propagator, the determinant by Kahan's fused formula.
double determinant_defect(const BoundedMatrix2& propagator);

}  // namespace strutt
