#include "strutt/free_pendulum/elliptic.hpp"

#include <boost/math/special_functions/ellint_2.hpp>
#include <catch2/catch.hpp>
#include <limits>

#include "reference/free_pendulum.hpp"
#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::elliptic_test {

using exact::error_in_ulp;
using exact::Real;
using strutt::test::check_within;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kHalf = 0.501;  // ulp: rounded once

Real modulus_of(double k_prime) { return sqrt((1 - Real(k_prime)) * (1 + Real(k_prime))); }

/// Zeros are met to 1e-60.
double relative_error(double value, const Real& truth) {
  return static_cast<double>(Real(abs(value - truth) / (abs(truth) + Real(1e-44))));
}

}  // namespace

TEST_CASE("complete integrals from the complementary modulus",
          "[free_pendulum][elliptic][accuracy][ratchet]") {
  const double k_prime =
      GENERATE(1.0, 1.0 - 0x1p-53, 0.9, 0.5, 0.1, 1e-3, 1e-8, 6.12e-17, 1e-19, 3e-21, 1e-150, 1e-300, 5e-324);
  const Real truth = exact::ratio_by_series(Real(k_prime)) * exact::pi<Real>() / 2;
  check_within("K(k') in ulp", error_in_ulp(complete_integral(ComplementaryModulus(k_prime)), truth), kHalf);
  // 100 digits hold 1 - k'^2 for k' > 1e-45; below, E is 1.
  const Real second = k_prime < 1e-45 ? Real(1) : boost::math::ellint_2(modulus_of(k_prime));
  check_within("E(k') in ulp",
               error_in_ulp(complete_integral_second_kind(ComplementaryModulus(k_prime)), second), kHalf);
}

TEST_CASE("the arithmetic-geometric mean of any two numbers",
          "[free_pendulum][elliptic][accuracy][ratchet]") {
  const auto [a, b] = GENERATE(table<double, double>({{1.0, 2.0},
                                                      {24.0, 6.0},
                                                      {1e308, 1.5e308},
                                                      {1e300, 1e-300},
                                                      {1e-300, 3e-300},
                                                      {1.7e308, 1.6e308},
                                                      {1.7e308, 5e-324},
                                                      {1.0, 1.0},
                                                      {1.0, 1e-160}}));
  const Real larger = std::max(a, b), smaller = std::min(a, b);
  check_within("arithmetic-geometric mean in ulp",
               error_in_ulp(arithmetic_geometric_mean(a, b), exact::agm(larger, smaller)), kHalf);
  CHECK(arithmetic_geometric_mean(a, b) == arithmetic_geometric_mean(b, a));
  CHECK(arithmetic_geometric_mean(a, 0.0) == 0.0);
}

TEST_CASE("the incomplete integral, over many half turns", "[free_pendulum][elliptic][accuracy][ratchet]") {
  const double k_prime = GENERATE(1.0, 0.9, 0.3, 1e-3, 1e-9, 1e-17);
  const double psi = GENERATE(0.0, 1e-200, 0.1, -0.7, 1.5, 1.5707963267948966, 1.6, 3.0, -10.0, 100.0);
  INFO("k' = " << k_prime << ", psi = " << psi);
  const Real truth = boost::math::ellint_1(modulus_of(k_prime), Real(psi));
  const double value = incomplete_integral(psi, ComplementaryModulus(k_prime));
  check_within("F(psi; k') (relative)", relative_error(value, truth), 1.2e-16);
}

TEST_CASE("Boost, SciPy #8480: Jacobi's functions of a phase in turns",
          "[free_pendulum][elliptic][accuracy][defect][ratchet]") {
  // k = 1e-5, about 1.6e8 turns: there Boost's series for small k is off by 3e-4 in double
  const double k_prime = GENERATE(1.0, 1.0 - 1e-13, 0.99999999995, 0.9, 0.3, 1e-3, 1e-9, 1e-17);
  // next to 0.25 Boost's dn is 0/0 in double, beyond u = 355 (k' = 1e-300) SciPy's ellipj was NaN (#8480)
  const double turns = GENERATE(0.0, 1e-200, 0.01, 0.1, 0.125, 0.24999, 0.25 - 1e-10, 0.25, 0.3, 0.5, -0.7,
                                1e6 + 0.1, 1.6e8 + 0.3);
  INFO("k' = " << k_prime << ", turns = " << turns);
  const Real quarter = exact::ratio_by_agm(Real(k_prime)) * exact::pi<Real>() / 2;
  const Real rest = Real(turns) - round(Real(turns));  // Boost loses digits at late phases, too
  Real cn, dn;
  const Real sn = boost::math::jacobi_elliptic(modulus_of(k_prime), Real(4 * quarter * rest), &cn, &dn);
  // At k' = 1 the modulus is 0 and Boost gives the circular functions.
  const JacobiFunctions f = jacobi_functions(turns, ComplementaryModulus(k_prime));
  check_within("sn of a phase in turns (relative)", relative_error(f.sn, sn), 1.2e-16);
  check_within("cn of a phase in turns (relative)", relative_error(f.cn, cn), 1.2e-16);
  const Real true_dn = sqrt(Real(k_prime) * k_prime + (1 - Real(k_prime)) * (1 + Real(k_prime)) * cn * cn);
  check_within("dn of a phase in turns (relative)", relative_error(f.dn, true_dn), 1.2e-16);
}

TEST_CASE("Boost, SciPy #3904: dn at the quarter period is k' itself",
          "[free_pendulum][elliptic][exact][defect]") {
  for (const double k_prime : {1.0, 0.3, 1e-17, 1e-300}) {
    CHECK(jacobi_functions(0.25, ComplementaryModulus(k_prime)).dn == k_prime);
    CHECK(jacobi_functions(0.75, ComplementaryModulus(k_prime)).sn == -1.0);
  }
}

TEST_CASE("both moduli are told apart by their types", "[free_pendulum][elliptic][ratchet]") {
  check_close("complementary modulus (relative)", complementary(Modulus(0.6)).value, 0.8, 8e-16);
  CHECK(modulus(ComplementaryModulus(1e-8)).value == 1.0);
  check_close("complementary modulus (relative)", complementary(Modulus(1.0 - 0x1p-53)).value,
              std::sqrt(0x1p-52), 8e-16);
}

TEST_CASE("elliptic functions refuse misuse", "[free_pendulum][elliptic][error]") {
  CHECK(std::isinf(complete_integral(ComplementaryModulus(0.0))));
  CHECK(complete_integral_second_kind(ComplementaryModulus(0.0)) == 1.0);
  for (const double bad : {-0.1, 1.1, kNaN}) {
    CHECK_THROWS_AS(complete_integral(ComplementaryModulus(bad)), InvalidInput);
    CHECK_THROWS_AS(complementary(Modulus(bad)), InvalidInput);
    CHECK_THROWS_AS(jacobi_functions(0.1, ComplementaryModulus(bad)), InvalidInput);
  }
  CHECK_THROWS_AS(incomplete_integral(0.1, ComplementaryModulus(0.0)), InvalidInput);
  CHECK_THROWS_AS(incomplete_integral(kNaN, ComplementaryModulus(0.5)), InvalidInput);
  CHECK_THROWS_AS(jacobi_functions(1e17, ComplementaryModulus(0.5)), InvalidInput);
  CHECK_THROWS_AS(arithmetic_geometric_mean(-1.0, 1.0), InvalidInput);
}

}  // namespace strutt::test::elliptic_test
