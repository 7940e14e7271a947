#include "strutt/model/hill_equation.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::hill_equation_test {

using Real = boost::multiprecision::cpp_bin_float_50;

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// w(t) of the equation in the scene's own time, from the canonical form.
double stiffness(const HillEquation& equation, double t) {
  return equation.angular_frequency * equation.angular_frequency *
         equation.coefficient(equation.angular_frequency * t);
}

double relative_distance(const Real& truth, double value) {
  return static_cast<double>(Real(abs(truth - value) / abs(truth)));
}

}  // namespace

TEST_CASE("Mathieu's equation in delta and epsilon", "[model][hill_equation][ratchet]") {
  const auto equation = mathieu_delta_epsilon(1.5, -0.4, 0.1);
  CHECK(equation.delta() == 1.5);
  CHECK(equation.epsilon() == 0.4);
  CHECK(equation.damping == 0.1);
  CHECK(equation.canonical_damping() == 0.1);
  CHECK(equation.period() == kTwoPi);
  CHECK(equation.coefficient_error == 0.0);
  for (const double t : {0.0, 0.4, 2.0, 9.0})
    check_close("stiffness of Mathieu's equation in delta and epsilon (relative)", stiffness(equation, t),
                1.5 - 0.4 * std::cos(t), 8e-16);
}

TEST_CASE("Mathieu's equation in a and q is delta = a/4, epsilon = |q|/2 over half the time",
          "[model][hill_equation][ratchet]") {
  for (const double q : {0.7, -0.7, 0.0, 1e-300}) {
    const auto equation = mathieu_a_q(3.0, q, 0.2);
    CHECK(equation.period() == kTwoPi / 2.0);
    CHECK(equation.delta() == 0.75);
    CHECK(equation.epsilon() == std::abs(q) / 2.0);
    CHECK(equation.canonical_damping() == 0.1);
    for (const double t : {0.0, 0.4, 2.0, 9.0}) {
      check_close("stiffness of Mathieu's equation in a and q (relative)", stiffness(equation, t),
                  3.0 - 2.0 * q * std::cos(2.0 * t), 8e-16);
    }
  }
}

TEST_CASE("Hill's equation: canonical coefficients are within coefficient_error",
          "[model][hill_equation][ratchet]") {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> any(-3.0, 3.0), log_period(-20.0, 20.0);
  const Real pi = acos(Real(-1));
  for (int i = 0; i < 500; ++i) {
    const double period = std::exp(log_period(random)), mean = any(random);
    const Harmonic first{1, any(random), any(random)}, third{3, any(random), any(random)};
    const auto equation = hill_equation(period, PeriodicFunction::fourier(mean, {first, third}), 0.3);
    const Real square = pow(Real(period) / (2 * pi), 2);
    CHECK(equation.coefficient_error > 0.0);
    check_within("bound of the coefficients of Hill's equation (relative)", equation.coefficient_error,
                 3e-15);
    CHECK(relative_distance(mean * square, equation.delta()) <= equation.coefficient_error);
    const auto h = equation.coefficient.harmonics();
    REQUIRE(h.size() == 2);
    CHECK(relative_distance(first.cosine * square, h[0].cosine) <= equation.coefficient_error);
    CHECK(relative_distance(third.sine * square, h[1].sine) <= equation.coefficient_error);
    check_close("period and damping of Hill's equation (relative)", equation.period(), period, 8e-16);
    check_close("period and damping of Hill's equation (relative)", equation.canonical_damping(),
                0.3 * period / kTwoPi, 8e-16);
  }
}

TEST_CASE("delta, epsilon and kappa of every form of coefficient", "[model][hill_equation]") {
  const auto of = [](const PeriodicFunction& w) { return HillEquation{1.0, 0.0, w}; };
  CHECK(of(PeriodicFunction::constant(-4.0)).epsilon() == 0.0);
  CHECK(of(PeriodicFunction::fourier(2.0, {{1, 3.0, -4.0}, {2, 7.0, 0.0}})).epsilon() == 5.0);
  CHECK(of(PeriodicFunction::fourier(2.0, {{2, 7.0, 0.0}})).epsilon() == 0.0);
  CHECK(of(PeriodicFunction::square(2.0, -0.5, 1.0)).epsilon() == 0.5);
  CHECK(of(PeriodicFunction::square(1e17, 0.5, 1.0)).epsilon() == 0.5);
  // an antiderivative of the square wave: half of the distance from lowest to highest value
  CHECK(of(PeriodicFunction::square(2.0, 1.0, 0.0, 1)).epsilon() == std::numbers::pi / 2.0);
  CHECK(of(PeriodicFunction::square(2.0, 1.0, 0.0, 2)).epsilon() ==
        std::numbers::pi * std::numbers::pi / 8.0);

  CHECK(of(PeriodicFunction::constant(0.0)).canonical_kappa() == 1.0);
  CHECK(of(PeriodicFunction::constant(0.9)).canonical_kappa() == 1.0);
  CHECK(of(PeriodicFunction::constant(9.0)).canonical_kappa() == 3.0);
  CHECK(of(PeriodicFunction::constant(-9.0)).canonical_kappa() == 3.0);
}

TEST_CASE("Hill's equation refuses what it cannot be", "[model][hill_equation][error]") {
  const double nan = std::nan("");
  for (const double bad : {0.0, -1.0, nan, HUGE_VAL}) {
    CHECK_THROWS_WITH(hill_equation(bad, PeriodicFunction::constant(1.0)),
                      "period = " + to_text(bad) + " is not allowed: it must be a finite number > 0");
    CHECK_THROWS_WITH((HillEquation{bad, 0.0, {}}.validate()),
                      Catch::StartsWith("angular frequency = " + to_text(bad)));
  }
  for (const double bad : {-0.1, nan, HUGE_VAL}) {
    CHECK_THROWS_WITH(mathieu_delta_epsilon(1.0, 0.5, bad).validate(),
                      Catch::StartsWith("damping = " + to_text(bad)));
  }
  for (const double bad : {nan, HUGE_VAL, -HUGE_VAL}) {
    CHECK_THROWS_WITH(mathieu_delta_epsilon(bad, 0.5).validate(),
                      Catch::StartsWith("coefficient of Hill's equation"));
    CHECK_THROWS_AS(mathieu_delta_epsilon(1.0, bad).validate(), InvalidInput);
  }
  // finite in the scene's time, but not in canonical time
  CHECK_THROWS_AS(hill_equation(1e160, PeriodicFunction::constant(1.0)).validate(), InvalidInput);
  CHECK_NOTHROW(mathieu_delta_epsilon(-1e300, 1e300, 1e300).validate());
}

}  // namespace strutt::test::hill_equation_test
