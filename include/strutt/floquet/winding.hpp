#pragma once

#include "strutt/floquet/verdict.hpp"
#include "strutt/model/periodic_function.hpp"

namespace strutt {

/// The winding number of Y'' + W Y = 0: turns of the solution in the plane (Y, Y') per period, that is the
/// imaginary part of the characteristic exponent times T/(2 pi), unwrapped. n/2 inside tongue n, strictly
/// between neighbouring halves in the stable regions; non-decreasing in the mean of W.
///
/// The fraction comes from the discriminant (cos of 2 pi winding = D/2). The number of half turns comes from
/// the angle of the solution that starts as (0, 1): known from N up to whole turns, which are counted by a
/// product of exact propagators of a piecewise-constant approximation of W, refined until it lies within a
/// quarter turn of that angle. NaN if it cannot be counted (the matrix is not finite, or more than about 1e6
/// turns).
double winding_number(const PeriodicFunction& w, const BoundedMatrix2& undamped,
                      const DiscriminantGap& discriminant, double kappa);

}  // namespace strutt
