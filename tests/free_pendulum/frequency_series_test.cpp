#include "strutt/free_pendulum/frequency_series.hpp"

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::frequency_series_test {

using strutt::test::check_within;

namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
using Integer = boost::multiprecision::cpp_int;

Real exact_value(const Rational& r) { return Real(Integer(r.numerator)) / Real(Integer(r.denominator)); }

std::string text(const Rational& r) { return r.numerator + "/" + r.denominator; }

Real pendulum_ratio(double amplitude) {
  const Real k = sin(Real(amplitude) / 2);
  return 2 * boost::math::ellint_1(k) / boost::math::constants::pi<Real>();
}

}  // namespace

TEST_CASE("the pendulum's series begin as in the textbooks", "[free_pendulum][paper]") {
  const FrequencySeries series = pendulum_frequency_series(8);
  REQUIRE(series.period.size() == 9);
  CHECK(text(series.period[0]) == "1/1");
  CHECK(text(series.period[2]) == "1/16");
  CHECK(text(series.period[4]) == "11/3072");
  CHECK(text(series.period[6]) == "173/737280");
  CHECK(text(series.period[8]) == "22931/1321205760");
  CHECK(text(series.frequency[2]) == "-1/16");
  CHECK(text(series.frequency[4]) == "1/3072");
  for (const std::size_t n : {1, 3, 5, 7}) CHECK(text(series.period[n]) == "0/1");
  CHECK(series.radius == std::numbers::pi);
}

TEST_CASE("elliptic integral, energy integral and Lindstedt give the same rational numbers",
          "[free_pendulum][unit]") {
  const int order = 24;
  const FrequencySeries energy = pendulum_frequency_series(order, SeriesMethod::energy_integral);
  const FrequencySeries lindstedt = pendulum_frequency_series(order, SeriesMethod::lindstedt);
  CHECK(energy.period == lindstedt.period);
  CHECK(energy.frequency == lindstedt.frequency);
  CHECK(energy.period == pendulum_period_series(order));
}

TEST_CASE("series of the pendulum go to any order", "[free_pendulum][extreme][ratchet]") {
  const FrequencySeries energy = pendulum_frequency_series(120);
  CHECK(energy.period == pendulum_period_series(120));
  const SeriesValue at_large = evaluate(energy.period, energy.radius, 2.5);
  CHECK(abs(Real(at_large.value) - pendulum_ratio(2.5)) <= at_large.error);
  check_within("bound of the period by a series of order 120 at 2.5 rad", at_large.error, 6e-13);
}

TEST_CASE("both ways agree for potentials without symmetry", "[free_pendulum][unit]") {
  const std::vector<double> potential{0.0, 0.0, 0.75, -0.3, 0.4, 0.1, -0.2};
  const FrequencySeries energy = frequency_series(potential, 10, SeriesMethod::energy_integral);
  const FrequencySeries lindstedt = frequency_series(potential, 10, SeriesMethod::lindstedt);
  CHECK(energy.period == lindstedt.period);
  CHECK(energy.frequency == lindstedt.frequency);
  CHECK(energy.frequency[3].numerator != "0");
}

TEST_CASE("a quadratic force has the textbook frequency", "[free_pendulum][paper]") {
  // phi'' + phi + k phi^2 = 0 with turning point A = a - k a^2/2 + k a^2/6 + ..., omega = 1 - 5 k^2 a^2/12:
  // in A the next term is -(5 k^2/12)(2 k/3) A^3.
  const FrequencySeries series = frequency_series({0.0, 0.0, 0.5, 1.0}, 3);  // k = 3
  CHECK(text(series.frequency[1]) == "0/1");
  CHECK(text(series.frequency[2]) == "-15/4");
  CHECK(text(series.frequency[3]) == "-15/2");
}

TEST_CASE("a harmonic oscillator is isochronous", "[free_pendulum][unit]") {
  const FrequencySeries series = frequency_series({0.0, 0.0, 7.0}, 6);
  for (std::size_t n = 1; n <= 6; ++n) CHECK(text(series.frequency[n]) == "0/1");
  CHECK(series.radius == HUGE_VAL);
  CHECK(evaluate(series.period, series.radius, 100.0).value == 1.0);
}

TEST_CASE("values are the rational numbers rounded", "[free_pendulum][unit]") {
  const FrequencySeries series = pendulum_frequency_series(60);
  for (const auto* coefficients : {&series.period, &series.frequency})
    for (const Rational& c : *coefficients) CHECK(c.value == exact_value(c).convert_to<double>());
}

TEST_CASE("the error of a truncated series is above the true one", "[free_pendulum][reference][ratchet]") {
  for (const int order : {2, 4, 10, 20, 60}) {
    const FrequencySeries series = pendulum_frequency_series(order);
    for (double amplitude = 0.0; amplitude < 3.14; amplitude += 0.0785) {
      const Real exact = pendulum_ratio(amplitude);
      const SeriesValue period = evaluate(series.period, series.radius, amplitude);
      const SeriesValue frequency = evaluate(series.frequency, series.radius, amplitude);
      CAPTURE(order, amplitude, period.value, period.error, frequency.value, frequency.error);
      const auto error = static_cast<double>(Real(abs(Real(period.value) - exact)));
      CHECK(error <= period.error);
      if (error > 0.0)
        check_within("true error of a series of the period over its bound", error / period.error, 1.0);
      CHECK(abs(Real(frequency.value) - 1 / exact) <= frequency.error);
    }
  }
  const FrequencySeries series = pendulum_frequency_series(60);
  const SeriesValue at_one = evaluate(series.period, series.radius, 1.0);
  check_within("bound of the period by a series of order 60 at 1 rad", at_one.error,
               1e-13);  // and it is not far above
}

TEST_CASE("later coefficients of the pendulum obey the bound of the truncation error",
          "[free_pendulum][property]") {
  const FrequencySeries series = pendulum_frequency_series(100);
  const Real pi = boost::math::constants::pi<Real>();
  // The bound takes M = max |c_n| pi^n over the upper half of the coefficients known: for every truncation
  // none of the later ones may rise above its M.
  for (const auto* coefficients : {&series.period, &series.frequency}) {
    std::vector<Real> size;
    for (std::size_t n = 0; n < coefficients->size(); ++n)
      size.push_back(abs(exact_value((*coefficients)[n])) * pow(pi, static_cast<int>(n)));
    for (std::size_t order = 2; order + 1 < size.size(); ++order) {
      const auto half = size.begin() + static_cast<std::ptrdiff_t>((order + 2) / 2);
      const auto end = size.begin() + static_cast<std::ptrdiff_t>(order + 1);
      CAPTURE(order);
      CHECK(*std::max_element(half, end) >= *std::max_element(end, size.end()));
    }
  }
}

TEST_CASE("a series is refused where it diverges", "[free_pendulum][extreme]") {
  const FrequencySeries series = pendulum_frequency_series(10);
  for (const double amplitude : {std::numbers::pi, 4.0, 1e300, HUGE_VAL}) {
    const SeriesValue value = evaluate(series.period, series.radius, amplitude);
    CHECK(std::isnan(value.value));
    CHECK(value.error == HUGE_VAL);
    CHECK(value.outcome == Outcome::failed);
  }
  CHECK(evaluate(series.period, series.radius, 1e-200).value == 1.0);
}

TEST_CASE("the cubic truncation is found to diverge at its own separatrix", "[free_pendulum][unit]") {
  const FrequencySeries series = frequency_series({0.0, 0.0, 0.5, 0.0, -1.0 / 24.0}, 40);
  CHECK(series.radius > std::sqrt(6.0));
  CHECK(series.radius < 1.1 * std::sqrt(6.0));
}

TEST_CASE("series want a minimum", "[free_pendulum][misuse]") {
  CHECK_THROWS_AS(frequency_series({0.0, 0.0, -1.0}, 4), InvalidInput);
  CHECK_THROWS_AS(frequency_series({0.0, 0.0}, 4), InvalidInput);
  CHECK_THROWS_AS(frequency_series({0.0, 1.0, 1.0}, 4), InvalidInput);
  CHECK_THROWS_AS(frequency_series({0.0, 0.0, 1.0, NAN}, 4), InvalidInput);
  CHECK_THROWS_AS(pendulum_frequency_series(-1), InvalidInput);
  CHECK_THROWS_AS(evaluate({}, 0.0, 1.0), InvalidInput);
  CHECK_THROWS_AS(evaluate({}, 1.0, -1.0), InvalidInput);
}

}  // namespace strutt::test::frequency_series_test
