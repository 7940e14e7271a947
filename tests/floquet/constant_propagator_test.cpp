#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "strutt/floquet/constant_propagator.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::constant_propagator_test {

using strutt::test::check_close;
using Real = boost::multiprecision::cpp_bin_float_100;

namespace {

/// Largest excess of |true - value| over the stated bound, entry by entry (<= 0: the bounds hold).
double excess(double w, double half_turns, double kappa) {
  const auto p = constant_propagator(w, half_turns, kappa);
  const Real pi = acos(Real(-1)), x = sqrt(abs(Real(w))) * pi * half_turns, s = sqrt(abs(Real(w)));
  const Real c = w >= 0 ? Real(cos(x)) : Real(cosh(x)), z = w >= 0 ? Real(sin(x)) : Real(sinh(x));
  const Real length = pi * half_turns;
  const Real upper = w == 0 ? Real(length * kappa) : Real(kappa * z / s);
  const Real lower = w == 0 ? Real(0) : Real((w > 0 ? -s : s) * z / kappa);
  const Real truth[2][2] = {{c, upper}, {lower, c}};
  Real worst = -1;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const Real scale = ldexp(Real(1), static_cast<int>(p.value.exponent));
      const Real error = abs(truth[i][j] / scale - p.value.mantissa(i, j)) - p.error(i, j);
      worst = std::max(worst, error);
    }
  }
  return static_cast<double>(worst);
}

}  // namespace

TEST_CASE("Closed-form propagators are within their entrywise bounds", "[floquet][reference]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> log_w(-12.0, 14.0), share(0.0, 1.0), log_kappa(0.0, 5.0);
  for (int i = 0; i < 4000; ++i) {
    const double w = (i % 2 == 0 ? 1.0 : -1.0) * std::exp(log_w(random));
    CHECK(excess(w, i % 3 == 0 ? 1.0 : share(random), std::exp(log_kappa(random))) <= 0.0);
  }
  CHECK(excess(0.0, 1.0, 3.0) <= 0.0);
}

TEST_CASE("Zeros of cos and sin keep their relative accuracy", "[floquet][extreme][N04]") {
  for (const double n : {0.5, 1.0, 1.5, 2.0, 7.0, 100.0, 12345.5}) {
    for (const double offset : {0x1p-52, -0x1p-51, 0x1p-30})
      CHECK(excess(n * n * (1.0 + offset), 1.0, n) <= 0.0);
    // exactly at n: sin (whole n) or cos (half n) is a proved zero
    const auto p = constant_propagator(n * n, 1.0, n);
    const bool whole = n == std::floor(n);
    CHECK(p.value.mantissa(0, whole ? 1 : 0) == 0.0);
    CHECK(p.error(0, whole ? 1 : 0) == 0.0);
  }
}

TEST_CASE("Strong growth does not overflow", "[floquet][extreme][N01][ratchet]") {
  const auto p = constant_propagator(-1e8, 1.0, 1e4);
  CHECK(p.value.mantissa.allFinite());
  const double expected = 1e4 * 3.14159265358979323846 - std::log(2.0);
  check_close("N01 logarithm of an entry of exp(31415) (relative)", p.value.log_max_abs(), expected, 8e-16);
}

}  // namespace strutt::test::constant_propagator_test
