#pragma once

#include "strutt/model/periodic_function.hpp"

namespace strutt {

/// The angle, from the V axis towards Y in the plane (V = Y'/kappa, Y), through which the solution of
/// Y'' + W Y = 0 that starts as (Y, V) = (0, 1) turns while theta goes from 0 to `length`. Its end (y, v) is
/// known, and with it the angle up to whole turns; these are counted by a product of exact propagators of a
/// piecewise-constant approximation of W, refined until it lies within a quarter turn. NaN if it cannot be
/// counted.
double lifted_angle(const PeriodicFunction& w, double length, double y, double v, double kappa);

}  // namespace strutt
