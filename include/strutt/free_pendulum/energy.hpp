#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <string_view>

namespace strutt {

// The free pendulum phi'' + alpha^2 sin(phi) = 0 ((7) without support, moment and damping). Time is tau =
// alpha t and velocity is v = phi'/alpha throughout this header; angles in rad from the hanging position.

/// What an orbit does.
enum class MotionKind {
  equilibrium,  ///< at rest at the bottom: separatrix excess -4
  libration,    ///< swings between -amplitude and amplitude
  separatrix,   ///< excess exactly 0: tends to the top, or rests there
  rotation,     ///< turns over and over
  unresolved,   ///< the excess is not 0, but smaller than its error bound (about 1e-30)
};
std::string_view to_string(MotionKind kind);

/// The first integral (9) of an orbit, v^2 - 2 cos(phi) = C1, and what follows from it. The primary quantity
/// is the
///   separatrix excess E = C1 - 2 = v^2 - 4 cos^2(phi/2) = (v - 2 cos(phi/2)) (v + 2 cos(phi/2)),
/// formed from the factors: it keeps its digits next to the separatrix (numerical extremes N25, N26).
struct EnergyIntegral {
  double separatrix_excess = -4.0;  ///< E >= -4; +inf if v^2 is beyond double
  double error = 0.0;               ///< bound of |E - true E|, for the inputs taken as exact
  MotionKind kind = MotionKind::equilibrium;
  double maximal_velocity = 0.0;  ///< sqrt(4 + E) = 2 k (libration), at the bottom; relative error <= 2^-52
  double minimal_velocity = 0.0;  ///< of |v|: sqrt(E), at the top, for rotations; else 0; error as that of E
  double amplitude = 0.0;  ///< libration: the turning points are at +-amplitude; separatrix: pi; else NaN
  double from_top = 0.0;   ///< libration: pi - amplitude without cancellation; else 0

  double constant() const { return separatrix_excess + 2.0; }  ///< the paper's C1
};

/// The orbit through (phi, v). For phi != 0 cos(phi/2) is transcendental, so the separatrix is met exactly
/// only by phi = 0, |v| = 2; elsewhere the sign of E is certain when |E| exceeds the error of cos(phi/2),
/// 1e-30. v up to 1e308 (N27). Throws InvalidInput unless |phi| <= 1e9 and v is finite.
EnergyIntegral energy_integral(double angle, double velocity);

/// The orbits of a given excess, taken as exact. Throws InvalidInput unless E >= -4 and finite.
EnergyIntegral energy_integral(double separatrix_excess);

/// The equilibrium phi = index pi: a centre for even, a saddle for odd index. Eigenvalues and eigenvectors
/// (columns) are those of (phi, phi')' = [0 1; -+alpha^2 0] (phi - index pi, phi'): lambda = +-i alpha,
/// +-alpha, vectors (1, lambda). Of a saddle, the vector of +alpha is tangent to the unstable and that of
/// -alpha to the stable manifold, which is the separatrix. Throws InvalidInput unless alpha is finite and >
/// 0.
struct EquilibriumPoint {
  enum class Type { centre, saddle };
  double angle = 0.0;
  Type type = Type::centre;
  std::array<std::complex<double>, 2> eigenvalues;  ///< +, then -; 1/s for alpha in rad/s
  Eigen::Matrix2cd eigenvectors;
};
EquilibriumPoint equilibrium_point(int index, double alpha);

/// The separatrix that passes the bottom at tau = 0 upwards:
///   phi = 2 gd(tau) = 2 atan(sinh tau), v = 2 cos(phi/2) = 2 sech(tau), tau = asinh(tan(phi/2)).
/// The lower branch is (-phi, -v). Relative errors <= 4 ulp; separatrix_time throws InvalidInput unless |phi|
/// < pi.
double separatrix_angle(double tau);
double separatrix_velocity(double tau);
double separatrix_time(double angle);

}  // namespace strutt
