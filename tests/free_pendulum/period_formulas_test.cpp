#include "strutt/free_pendulum/period_formulas.hpp"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/frequency_series.hpp"
#include "strutt/free_pendulum/normal_form.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::period_formulas_test {

namespace {

using Real = boost::multiprecision::cpp_bin_float_100;
constexpr double kPiDouble = std::numbers::pi;
constexpr double kSqrt8 = 2.0 * std::numbers::sqrt2;
constexpr auto kNormalForm = PeriodMethod::normal_form;
constexpr auto kKrylov = PeriodMethod::krylov;
constexpr auto kSquared = PeriodMethod::krylov_squared;
constexpr auto kSeries = PeriodMethod::series;

/// 2 K(k)/pi with k = sin(amplitude/2).
Real exact_ratio(const Real& amplitude) {
  return 2 * boost::math::ellint_1(sin(amplitude / 2)) / boost::math::constants::pi<Real>();
}

/// The series of the period up to A^12, from the rational numbers.
Real series_ratio(const Real& amplitude) {
  static const auto coefficients = pendulum_frequency_series(12).period;
  Real sum = 0;
  for (auto k = coefficients.size(); k-- > 0;)
    sum = sum * amplitude + Real(coefficients[k].numerator) / Real(coefficients[k].denominator);
  return sum;
}

Real formula_ratio(PeriodMethod formula, const Real& amplitude) {
  if (formula == kSeries) return series_ratio(amplitude);
  const Real square = amplitude * amplitude;
  return formula == kSquared ? 1 / sqrt(1 - square / 8) : 1 / (1 - square / 16);
}

Real true_error(PeriodMethod formula, const Real& amplitude) {
  return formula_ratio(formula, amplitude) / exact_ratio(amplitude) - 1;
}

void check_error(const FormulaError& found, PeriodMethod formula, const Real& amplitude) {
  const Real error = true_error(formula, amplitude);
  INFO("amplitude " << amplitude.convert_to<double>());
  const Real distance = abs(Real(found.relative_error) - error) / (abs(error) + Real("1e-86"));
  check_within("error that a formula of the period states for itself (relative)",
               static_cast<double>(distance), 2e-14);  // what 100 digits leave
  CHECK(abs(Real(found.ratio) / formula_ratio(formula, amplitude) - 1) <= 7 * 0x1p-53);
}

}  // namespace

TEST_CASE("(22) has the coefficient that the normal form derives", "[free_pendulum][paper][ratchet]") {
  const auto field = [](const Jet& phi, const Jet& velocity) { return JetPair{velocity, -sin(phi)}; };
  const NormalForm form = normal_form(taylor_expansion(field, {0.0, 0.0}));
  for (const double amplitude : {0.0, 0.3, 1.0, 2.0, 3.0})
    check_close("formula (22) against the normal form (relative)",
                formula_of_amplitude(kNormalForm, amplitude).ratio,
                normal_form_period(form, amplitude) / (2.0 * std::numbers::pi), 8e-16);
}

TEST_CASE("formula errors keep their digits from 1e-60 rad up", "[free_pendulum][reference][ratchet]") {
  for (const PeriodMethod formula : kPeriodFormulas) {
    for (double amplitude = 1e-3; amplitude < kPiDouble; amplitude += 0.0317) {
      if (formula == kSquared && amplitude >= kSqrt8) continue;
      check_error(formula_of_amplitude(formula, amplitude), formula, amplitude);
      CHECK(strutt::formula_ratio(formula, amplitude) == formula_of_amplitude(formula, amplitude).ratio);
    }
    for (const double amplitude : {1e-5, 0.01, 0.0999999, 0.1, 0.100001, 0.2999, 0.3, 0.3001})
      check_error(formula_of_amplitude(formula, amplitude), formula, amplitude);
    CHECK(formula_of_amplitude(formula, 0.0).relative_error == 0.0);
  }
  // The first terms left, from the series of the frequency.
  check_close("error of a formula at 1e-60 rad (relative)",
              formula_of_amplitude(kKrylov, 1e-60).relative_error, 1e-240 / 3072, 8e-16);
  check_close("error of a formula at 1e-60 rad (relative)",
              formula_of_amplitude(kSquared, 1e-60).relative_error, 1e-240 * 7 / 3072, 8e-16);
  check_error(formula_of_amplitude(kKrylov, kPiDouble), kKrylov, kPiDouble);
}

TEST_CASE("formula errors of orbits told from the top or by the excess",
          "[free_pendulum][reference][ratchet]") {
  const Real pi = boost::math::constants::pi<Real>();
  for (const PeriodMethod formula : {kKrylov, kSquared, kSeries}) {
    for (const double from_top : {0.4, 1.0, 2.0, 3.0, 3.14, 3.141592653589793}) {
      check_error(formula_of_from_top(formula, from_top), formula, pi - Real(from_top));
      const double excess = -from_top;
      check_error(formula_of_excess(formula, excess), formula, 2 * acos(sqrt(Real(-excess)) / 2));
    }
    check_error(formula_of_excess(formula, std::nextafter(-4.0, 0.0)), formula,
                2 * acos(sqrt(-Real(std::nextafter(-4.0, 0.0))) / 2));
    CHECK(formula_of_excess(formula, -4.0).relative_error == 0.0);
  }
  // T/T0 = (2/pi) ln(4/k') next to the separatrix, where pi - from_top has no digit of from_top left.
  const double exact = 2.0 / kPiDouble * (std::log(8.0) - std::log(1e-300));
  const double ratio = 1.0 / (1.0 - kPiDouble * kPiDouble / 16.0);
  check_close("error of a formula next to the separatrix (relative)",
              formula_of_from_top(kKrylov, 1e-300).relative_error, ratio / exact - 1.0, 8e-16);
  check_close("error of a formula next to the separatrix (relative)",
              formula_of_excess(kKrylov, -1e-300).relative_error,
              formula_of_from_top(kKrylov, 1e-150).relative_error, 8e-16);
}

TEST_CASE("no formula where it has no meaning", "[free_pendulum][misuse]") {
  for (const double excess : {0.0, 1e-300, 1.0, 1e10})
    CHECK(std::isnan(formula_of_excess(kKrylov, excess).ratio));
  CHECK(std::isnan(formula_of_from_top(kNormalForm, 0.0).relative_error));
  CHECK(std::isnan(formula_of_amplitude(kSquared, 2.8285).relative_error));
  CHECK(std::isnan(formula_of_amplitude(kSquared, kPiDouble).ratio));
  CHECK_THROWS_AS(formula_of_amplitude(kKrylov, 3.15), InvalidInput);
  CHECK_THROWS_AS(formula_of_amplitude(kKrylov, NAN), InvalidInput);
  CHECK_THROWS_AS(formula_of_from_top(kKrylov, -0.1), InvalidInput);
  CHECK_THROWS_AS(formula_of_excess(kKrylov, -4.1), InvalidInput);
  CHECK_THROWS_AS(formula_of_amplitude(PeriodMethod::elliptic, 1.0), InvalidInput);
  CHECK_THROWS_AS(largest_amplitude(PeriodMethod::separatrix, 1e-3), InvalidInput);
  CHECK_THROWS_AS(largest_amplitude(kKrylov, 0.0), InvalidInput);
  CHECK_THROWS_AS(CheapestPeriod(NAN), InvalidInput);
  CHECK_THROWS_AS(CheapestPeriod(1e-3).method(-1.0), InvalidInput);
  CHECK_THROWS_AS(CheapestPeriod(1e-3).of_amplitude(4.0), InvalidInput);
  CHECK_THROWS_AS(CheapestPeriod(1e-3).ratio(3.15), InvalidInput);
  CHECK_THROWS_AS(CheapestPeriod(1e-3).ratio(NAN), InvalidInput);
  CHECK_THROWS_AS(CheapestPeriod(1.0).ratio(3.15), InvalidInput);
  CHECK_THROWS_AS(strutt::formula_ratio(kKrylov, 3.15), InvalidInput);
  CHECK_THROWS_AS(strutt::formula_ratio(kKrylov, -0.1), InvalidInput);
  CHECK_THROWS_AS(strutt::formula_ratio(PeriodMethod::elliptic, 1.0), InvalidInput);
  CHECK(std::isnan(strutt::formula_ratio(kSquared, 2.83)));
}

TEST_CASE("largest amplitudes, against roots found with 40 digits", "[free_pendulum][reference][ratchet]") {
  struct Known {
    double tolerance, krylov, squared;
  };
  for (const auto& known : {Known{1e-1, 2.9849118690353382214, 2.1561288057668703879},
                            Known{1e-2, 2.6528361231152954564, 1.370223088562239821},
                            Known{5e-3, 2.5824781223166790296, 1.1711003252240519105},
                            Known{1e-3, 1.3576132210161610735, 0.80013132596393384975},
                            Known{1e-6, 0.23553689468559349598, 0.14465980301877113268}}) {
    check_close("largest amplitude of a formula (relative)", largest_amplitude(kNormalForm, known.tolerance),
                known.krylov, 8e-16);
    check_close("largest amplitude of a formula (relative)", largest_amplitude(kKrylov, known.tolerance),
                known.krylov, 8e-16);
    check_close("largest amplitude of a formula (relative)", largest_amplitude(kSquared, known.tolerance),
                known.squared, 8e-16);
  }
  check_close("largest amplitude of a formula (relative)", largest_amplitude(kKrylov, 1e-15),
              0.0013239003871955611295, 8e-16);
  check_close("largest amplitude of a formula (relative)", largest_amplitude(kKrylov, 1e-100),
              std::pow(3072e-100, 0.25), 8e-16);
  CHECK(largest_amplitude(kKrylov, 1.0) == kPiDouble);
  // On both sides of the maximum 3.5295160120862889609e-3, at 2.126000712691317753 rad.
  CHECK(largest_amplitude(kKrylov, 3.52951601e-3) == Approx(2.126).margin(1e-3));
  CHECK(largest_amplitude(kKrylov, 3.52951602e-3) > 2.5);
}

TEST_CASE("the error is within the tolerance on all of the range, and no further", "[free_pendulum][exact]") {
  for (const PeriodMethod formula : {kKrylov, kSquared, kSeries}) {
    for (const double tolerance : {1e-12, 1e-6, 1e-3, 3.5e-3, 4e-3, 1e-2, 1e-1}) {
      const double reach = largest_amplitude(formula, tolerance);
      for (int i = 1; i <= 60; ++i)
        CHECK(abs(true_error(formula, Real(reach) * i / 60)) <= tolerance * (1 + 1e-13));
      CHECK(abs(true_error(formula, Real(reach) * (1 + 1e-9))) > tolerance);
    }
  }
}

TEST_CASE("the cheapest formula is good enough, and its error is bounded", "[free_pendulum][reference]") {
  const Real pi = boost::math::constants::pi<Real>();
  const Eigenfrequency alpha{3.7, 0.0};
  for (const double tolerance : {5e-16, 1e-15, 2e-15, 1e-12, 1e-6, 1e-3, 1e-2, 1e-1}) {
    const CheapestPeriod cheapest(tolerance);
    const auto check = [&](const Period& found, const Real& amplitude) {
      INFO("tolerance " << tolerance << ", amplitude " << amplitude.convert_to<double>());
      const Real exact = exact_ratio(amplitude);
      CHECK(found.error <= tolerance);
      CHECK(abs(Real(found.ratio) / exact - 1) <= found.error);
      CHECK(abs(Real(found.period) / (exact * 2 * pi / Real(alpha.value)) - 1) <= found.error);
    };
    for (double x = 1e-4; x < kPiDouble; x += 0.0713) {
      check(cheapest.of_amplitude(x, alpha), x);
      CHECK(cheapest.ratio(x) == cheapest.of_amplitude(x).ratio);
      check(cheapest.of_from_top(x, alpha), pi - Real(x));
      check(cheapest.of_excess(-x, alpha), 2 * acos(sqrt(Real(x)) / 2));
    }
  }
}

TEST_CASE("which formula is chosen", "[free_pendulum][exact]") {
  const CheapestPeriod coarse(1e-3), fine(1e-15);
  CHECK(coarse.method(1.3576) == kNormalForm);
  CHECK(coarse.method(1.3577) == kSeries);
  CHECK(coarse.method(2.2390) == kSeries);
  // Here (31) happens to be right, but not on the way.
  CHECK(coarse.method(2.46309) == PeriodMethod::elliptic);
  CHECK(CheapestPeriod(4e-3).method(2.46309) == kNormalForm);
  CHECK(fine.method(0.0) == PeriodMethod::elliptic);
  CHECK(coarse.of_amplitude(1.0).method == kNormalForm);
  CHECK(coarse.of_amplitude(1.0).ratio == 1.0 / (1.0 - 1.0 / 16.0));
  CHECK(coarse.of_from_top(0.0).method == PeriodMethod::separatrix);
  CHECK(coarse.of_excess(0.0).method == PeriodMethod::separatrix);
  CHECK(coarse.of_excess(1e-3).method == PeriodMethod::elliptic);
}

TEST_CASE("quite good agreement for 0 <= mu < 2.7, as a number", "[free_pendulum][paper][ratchet]") {
  double worst = 0.0;
  for (int i = 0; i <= 2700; ++i)
    worst = std::max(worst, std::abs(formula_of_amplitude(kKrylov, i * 1e-3).relative_error));
  check_close("worst error of (31) up to 2.7 rad (relative)", worst, 0.01463832802374899886,
              4e-15);  // at 2.7 itself
  check_close("amplitude at which (31) has its worst error up to 2.7 rad (relative)",
              largest_amplitude(kKrylov, worst), 2.7, 8e-16);
}

}  // namespace strutt::test::period_formulas_test
