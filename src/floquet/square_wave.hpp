#pragma once

#include <optional>

#include "strutt/floquet/tongue_width.hpp"

namespace strutt {

/// Meissner's equation X'' + (mean + A sign(cos theta)) X = 0, whose coefficient is even about 0: the
/// half-period factors are products of two constant propagators. With s = sqrt(mean +- A) of both pieces,
///   sigma = pi (s1 + s2)/2,  difference = pi (s1 - s2)/2 = pi A/(s1 + s2),  kappa = (s1 - s2)/(s1 + s2) = 2
///   A/(s1 + s2)^2,
/// the edges of tongue n are the zeros of
///   n even   u1' : sin sigma = -kappa sin difference,   u2 : sin sigma = +kappa sin difference,
///   n odd    u1  : cos sigma = +kappa cos difference,   u2': cos sigma = -kappa cos difference.
bool is_square_wave(const PeriodicFunction& v);

/// Both edges: indices by Pruefer's angle over half a period, which grows with the mean; the bound of the
/// error by the sign of the factor on both sides, proved by the bounds of the closed form.
TongueEdges square_wave_tongue(double amplitude, int order);

/// Whether the solution on the upper edge is even about the middle of a piece, and that on the lower one odd;
/// nothing where both edges coincide.
std::optional<bool> square_wave_upper_is_even(double amplitude, const TongueEdges& edges);

/// From the difference of sigma at both edges, arcsin(kappa sin difference) at the one plus the same at the
/// other, without cancellation; where mean < A, wide tongues, by subtraction. `amplitude_error` is relative.
TongueWidth square_wave_width(double amplitude, const TongueEdges& edges, double amplitude_error);

/// Largest growth per period: where sin (cos) sigma = 0, sinh(growth/2) = A |sin (cos) difference|/((s1 + s2)
/// sqrt(s1 s2)).
double square_wave_growth(double amplitude, const TongueEdges& edges);

}  // namespace strutt
