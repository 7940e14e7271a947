// The approximate formulas of the period: their true errors, how far they reach, and the choice of the
// cheapest.
#include "strutt/free_pendulum/period_formulas.hpp"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/energy.hpp"
#include "strutt/free_pendulum/frequency_series.hpp"

using namespace strutt;

namespace {

using Real = boost::multiprecision::cpp_bin_float_50;

Real exact_ratio(double amplitude) {
  return 2 * boost::math::ellint_1(sin(Real(amplitude) / 2)) / boost::math::constants::pi<Real>();
}

/// ratio/exact - 1 of the formula as it stands in the header, in 50 digits.
Real true_error(PeriodMethod formula, double amplitude) {
  const Real a = Real(amplitude) * amplitude;
  if (formula == PeriodMethod::krylov_squared) return 1 / sqrt(1 - a / 8) / exact_ratio(amplitude) - 1;
  if (formula != PeriodMethod::series) return 1 / (1 - a / 16) / exact_ratio(amplitude) - 1;
  static const auto coefficients = pendulum_frequency_series(12).period;
  Real sum = 0;
  for (auto k = coefficients.size(); k-- > 0;) {
    sum = sum * amplitude + Real(coefficients[k].numerator) / Real(coefficients[k].denominator);
  }
  return sum / exact_ratio(amplitude) - 1;
}

}  // namespace

TEST_CASE("the error of a formula is the one against 50 digits", "[free_pendulum][reference]") {
  for (const auto formula : period_formulas()) {
    for (double amplitude = 0.0; amplitude < formula_limit(formula); amplitude += 0.01) {
      const FormulaError found = formula_error(formula, amplitude);
      INFO(to_string(formula) << " at " << amplitude);
      CHECK(abs(found.relative_error - true_error(formula, amplitude)) <=
            1.5e-15 * std::max(1.0, found.ratio));
    }
  }
}

TEST_CASE("a formula is within the tolerance up to its reach, and not beyond", "[free_pendulum][reference]") {
  for (const auto formula : period_formulas()) {
    for (const double tolerance : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 3.4e-3, 3.5e-3, 1e-2, 0.1}) {
      const double reach = formula_reach(formula, tolerance);
      INFO(to_string(formula) << " within " << tolerance << " up to " << reach);
      REQUIRE(reach > 0.0);
      for (int k = 1; k <= 200; ++k) CHECK(abs(true_error(formula, reach * k / 200)) <= tolerance);
      if (reach < formula_limit(formula) - 1e-6)
        CHECK(abs(true_error(formula, reach * (1 + 1e-5))) > tolerance - 2 * kFormulaRounding);
    }
    CHECK(formula_reach(formula, 1e-15) == 0.0);
  }
}

TEST_CASE("the error of (31) is not monotone: the first crossing counts", "[free_pendulum][paper]") {
  // It rises to 3.5e-3 and vanishes at 2.46309 before it leaves for -1.
  CHECK(formula_reach(PeriodMethod::krylov, 3e-3) < 2.0);
  CHECK(formula_reach(PeriodMethod::krylov, 4e-3) > 2.46309);
  CHECK(std::abs(formula_error(PeriodMethod::krylov, 2.46309).relative_error) < 1e-6);
  // The paper: "quite good agreement for 0 <= mu < 2.7". Measured: within 1.47 percent.
  CHECK(formula_reach(PeriodMethod::krylov, 0.0147) > 2.7);
  CHECK(formula_reach(PeriodMethod::krylov, 0.0146) < 2.7);
}

TEST_CASE("the cheapest formula is chosen, with a bound of its error", "[free_pendulum][period]") {
  const CheapestPeriod rough(1e-3), fine(1e-9), finest(5e-16);
  CHECK(rough.method(1.0) == PeriodMethod::krylov);
  CHECK(rough.method(1.5) == PeriodMethod::series);
  CHECK(rough.method(3.1) == PeriodMethod::elliptic);
  CHECK(fine.method(0.01) == PeriodMethod::krylov);
  CHECK(fine.method(0.5) == PeriodMethod::series);
  CHECK(finest.method(1e-3) == PeriodMethod::elliptic);
  CHECK(rough.method(std::nan("")) == PeriodMethod::elliptic);

  const Eigenfrequency alpha{3.0, 0.0};
  for (const auto* cheapest : {&rough, &fine, &finest}) {
    for (double from_top = 0.04; from_top < 3.14; from_top += 0.05) {
      const Period exact = period_of_from_top(from_top, alpha);
      const Period found = cheapest->replace(exact, std::numbers::pi - from_top, alpha);
      const Real truth =
          2 * boost::math::ellint_1(cos(Real(from_top) / 2)) / boost::math::constants::pi<Real>();
      CHECK(abs(Real(found.ratio) / truth - 1) <= found.error);
      CHECK(found.period == Approx(2.0 * std::numbers::pi / 3.0 * found.ratio).epsilon(1e-15));
    }
  }
  CHECK(rough.replace(period_of_excess(1.0), energy_integral(1.0).amplitude).method ==
        PeriodMethod::elliptic);
  CHECK(rough.replace(period_of_from_top(0.0), std::numbers::pi).method == PeriodMethod::separatrix);
}

TEST_CASE("formulas refuse what they are not defined for", "[free_pendulum][misuse]") {
  CHECK_THROWS_AS(formula_error(PeriodMethod::krylov_squared, 2.9), InvalidInput);
  CHECK_THROWS_AS(formula_error(PeriodMethod::series, -0.1), InvalidInput);
  CHECK_THROWS_AS(formula_error(PeriodMethod::krylov, std::nan("")), InvalidInput);
  CHECK_THROWS_AS(formula_error(PeriodMethod::elliptic, 1.0), InvalidInput);
  CHECK_THROWS_AS(formula_reach(PeriodMethod::krylov, 0.0), InvalidInput);
  CHECK_THROWS_AS(CheapestPeriod(std::nan("")), InvalidInput);
}
