#include "strutt/model/pendulum.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "strutt/base/error.hpp"
#include "strutt/integrate/integrator.hpp"
#include "strutt/model/excitation.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::pendulum_test {

using Real = boost::multiprecision::cpp_bin_float_50;

namespace {

constexpr double kUnit = 0x1p-53;

std::vector<PhysicalPendulum> bodies() {
  return {PhysicalPendulum::uniform_rod(1.3, 0.7, 9.81, 0.2),
          PhysicalPendulum::point_mass(0.4, 2.1, 1.62),
          {.mass = 3.0, .inertia = 0.9, .centroid = 0.25, .gravity = 9.81, .damping = 1.1}};
}

/// A path through given values at t = 0: phi = angle + rate t + acceleration t^2/2, and r alike.
struct Path {
  double angle, rate, support, support_rate, support_acceleration;
  Real acceleration;
  Real phi(const Real& t) const { return angle + t * (rate + t * acceleration / 2); }
  Real r(const Real& t) const { return support + t * (support_rate + t * support_acceleration / 2); }
};

Path random_path(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  return {any(random), any(random), any(random), any(random), 5.0 * any(random), any(random)};
}

/// Central difference of f(t) at t = 0 in 50 digits.
template <typename Function>
Real rate_of(Function f) {
  const Real h = 1e-12;
  return (f(h) - f(-h)) / (2 * h);
}

/// T - U (3, 4) of a body at (1), written out in 50 digits.
Real lagrangian(const PhysicalPendulum& p, const Real& phi, const Real& rate, const Real& r,
                const Real& r_rate) {
  const Real s = p.centroid, m = p.mass;
  const Real vx = s * rate * cos(phi), vy = r_rate + s * rate * sin(phi);
  const Real kinetic = m * (vx * vx + vy * vy) / 2 + (p.inertia - m * s * s) * rate * rate / 2;
  return kinetic - m * p.gravity * (r - s * cos(phi));
}

double distance(const Real& truth, double value) { return static_cast<double>(Real(abs(truth - value))); }

/// What flows into the body along a motion under support and moment: the change of T + U, the work, and the
/// parts of it.
struct Balance {
  double energy, work, support_work, scale;
};

Balance balance(const PhysicalPendulum& p, const Excitation& support, const Excitation& moment, double end) {
  const auto velocity = support.function.derivative(), acceleration = velocity.derivative();
  const double omega = support.frequency;
  const auto jumps = acceleration.breakpoints(0.0, omega * end);
  // state: phi, phi', work of everything, work of the support, integral of |power|; phase as time
  const auto f = [&](double theta, double interior, StateView y, StateOut dydt) {
    const double r1 = omega * velocity(theta), r2 = omega * omega * acceleration.piece(interior)(theta);
    const double m = moment.value(theta / omega);
    const double phi2 = p.angular_acceleration(y[0], y[1], r2, m);
    const double support_power = p.support_force(y[0], y[1], phi2, r2) * r1;
    const double power = support_power + m * y[1] - p.damping * p.inertia * y[1] * y[1];
    dydt[0] = y[1], dydt[1] = phi2, dydt[2] = power, dydt[3] = support_power, dydt[4] = std::abs(power);
    dydt /= omega;
  };
  Eigen::VectorXd start(5);
  start << 0.8, -0.3, 0.0, 0.0, 0.0;
  IntegratorOptions options;
  options.relative_tolerance = options.absolute_tolerance = 1e-13;
  Integrator integrator(5, options);
  const std::vector<double> times = {omega * end};
  const auto trajectory = integrator.trajectory(f, 0.0, start, times, jumps);
  REQUIRE(trajectory.result.outcome == Outcome::converged);
  const Eigen::VectorXd last = trajectory.states.col(0);
  const auto energy = [&](double angle, double rate, double theta) {
    return p.kinetic_energy(angle, rate, omega * velocity(theta)) +
           p.potential_energy(angle, support.function(theta));
  };
  return {energy(last[0], last[1], omega * end) - energy(start[0], start[1], 0.0), last[2], last[3], last[4]};
}

}  // namespace

TEST_CASE("Rod and point mass have the frequencies of the paper", "[model][pendulum]") {
  for (const double l : {1e-6, 0.3, 1.0, 2.7e4}) {
    for (const double g : {9.81, 1.62}) {
      for (const double m : {1e-3, 1.0, 5e5}) {
        const auto rod = PhysicalPendulum::uniform_rod(m, l, g, 0.1),
                   point = PhysicalPendulum::point_mass(m, l, g);
        CHECK(rod.alpha_squared() == Approx(3.0 * g / (2.0 * l)).epsilon(8.0 * kUnit));
        CHECK(point.alpha_squared() == Approx(g / l).epsilon(8.0 * kUnit));
        CHECK(rod.alpha() * rod.alpha() == Approx(rod.alpha_squared()).epsilon(4.0 * kUnit));
        CHECK(rod.period() * rod.alpha() == Approx(2.0 * M_PI).epsilon(4.0 * kUnit));
        CHECK(rod.centroid == l / 2.0);
        CHECK(rod.damping == 0.1);
        CHECK(point.inertia == Approx(m * l * l).epsilon(4.0 * kUnit));
        rod.validate();
        point.validate();
      }
    }
  }
  const PhysicalPendulum body{.mass = 2.0, .inertia = 0.5, .centroid = 0.25, .gravity = 8.0};
  CHECK(body.alpha_squared() == 8.0);  // 2 * 8 * 0.25/0.5
}

TEST_CASE("The velocity of the centroid is the rate of its position", "[model][pendulum]") {
  std::mt19937_64 random(5);
  for (const auto& p : bodies()) {
    for (int i = 0; i < 50; ++i) {
      const auto path = random_path(random);
      const auto x = [&](const Real& t) { return Real(p.centroid * sin(path.phi(t))); };
      const auto y = [&](const Real& t) { return Real(path.r(t) - p.centroid * cos(path.phi(t))); };
      const auto position = p.centroid_position(path.angle, path.support);
      const auto velocity = p.centroid_velocity(path.angle, path.rate, path.support_rate);
      const double size = 8.0 * kUnit * (10.0 + p.centroid * 4.0);
      CHECK(distance(x(0), position.x()) <= size);
      CHECK(distance(y(0), position.y()) <= size);
      CHECK(distance(rate_of(x), velocity.x()) <= size);
      CHECK(distance(rate_of(y), velocity.y()) <= size);
    }
  }
  // hanging: below the support, and turning anticlockwise moves it to the right
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 2.0);
  CHECK(rod.centroid_position(0.0, 0.5) == Eigen::Vector2d(0.0, -0.5));
  CHECK(rod.centroid_velocity(0.0, 1.0, 0.0) == Eigen::Vector2d(1.0, 0.0));
}

TEST_CASE("Equation (7) is Lagrange's equation of the energies (3) and (4)", "[model][pendulum]") {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> any(-4.0, 4.0);
  for (const auto& p : bodies()) {
    for (int i = 0; i < 50; ++i) {
      auto path = random_path(random);
      const double moment = any(random);
      const double acceleration =
          p.angular_acceleration(path.angle, path.rate, path.support_acceleration, moment);
      path.acceleration = acceleration;
      const Real small = 1e-12;
      const auto momentum = [&](const Real& t) {
        const Real phi = path.phi(t), rate = path.rate + t * path.acceleration;
        const Real r = path.r(t), r_rate = path.support_rate + t * path.support_acceleration;
        return Real(
            (lagrangian(p, phi, rate + small, r, r_rate) - lagrangian(p, phi, rate - small, r, r_rate)) /
            (2 * small));
      };
      const Real force = rate_of([&](const Real& d) {
        return lagrangian(p, path.angle + d, path.rate, path.support, path.support_rate);
      });
      const Real residual = rate_of(momentum) - force - moment + p.damping * p.inertia * path.rate;
      const double scale =
          std::abs(moment) +
          p.inertia * (p.damping * std::abs(path.rate) +
                       p.alpha_squared() * (1.0 + std::abs(path.support_acceleration) / p.gravity));
      CHECK(distance(residual, 0.0) <= 8.0 * kUnit * scale);
      // and the energies of the library are those
      const Real difference = lagrangian(p, path.angle, path.rate, path.support, path.support_rate);
      const double kinetic = p.kinetic_energy(path.angle, path.rate, path.support_rate);
      const double potential = p.potential_energy(path.angle, path.support);
      const double size = kinetic + p.mass * p.gravity * (std::abs(path.support) + p.centroid);
      CHECK(distance(difference, kinetic - potential) <= 16.0 * kUnit * size);
    }
  }
}

TEST_CASE("The support force is the mass times the acceleration of the centroid and gravity",
          "[model][pendulum]") {
  std::mt19937_64 random(7);
  for (const auto& p : bodies()) {
    for (int i = 0; i < 20; ++i) {
      const auto path = random_path(random);
      const Real h = 1e-12;
      const auto y = [&](const Real& t) { return Real(path.r(t) - p.centroid * cos(path.phi(t))); };
      const Real force = p.mass * ((y(h) - 2 * y(0) + y(-h)) / (h * h) + p.gravity);
      const auto second = static_cast<double>(path.acceleration);
      const double size = p.mass * (30.0 + p.centroid * 12.0);
      CHECK(distance(force, p.support_force(path.angle, path.rate, second, path.support_acceleration)) <=
            8.0 * kUnit * size);
    }
  }
  // at rest it carries the weight
  CHECK(PhysicalPendulum::uniform_rod(2.0, 1.0).support_force(0.0, 0.0, 0.0, 0.0) == 2.0 * 9.81);
}

TEST_CASE("Energy grows by the work of support and moment, less damping", "[model][pendulum][law][ratchet]") {
  const Excitation none{7.0, PeriodicFunction()};
  const Excitation push{7.0, PeriodicFunction::fourier(0.3, {{1, 0.0, 0.8}, {2, -0.4, 0.0}})};
  const Excitation shaken{7.0, PeriodicFunction::fourier(0.0, {{1, 0.0, 0.05}, {3, 0.01, 0.0}})};
  for (const auto& p : bodies()) {
    for (const auto& support :
         {none, shaken, sinusoidal_support(0.1, 5.0, 0.7), square_acceleration_support(0.08, 6.0, 0.2)}) {
      for (const auto& moment : {none, push}) {
        const auto b = balance(p, support, moment, 4.0);
        check_within("power balance of a pendulum over 1 + its terms",
                     std::abs(b.energy - b.work) / (1.0 + b.scale), 2.5e-14);
        // the test sees each part: what the support does is no rounding
        if (!support.function.is_constant()) CHECK(std::abs(b.support_work) > 1e-4 * b.scale);
      }
    }
  }
}

TEST_CASE("Characteristic roots satisfy their equation at any damping", "[model][pendulum][extreme]") {
  for (const double c : {0.0, 1e-300, 1e-17, 1e-8, 0.3, 2.0, 50.0, 1e8, 1e17, 1e200}) {
    for (const auto about : {Equilibrium::hanging, Equilibrium::inverted}) {
      const auto p = PhysicalPendulum::uniform_rod(1.0, 1.0, 9.81, c);
      const double stiffness = about == Equilibrium::hanging ? p.alpha_squared() : -p.alpha_squared();
      const auto [first, second] = p.characteristic_roots(about);
      INFO("c = " << c);
      // sum and product to full relative accuracy: neither root has lost digits
      const double sum_scale = std::abs(first) + std::abs(second);
      CHECK(std::abs(first + second + c) <= 4.0 * kUnit * sum_scale);
      const Real real = Real(first.real()) * second.real() - Real(first.imag()) * second.imag();
      CHECK(distance(real, stiffness) <= 8.0 * kUnit * std::abs(stiffness));
      CHECK(
          (first.real() > second.real() || (first.real() == second.real() && first.imag() >= second.imag())));
      if (about == Equilibrium::inverted) CHECK(first.real() > 0.0);
      if (about == Equilibrium::hanging) CHECK(first.real() <= 0.0);
    }
  }
}

TEST_CASE("Small and large roots have their limits", "[model][pendulum][extreme][ratchet]") {
  const auto slight =
      PhysicalPendulum::point_mass(1.0, 1.0, 4.0, 1e-12).characteristic_roots(Equilibrium::hanging);
  CHECK(slight[0] == std::complex{-0.5e-12, 2.0});
  CHECK(slight[1] == std::complex{-0.5e-12, -2.0});
  const auto heavy =
      PhysicalPendulum::point_mass(1.0, 1.0, 4.0, 1e12).characteristic_roots(Equilibrium::hanging);
  check_close("characteristic roots at a damping of 1e12 (relative)", heavy[0].real(), -4e-12,
              8e-16);  // alpha^2/c: subtraction would leave nothing of it
  check_close("characteristic roots at a damping of 1e12 (relative)", heavy[1].real(), -1e12, 8e-16);
  const auto falling =
      PhysicalPendulum::point_mass(1.0, 1.0, 4.0).characteristic_roots(Equilibrium::inverted);
  CHECK(falling[0] == std::complex{2.0, 0.0});
  CHECK(falling[1] == std::complex{-2.0, 0.0});
  const auto critical =
      PhysicalPendulum::point_mass(1.0, 1.0, 4.0, 4.0).characteristic_roots(Equilibrium::hanging);
  CHECK(critical[0] == std::complex{-2.0, 0.0});
  CHECK(critical[1] == std::complex{-2.0, 0.0});
}

TEST_CASE("Bodies that cannot be are refused by name, value and range",
          "[model][pendulum][error][extreme][N38]") {
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_WITH(PhysicalPendulum::uniform_rod(1.0, bad), Catch::StartsWith("length = " + to_text(bad)));
    CHECK_THROWS_WITH(PhysicalPendulum::point_mass(1.0, bad), Catch::StartsWith("length = " + to_text(bad)));
    CHECK_THROWS_WITH(PhysicalPendulum::uniform_rod(bad, 1.0).validate(),
                      Catch::StartsWith("mass = " + to_text(bad)));
    CHECK_THROWS_WITH(PhysicalPendulum::uniform_rod(1.0, 1.0, bad).validate(),
                      Catch::StartsWith("gravity = " + to_text(bad)));
    CHECK_THROWS_WITH((PhysicalPendulum{1.0, bad, 0.5}.validate()),
                      Catch::StartsWith("inertia = " + to_text(bad)));
    CHECK_THROWS_WITH((PhysicalPendulum{1.0, 1.0, bad}.validate()),
                      Catch::StartsWith("centroid = " + to_text(bad)));
  }
  for (const double bad : {-1e-300, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_WITH(PhysicalPendulum::uniform_rod(1.0, 1.0, 9.81, bad).validate(),
                      "damping = " + to_text(bad) + " is not allowed: it must be a finite number >= 0");
  }
  CHECK_THROWS_WITH((PhysicalPendulum{2.0, 0.49, 0.5}.validate()),
                    "inertia = 0.49 is not allowed: it must be at least mass * centroid^2 = 0.5 (Steiner)");
  CHECK_NOTHROW((PhysicalPendulum{2.0, 0.5, 0.5}.validate()));
}

}  // namespace strutt::test::pendulum_test
