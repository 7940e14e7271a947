#include "strutt/model/linearisation.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::linearisation_test {

using Real = boost::multiprecision::cpp_bin_float_50;

namespace {

constexpr double kPi = std::numbers::pi;

PhysicalPendulum rod() { return PhysicalPendulum::uniform_rod(1.7, 0.8, 9.81, 0.3); }

double angle_of(Equilibrium about) { return about == Equilibrium::hanging ? 0.0 : kPi; }

double sign_of(Equilibrium about) { return about == Equilibrium::hanging ? 1.0 : -1.0; }

/// Central difference of sixth order at 0; with h = 0.02 truncation and rounding are both below 1e-12 of f.
template <typename Function>
double slope(Function f) {
  const double h = 0.02;
  return (45.0 * (f(h) - f(-h)) - 9.0 * (f(2.0 * h) - f(-2.0 * h)) + (f(3.0 * h) - f(-3.0 * h))) / (60.0 * h);
}

}  // namespace

TEST_CASE("The linear equation is the slope of (7) at the equilibrium", "[model][linearisation][ratchet]") {
  const auto body = rod();
  const std::vector<Excitation> supports = {
      sinusoidal_support(0.05, 11.0, 0.4),
      square_acceleration_support(0.03, 9.0, -1.0),
      {6.0, PeriodicFunction::fourier(0.2, {{1, 0.01, 0.03}, {4, -0.002, 0.001}})}};
  for (const auto about : {Equilibrium::hanging, Equilibrium::inverted}) {
    for (const auto& support : supports) {
      const Excitation moment{support.frequency,
                              PeriodicFunction::fourier(0.1, {{1, 0.0, 0.2}, {2, 0.3, 0.0}})};
      const auto linear = linearise(body, about, &support, &moment);
      const double omega = support.frequency;
      const auto acceleration = support.function.derivative().derivative();
      for (const double t : {0.03, 0.21, 0.4, 0.77}) {
        const double r2 = omega * omega * acceleration(omega * t), m = moment.value(t);
        const auto phi2 = [&](double x, double rate) {
          return body.angular_acceleration(angle_of(about) + x, rate, r2, m);
        };
        const double w = omega * omega * linear.equation.coefficient(omega * t);
        const double scale =
            body.alpha_squared() * (1.0 + std::abs(r2) / body.gravity) + std::abs(m) / body.inertia;
        check_within("slope of (7) at an equilibrium in the angle over its scale",
                     std::abs(slope([&](double x) { return phi2(x, 0.7); }) + w) / scale, 1.5e-12);
        check_close("slope of (7) at an equilibrium in the velocity (relative)",
                    slope([&](double v) { return phi2(0.0, v); }), -linear.equation.damping, 1e-14);
        REQUIRE(linear.forcing);
        check_within("forcing against (7) at an equilibrium over its scale",
                     std::abs((*linear.forcing)(omega * t) - phi2(0.0, 0.0)) / scale, 8e-16);
      }
    }
  }
}

TEST_CASE("Canonical delta and epsilon, hanging and inverted", "[model][linearisation][ratchet]") {
  // W = +-(delta - epsilon sin tau), delta = alpha^2/omega^2, epsilon = alpha^2 r0/g = 3 r0/(2 l), free of
  // omega
  for (const double omega : {1e-100, 1e-3, 0.7, 12.0, 1e6, 1e150}) {
    for (const auto about : {Equilibrium::hanging, Equilibrium::inverted}) {
      const double l = 0.8, r0 = 0.07, g = 9.81;
      const auto support = sinusoidal_support(r0, omega);
      const auto equation = linearise(rod(), about, &support).equation;
      const auto harmonics = equation.coefficient.harmonics();
      REQUIRE(harmonics.size() == 1);
      CHECK(harmonics[0].order == 1);
      CHECK(harmonics[0].cosine == 0.0);
      const Real epsilon = -sign_of(about) * 3 * Real(r0) / (2 * Real(l));
      const Real delta = sign_of(about) * 3 * Real(g) / (2 * Real(l)) / (Real(omega) * omega);
      const double allowed = equation.coefficient_error;
      check_within("bound of the coefficients of a pendulum (relative)", allowed, 3e-15);
      CHECK(abs(Real(harmonics[0].sine) - epsilon) <= allowed * abs(epsilon));
      CHECK(abs(Real(equation.delta()) - delta) <= allowed * abs(delta));
      CHECK(equation.epsilon() == std::abs(harmonics[0].sine));
      CHECK(equation.angular_frequency == omega);
      CHECK(equation.canonical_damping() == 0.3 / omega);
    }
  }
}

TEST_CASE("A point mass has epsilon = r0/l and delta = g/(l omega^2)", "[model][linearisation]") {
  const auto support = sinusoidal_support(0.25, 2.0, kPi / 2.0);  // r = cos: W = delta - epsilon cos
  const auto equation =
      linearise(PhysicalPendulum::point_mass(3.0, 0.5, 8.0), Equilibrium::hanging, &support).equation;
  CHECK(equation.delta() == 4.0);
  CHECK(equation.coefficient.harmonics()[0].cosine == -0.5);
}

TEST_CASE("Square acceleration of the support gives Meissner's equation", "[model][linearisation][ratchet]") {
  for (const auto about : {Equilibrium::hanging, Equilibrium::inverted}) {
    const auto support = square_acceleration_support(0.05, 15.0, 0.6);
    const auto equation = linearise(rod(), about, &support).equation;
    CHECK(equation.coefficient.is_piecewise_constant());
    const double delta = sign_of(about) * 1.5 * 9.81 / 0.8 / 225.0,
                 epsilon = sign_of(about) * 1.5 * 0.05 / 0.8;
    check_close("epsilon of a square support acceleration (relative)", equation.epsilon(), std::abs(epsilon),
                1e-15);
    for (const double theta : {0.1, 1.0, 2.4, 2.6, 4.0, 5.6, 5.7}) {
      const double wave = std::sin(theta + 0.6) > 0.0 ? 1.0 : -1.0;
      check_close("coefficient of a square support acceleration (relative)", equation.coefficient(theta),
                  delta - epsilon * wave, 8e-15);
    }
    const auto jumps = equation.coefficient.breakpoints(0.0, 2.0 * kPi);
    REQUIRE(jumps.size() == 2);
    check_close("jumps of a square support acceleration (relative)", jumps[0], kPi - 0.6, 8e-16);
    check_close("jumps of a square support acceleration (relative)", jumps[1], 2.0 * kPi - 0.6, 8e-16);
  }
}

TEST_CASE("Without a support the phase is alpha t and the coefficient exactly 1 or -1",
          "[model][linearisation][ratchet]") {
  for (const auto about : {Equilibrium::hanging, Equilibrium::inverted}) {
    const auto linear = linearise(rod(), about, nullptr);
    CHECK(linear.equation.coefficient.is_constant());
    CHECK(linear.equation.delta() == sign_of(about));
    CHECK(linear.equation.coefficient_error == 0.0);
    CHECK(linear.equation.angular_frequency == rod().alpha());
    CHECK(linear.equation.period() == rod().period());
    CHECK_FALSE(linear.forcing);
  }
  // a support at rest keeps its own phase
  const auto still = sinusoidal_support(0.0, 4.0);
  const auto equation = linearise(rod(), Equilibrium::hanging, &still).equation;
  CHECK(equation.coefficient.is_constant());
  CHECK(equation.angular_frequency == 4.0);
  check_close("delta of a support at rest (relative)", equation.delta(), rod().alpha_squared() / 16.0, 8e-16);
}

TEST_CASE("The moment enters the forcing only", "[model][linearisation][ratchet]") {
  const auto support = sinusoidal_support(0.05, 11.0);
  const Excitation moment{11.0, PeriodicFunction::fourier(0.1, {{2, 0.3, 0.0}})};
  const auto with = linearise(rod(), Equilibrium::inverted, &support, &moment);
  const auto without = linearise(rod(), Equilibrium::inverted, &support);
  REQUIRE(with.forcing);
  CHECK_FALSE(without.forcing);
  check_close("forcing by a moment (relative)", with.forcing->mean(), 0.1 / rod().inertia, 8e-16);
  check_close("forcing by a moment (relative)", with.forcing->harmonics()[0].cosine, 0.3 / rod().inertia,
              8e-16);
  CHECK(with.equation.delta() == without.equation.delta());
  CHECK(with.equation.epsilon() == without.equation.epsilon());
}

TEST_CASE("Linearisation refuses bodies, supports and moments that do not fit",
          "[model][linearisation][error]") {
  auto body = rod();
  body.gravity = 0.0;
  CHECK_THROWS_WITH(linearise(body, Equilibrium::hanging, nullptr), Catch::StartsWith("gravity = 0"));
  for (const double bad : {0.0, -2.0, std::nan(""), HUGE_VAL}) {
    const auto support = sinusoidal_support(0.1, bad);
    CHECK_THROWS_WITH(
        linearise(rod(), Equilibrium::hanging, &support),
        "support.frequency = " + to_text(bad) + " is not allowed: it must be a finite number > 0");
  }
  const auto wild = sinusoidal_support(std::nan(""), 2.0);
  CHECK_THROWS_AS(linearise(rod(), Equilibrium::hanging, &wild), InvalidInput);
  const auto support = sinusoidal_support(0.1, 2.0);
  const Excitation other{3.0, PeriodicFunction::fourier(0.0, {{1, 1.0, 0.0}})};
  CHECK_THROWS_WITH(linearise(rod(), Equilibrium::hanging, &support, &other),
                    "moment.frequency = 3 is not allowed: it must be that of the support");
  const Excitation constant{3.0, PeriodicFunction::constant(1.0)};
  CHECK_NOTHROW(linearise(rod(), Equilibrium::hanging, &support, &constant));
  CHECK_NOTHROW(linearise(rod(), Equilibrium::hanging, nullptr, &other));
}

}  // namespace strutt::test::linearisation_test
