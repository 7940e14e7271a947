#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "strutt/floquet/verdict.hpp"

namespace strutt {

/// Points of [from, to], both ends and the middle included, between neighbours of which a smooth function
/// changes its sign once at most. (The middle, for ends where it is 0 and the caller knows on which side.)
///
/// An interval is halved until the interpolant through its nine Chebyshev points shows that the function has
/// one sign, is monotone, or is convex or concave there; in the last case its extremum joins the points if it
/// may reach beyond zero. The last two coefficients bound what the interpolant leaves out, with their
/// derivatives by Markov's inequality; coefficients below the error of the function are dropped. A bound by
/// coefficients is none for every function: what is missed is a feature between nine points that leaves no
/// trace in them. Intervals shorter than 1e-9 of the whole are not halved.
std::vector<double> sign_pieces(const std::function<Margin(double)>& function, double from, double to,
                                const std::atomic<bool>* cancel);

}  // namespace strutt
