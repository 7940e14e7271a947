#include "strutt/model/pendulum.hpp"

#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"

namespace strutt {

PhysicalPendulum PhysicalPendulum::uniform_rod(double mass, double length, double gravity, double damping) {
  require(length > 0.0 && std::isfinite(length), "length", length, "a finite number > 0");
  return {mass, mass * length * length / 3.0, length / 2.0, gravity, damping};
}

PhysicalPendulum PhysicalPendulum::point_mass(double mass, double length, double gravity, double damping) {
  require(length > 0.0 && std::isfinite(length), "length", length, "a finite number > 0");
  return {mass, mass * length * length, length, gravity, damping};
}

void PhysicalPendulum::validate() const {
  const auto positive = [](const char* name, double value) {
    require(value > 0.0 && std::isfinite(value), name, value, "a finite number > 0");
  };
  positive("mass", mass);
  positive("inertia", inertia);
  positive("centroid", centroid);
  positive("gravity", gravity);
  require(damping >= 0.0 && std::isfinite(damping), "damping", damping, "a finite number >= 0");
  require(inertia >= mass * centroid * centroid * (1.0 - 1e-12), "inertia", inertia,
          "at least mass * centroid^2 = " + to_text(mass * centroid * centroid) + " (Steiner)");
}

double PhysicalPendulum::alpha_squared() const { return mass * gravity * centroid / inertia; }
double PhysicalPendulum::alpha() const { return std::sqrt(alpha_squared()); }
double PhysicalPendulum::period() const { return 2.0 * std::numbers::pi / alpha(); }

Eigen::Vector2d PhysicalPendulum::centroid_position(double angle, double support) const {
  return {centroid * std::sin(angle), support - centroid * std::cos(angle)};
}

Eigen::Vector2d PhysicalPendulum::centroid_velocity(double angle, double rate,
                                                    double support_velocity) const {
  return {centroid * rate * std::cos(angle), support_velocity + centroid * rate * std::sin(angle)};
}

double PhysicalPendulum::kinetic_energy(double angle, double rate, double support_velocity) const {
  const double central_inertia = inertia - mass * centroid * centroid;
  return 0.5 * mass * centroid_velocity(angle, rate, support_velocity).squaredNorm() +
         0.5 * central_inertia * rate * rate;
}

double PhysicalPendulum::potential_energy(double angle, double support) const {
  return mass * gravity * centroid_position(angle, support).y();
}

double PhysicalPendulum::angular_acceleration(double angle, double rate, double support_acceleration,
                                              double moment) const {
  return moment / inertia - damping * rate -
         alpha_squared() * (1.0 + support_acceleration / gravity) * std::sin(angle);
}

double PhysicalPendulum::support_force(double angle, double rate, double angular_acceleration,
                                       double support_acceleration) const {
  const double centroid_acceleration =
      support_acceleration +
      centroid * (angular_acceleration * std::sin(angle) + rate * rate * std::cos(angle));
  return mass * (centroid_acceleration + gravity);
}

std::array<std::complex<double>, 2> PhysicalPendulum::characteristic_roots(Equilibrium about) const {
  // c^2/4 -+ alpha^2 as a product of roots and as a hypotenuse: nothing overflows at huge damping
  const double half = damping / 2.0, frequency = alpha();
  const bool hanging = about == Equilibrium::hanging;
  if (hanging && half < frequency) {
    const double damped = std::sqrt(frequency - half) * std::sqrt(frequency + half);
    return {std::complex{-half, damped}, std::complex{-half, -damped}};
  }
  const double root =
      hanging ? std::sqrt(half - frequency) * std::sqrt(half + frequency) : std::hypot(half, frequency);
  const double large = -(half + root);  // no cancellation: both terms have one sign
  const double stiffness = hanging ? alpha_squared() : -alpha_squared();
  return {std::complex{stiffness / large, 0.0},
          std::complex{large, 0.0}};  // product of the roots = stiffness
}

}  // namespace strutt
