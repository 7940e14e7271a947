#include "strutt/free_pendulum/krylov.hpp"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/normal_form.hpp"
#include "strutt/free_pendulum/period_formulas.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::krylov_test {

namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
constexpr auto kBoth = {KrylovVariant::frequency, KrylovVariant::frequency_squared};

/// 2 K(k)/pi, k given by its square.
Real elliptic_ratio(const Real& modulus_squared) {
  return 2 * boost::math::ellint_1(sqrt(modulus_squared)) / boost::math::constants::pi<Real>();
}

Real pendulum_ratio(double amplitude) {
  const Real k = sin(Real(amplitude) / 2);
  return elliptic_ratio(k * k);
}

/// T/T0 of phi'' + phi = phi^3/6 by the substitution k^2 = (A^2/12)/(1 - A^2/12).
Real cubic_ratio(double amplitude) {
  const Real m = Real(amplitude) * amplitude / 12;
  return elliptic_ratio(m / (1 - m)) / sqrt(1 - m);
}

/// phi(t) of phi'' = -sin(phi) from rest, by the classical Runge-Kutta method with 4000 steps: good to 1e-12.
double pendulum_angle(double amplitude, double time) {
  constexpr int steps = 4000;
  const double h = time / steps;
  double x = amplitude, v = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double a1 = -std::sin(x), v2 = v + h / 2 * a1, a2 = -std::sin(x + h / 2 * v);
    const double v3 = v + h / 2 * a2, a3 = -std::sin(x + h / 2 * v2), v4 = v + h * a3,
                 a4 = -std::sin(x + h * v3);
    x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return x;
}

}  // namespace

TEST_CASE("(22) and (31) are one function of the amplitude", "[free_pendulum][paper][ratchet]") {
  for (const double alpha : {1.0, 3.0}) {
    const auto field = [&](const Jet& phi, const Jet& velocity) {
      return JetPair{velocity, -alpha * alpha * sin(phi)};
    };
    const NormalForm form = normal_form(taylor_expansion(field, {0.0, 0.0}));
    for (double amplitude = 0.0; amplitude < 3.9; amplitude += 0.1) {
      const KrylovMotion motion(KrylovVariant::frequency, alpha, amplitude);
      check_close("formula (22) against (31) (relative)", normal_form_period(form, amplitude),
                  motion.period(), 1.5e-15);
    }
  }
}

TEST_CASE("errors of both formulas are those against the elliptic integral",
          "[free_pendulum][reference][ratchet]") {
  for (const KrylovVariant variant : kBoth) {
    for (double amplitude = 0.05; amplitude < 2.82; amplitude += 0.05) {
      const FormulaError formula = formula_of_amplitude(
          variant == KrylovVariant::frequency ? PeriodMethod::krylov : PeriodMethod::krylov_squared,
          amplitude);
      const Real exact = pendulum_ratio(amplitude), own = Real(amplitude) * amplitude;
      const Real ratio = variant == KrylovVariant::frequency ? 1 / (1 - own / 16) : 1 / sqrt(1 - own / 8);
      check_within("error of a formula against the elliptic integral over its ratio",
                   static_cast<double>(Real(abs(Real(formula.relative_error) - (ratio / exact - 1)) / ratio)),
                   8e-17);
      check_within("ratio by a formula (relative)",
                   static_cast<double>(Real(abs(Real(formula.ratio) / ratio - 1))), 8e-16);
    }
  }
}

TEST_CASE("the paper's formula is off by what the issue tells", "[free_pendulum][paper]") {
  const auto error = [](double amplitude) {
    return formula_of_amplitude(PeriodMethod::krylov, amplitude).relative_error;
  };
  CHECK(std::abs(error(1.0)) == Approx(3.1e-4).epsilon(0.02));
  CHECK(std::abs(error(2.0)) == Approx(3.3e-3).epsilon(0.02));
  CHECK(std::abs(error(2.7)) == Approx(1.5e-2).epsilon(0.04));
  CHECK(std::abs(error(2.9)) == Approx(5.7e-2).epsilon(0.02));
  CHECK(error(2.46308) > 0.0);
  CHECK(error(2.46310) < 0.0);
  for (double amplitude = 0.1; amplitude < 2.4; amplitude += 0.1)
    CHECK(std::abs(formula_of_amplitude(PeriodMethod::krylov_squared, amplitude).relative_error) >
          std::abs(error(amplitude)));
}

TEST_CASE("the waveform obeys (24), (25) and leaves terms of fifth order",
          "[free_pendulum][order][ratchet]") {
  for (const KrylovVariant variant : kBoth) {
    const auto worst = [&](double amplitude) {
      const KrylovMotion motion(variant, 1.0, amplitude);
      double largest = 0.0;
      for (double time = 0.1; time < 6.0; time += 0.37)
        largest = std::max(largest, std::abs(motion.angle(time) - pendulum_angle(amplitude, time)));
      return largest;
    };
    check_within("order of Krylov's waveform: measured against expected",
                 std::abs(std::log2(worst(0.4) / worst(0.2)) - 5.0), 0.08);
    const KrylovMotion motion(variant, 2.0, 0.7);
    CHECK(motion.angle(0.0) == 0.7);
    CHECK(motion.velocity(0.0) == 0.0);
    check_close("half a period of Krylov's waveform (relative)", motion.angle(motion.period() / 2), -0.7,
                8e-16);
    const double h = 1e-4, time = 0.3;
    check_close("velocity of Krylov's waveform against differences (relative)",
                (motion.angle(time + h) - motion.angle(time - h)) / (2 * h), motion.velocity(time), 2e-8);
  }
}

TEST_CASE("the cubic truncation has its own period up to sqrt(6)", "[free_pendulum][reference][ratchet]") {
  const auto check = [](double amplitude) {
    const Real error = abs(Real(cubic_period_ratio(amplitude)) / cubic_ratio(amplitude) - 1);
    check_within("ratio of the cubic truncation (relative)", static_cast<double>(error), 6e-16);
  };
  for (double amplitude = 0.0; amplitude < 2.449; amplitude += 0.031) check(amplitude);
  for (const double below : {1e-3, 1e-8, 1e-15, 0.0}) check(cubic_separatrix() - below);
  CHECK(cubic_period_ratio(1e-200) == 1.0);
}

TEST_CASE("linear amplitude: its cost against the energy", "[free_pendulum][paper][ratchet]") {
  check_close("linear amplitude (relative)", linear_amplitude(2.0, 0.3, 0.8), 0.5, 8e-16);
  // Started from phi = 0 the velocity 2 alpha sin(A/2) belongs to the amplitude A.
  for (const double amplitude : {0.1, 0.2}) {
    const double r = linear_amplitude(1.0, 0.0, 2.0 * std::sin(amplitude / 2.0));
    check_close("linear amplitude against the first term of its series (relative)",
                (amplitude - r) / std::pow(amplitude, 3), 1.0 / 24.0, 0.0015);
    const Real exact = pendulum_ratio(amplitude);
    const double by_r =
        (Real(krylov_period_ratio(KrylovVariant::frequency, r)) / exact - 1).convert_to<double>();
    const double by_a = formula_of_amplitude(PeriodMethod::krylov, amplitude).relative_error;
    check_close("period by an amplitude against the first term of its series (relative)",
                by_a / std::pow(amplitude, 4), 1.0 / 3072.0, 0.005);
    check_close("period by an amplitude against the first term of its series (relative)",
                (by_r - by_a) / std::pow(amplitude, 4), -1.0 / 192.0, 0.005);
  }
}

TEST_CASE("formulas are refused beyond their range", "[free_pendulum][misuse]") {
  CHECK_THROWS_AS(krylov_period_ratio(KrylovVariant::frequency, 4.0), InvalidInput);
  CHECK_THROWS_AS(krylov_period_ratio(KrylovVariant::frequency_squared, 2.9), InvalidInput);
  CHECK_THROWS_AS(krylov_frequency_ratio(KrylovVariant::frequency, NAN), InvalidInput);
  CHECK_THROWS_AS(formula_of_amplitude(PeriodMethod::krylov, 3.2), InvalidInput);
  CHECK_THROWS_AS(formula_of_amplitude(PeriodMethod::krylov, -0.1), InvalidInput);
  CHECK_THROWS_AS(KrylovMotion(KrylovVariant::frequency, 0.0, 1.0), InvalidInput);
  CHECK_THROWS_AS(cubic_period_ratio(2.5), InvalidInput);
  CHECK_THROWS_AS(cubic_period_ratio(-1.0), InvalidInput);
  CHECK_THROWS_AS(linear_amplitude(-1.0, 0.0, 0.0), InvalidInput);
  CHECK_THROWS_AS(linear_amplitude(1.0, HUGE_VAL, 0.0), InvalidInput);
}

}  // namespace strutt::test::krylov_test
