#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

namespace strutt {

/// The equilibrium about which an equation is linearised.
enum class Equilibrium { hanging, inverted };

/// A rigid body that turns about a pivot on a vertically moving support (paper, Fig. 1 and eqs. 1-7).
/// The angle phi is measured from the hanging position, anticlockwise; y points up; SI units throughout.
struct PhysicalPendulum {
  double mass = 1.0;      ///< m, kg, > 0
  double inertia = 0.0;   ///< Theta about the pivot, kg m^2, >= m s^2
  double centroid = 0.0;  ///< s, distance from the pivot to the centroid, m, > 0
  double gravity = 9.81;  ///< g, m/s^2, > 0
  double damping = 0.0;   ///< c, the coefficient of phi' in (7), 1/s, >= 0

  /// The uniform rod of the paper: s = l/2, Theta = m l^2/3, alpha^2 = 3 g/(2 l).
  static PhysicalPendulum uniform_rod(double mass, double length, double gravity = 9.81,
                                      double damping = 0.0);

  /// All mass at distance `length`: s = l, Theta = m l^2, alpha^2 = g/l.
  static PhysicalPendulum point_mass(double mass, double length, double gravity = 9.81, double damping = 0.0);

  /// Throws InvalidInput naming the first field outside the ranges above.
  void validate() const;

  double alpha_squared() const;  ///< m g s/Theta, 1/s^2
  double alpha() const;          ///< angular eigenfrequency of small free oscillations, rad/s
  double period() const;         ///< T0 = 2 pi/alpha, s

  /// Centroid (x, y) for the support at height r (1), and its velocity for support velocity r' (2).
  Eigen::Vector2d centroid_position(double angle, double support) const;
  Eigen::Vector2d centroid_velocity(double angle, double rate, double support_velocity) const;

  /// T = m |v_S|^2/2 + (Theta - m s^2) phi'^2/2 (3), J.
  double kinetic_energy(double angle, double rate, double support_velocity) const;
  /// U = m g y_S (4), J.
  double potential_energy(double angle, double support) const;

  /// phi'' of (7): M/Theta - c phi' - alpha^2 (1 + r''/g) sin(phi), rad/s^2.
  double angular_acceleration(double angle, double rate, double support_acceleration, double moment) const;
  /// Vertical force of the support on the body, m (y_S'' + g), N; its power is force * r'.
  double support_force(double angle, double rate, double angular_acceleration,
                       double support_acceleration) const;

  /// The roots lambda of lambda^2 + c lambda +- alpha^2 = 0 about the equilibrium (+ hanging, - inverted),
  /// larger real part (then larger imaginary part) first; the small root without cancellation.
  std::array<std::complex<double>, 2> characteristic_roots(Equilibrium about) const;
};

}  // namespace strutt
