#include "strutt/free_pendulum/jet.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::jet_test {

namespace {

/// Taylor coefficients of h(u) = h0 + h1 du + h2 du^2 + h3 du^3 with u = x^2 y, in closed form, against f.
void check_composition(const Jet& f, double x, double y, const std::array<double, 4>& h) {
  // du = u - x^2 y in powers of dx, dy.
  const double du10 = 2 * x * y, du01 = x * x, du20 = y, du11 = 2 * x, du21 = 1;
  const auto check = [&](int i, int j, double value) {
    check_within("Taylor coefficient of a composed function over max(1; its size)",
                 std::abs(f.coefficient(i, j) - value) / std::max(1.0, std::abs(value)), 4e-15);
  };
  check(0, 0, h[0]);
  check(1, 0, h[1] * du10);
  check(0, 1, h[1] * du01);
  check(2, 0, h[1] * du20 + h[2] * du10 * du10);
  check(1, 1, h[1] * du11 + 2 * h[2] * du10 * du01);
  check(0, 2, h[2] * du01 * du01);
  check(3, 0, 2 * h[2] * du10 * du20 + h[3] * du10 * du10 * du10);
  check(2, 1, h[1] * du21 + 2 * h[2] * (du10 * du11 + du20 * du01) + 3 * h[3] * du10 * du10 * du01);
  check(1, 2, 2 * h[2] * du11 * du01 + 3 * h[3] * du10 * du01 * du01);
  check(0, 3, h[3] * du01 * du01 * du01);
}

}  // namespace

TEST_CASE("functions of x^2 y have the Taylor coefficients of the chain rule",
          "[free_pendulum][unit][ratchet]") {
  const double x = 0.75, y = 1.25, u = x * x * y;
  const Jet jet = Jet::first_variable(x) * Jet::first_variable(x) * Jet::second_variable(y);
  const double s = std::sin(u), c = std::cos(u), e = std::exp(u), t = std::tan(u), sh = std::sinh(u),
               ch = std::cosh(u);
  check_composition(sin(jet), x, y, {s, c, -s / 2, -c / 6});
  check_composition(cos(jet), x, y, {c, -s, -c / 2, s / 6});
  check_composition(exp(jet), x, y, {e, e, e / 2, e / 6});
  check_composition(log(jet), x, y, {std::log(u), 1 / u, -1 / (2 * u * u), 1 / (3 * u * u * u)});
  check_composition(sinh(jet), x, y, {sh, ch, sh / 2, ch / 6});
  check_composition(cosh(jet), x, y, {ch, sh, ch / 2, sh / 6});
  const double r = std::sqrt(u), sec = 1 + t * t;
  check_composition(sqrt(jet), x, y, {r, 1 / (2 * r), -1 / (8 * r * u), 1 / (16 * r * u * u)});
  check_composition(tan(jet), x, y, {t, sec, t * sec, sec * (1 + 3 * t * t) / 3});
  const double w = 1 / (1 + u * u), th = std::tanh(u), sech = 1 - th * th;
  check_composition(atan(jet), x, y, {std::atan(u), w, -u * w * w, (3 * u * u - 1) * w * w * w / 3});
  check_composition(tanh(jet), x, y, {th, sech, -th * sech, sech * (3 * th * th - 1) / 3});
  check_composition(pow(jet, 1.5), x, y, {u * r, 1.5 * r, 0.375 / r, -0.0625 / (r * u)});
  check_composition(1.0 / jet, x, y, {1 / u, -1 / (u * u), 1 / (u * u * u), -1 / (u * u * u * u)});
}

TEST_CASE("jets add, subtract and multiply with numbers on either side", "[free_pendulum][unit]") {
  Jet f = 2.0 * Jet::first_variable(0.0) - Jet::second_variable(0.0) / 4.0 + 1.0;
  f -= 3.0;
  f *= f;
  f += 1.0;
  f /= 2.0;  // ((2x - y/4 - 2)^2 + 1)/2
  CHECK(f.coefficient(0, 0) == 2.5);
  CHECK(f.coefficient(1, 0) == -4.0);
  CHECK(f.coefficient(0, 1) == 0.5);
  CHECK(f.coefficient(2, 0) == 2.0);
  CHECK(f.coefficient(1, 1) == -0.5);
  CHECK(f.coefficient(0, 2) == 0.03125);
  CHECK((-f).coefficient(2, 0) == -2.0);
}

TEST_CASE("coefficients beyond third order are refused", "[free_pendulum][misuse]") {
  const Jet x = Jet::first_variable(1.0);
  CHECK_THROWS_AS(x.coefficient(2, 2), InvalidInput);
  CHECK_THROWS_AS(x.coefficient(-1, 2), InvalidInput);
}

}  // namespace strutt::test::jet_test
