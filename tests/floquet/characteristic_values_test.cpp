#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/base/error.hpp"
#include "strutt/floquet/characteristic_values.hpp"
#include "support/ratchet.hpp"
#include "support/reference.hpp"

namespace strutt::test::characteristic_values_test {

using strutt::test::check_within;

namespace {

CharacteristicPair at(int order, double q) { return characteristic_values(order, order, q).at(0); }

double promise(double value, double q) { return 4.0 * 0x1p-52 * (std::abs(value) + 2.0 * std::abs(q)); }

}  // namespace

TEST_CASE("Characteristic values have the digits of the tables", "[floquet][characteristic]") {
  CHECK(std::abs(at(0, 5.0).a.value - -5.80004602085150841910347) <= 1e-15);
  CHECK(std::abs(at(10, 25.0).a.value - 103.230204804494838176280) <= 1.5e-14);
  // DLMF table 28.6 and Abramowitz & Stegun table 20.1
  CHECK(at(1, 5.0).a.value == Approx(1.85818754).epsilon(1e-8));
  CHECK(at(1, 5.0).b->value == Approx(-5.79008060).epsilon(1e-8));
  CHECK(at(2, 25.0).b->value == Approx(-21.31486062).epsilon(1e-8));
}

TEST_CASE("Characteristic values against 100 digits: error, bound and promise",
          "[floquet][characteristic][reference][extreme][N10][ratchet]") {
  double worst = 0.0, tightest = 0.0;
  const auto rows = reference::read("characteristic");
  REQUIRE(rows.size() >= 10'000);
  for (const auto& row : rows) {
    const int order = static_cast<int>(row.input("order"));
    const double q = row.input("q");
    const auto pair = at(order, q);
    const CharacteristicValue found = row.text("kind") == "a" ? pair.a : pair.b.value();
    const auto error = static_cast<double>(abs(row.result("value") - found.value));
    const double allowed = promise(found.value, q);
    CAPTURE(row.text("kind"), order, q, found.value, found.error, error);
    CHECK(error <= found.error);
    CHECK(found.error <= allowed);
    worst = std::max(worst, error / allowed);
    tightest = std::max(tightest, found.error / allowed);
  }
  check_within("N10 error of a characteristic value over 4 x 2^-52 (|a| + 2|q|)", worst, 0.25);
  check_within("N10 bound of a characteristic value over 4 x 2^-52 (|a| + 2|q|)", tightest, 0.75);
}

TEST_CASE("Without excitation the characteristic values are squares", "[floquet][characteristic]") {
  const auto free = characteristic_values(0, 10'000, 0.0);
  REQUIRE(free.size() == 10'001);
  CHECK_FALSE(free[0].b.has_value());
  CHECK_FALSE(std::signbit(free[0].a.value));
  for (const auto& [order, a, b] : free) {
    CHECK(a.value == static_cast<double>(order) * order);
    CHECK(a.error == 0.0);
    if (order > 0) CHECK((b->value == a.value && b->error == 0.0));
  }
}

TEST_CASE("A tiny parameter is neither lost nor a failure", "[floquet][characteristic][extreme][ratchet]") {
  for (const double q : {1e-300, -1e-200, 1e-100, 1e-30, -1e-19, 1e-18, 1e-12}) {
    CAPTURE(q);
    for (const auto& [order, a, b] : characteristic_values(0, 6, q)) {
      // perturbation series, DLMF 28.6(i), to the first term; the next is below q^2
      const double square = static_cast<double>(order) * order;
      const double first = order == 1 ? q : 0.0;
      CHECK(std::abs(a.value - (square + first)) <= a.error + q * q);
      CHECK(a.error <= promise(a.value, q));
      if (b) CHECK(std::abs(b->value - (square - first)) <= b->error + q * q);
    }
    CHECK(at(0, q).a.value <= 0.0);
  }
  check_close("a_0 at q = 1e-100 against its series (relative)", at(0, 1e-100).a.value, -0.5e-200, 8e-16);
}

TEST_CASE("The index is a count: no branch is taken for another", "[floquet][characteristic][extreme][N09]") {
  for (const double q : {0.01, 1.0, 21.0, 1024.0, 1e5, 1e8}) {
    CAPTURE(q);
    const auto values = characteristic_values(0, 200, q);
    for (std::size_t n = 0; n + 1 < values.size(); ++n) {
      const auto &below = values[n].a, &above = *values[n + 1].b;
      CHECK(below.value <= above.value + below.error + above.error);
      CHECK(below.value < values[n + 1].a.value);
      if (n > 0) {
        CHECK(values[n].b->value < above.value);
        CHECK(values[n].b->value <= values[n].a.value + values[n].b->error + values[n].a.error);
      }
    }
  }
}

TEST_CASE("Twin edges are bracketed one by one: the width of tongue n, down to the rounding of a",
          "[floquet][characteristic][extreme][N06][N50]") {
  // 8 (q/4)^n/((n-1)!)^2 (1 - (n + 2) q^2/(4 (n^2 - 1)^2) + O(q^4)), from DLMF 28.6.15
  const double q = 1.0;
  double factorial = 1.0;  // (n - 1)!
  for (int n = 2; n <= 20; ++n) {
    factorial *= n - 1.0;
    const double square = n * n - 1.0;
    const double width = 8.0 * std::pow(q / 4.0, n) / (factorial * factorial) *
                         (1.0 - (n + 2.0) * q * q / (4.0 * square * square));
    const auto pair = at(n, q);
    CAPTURE(n, width);
    CHECK(std::abs(pair.a.value - pair.b->value - width) <=
          pair.a.error + pair.b->error + 0.1 * width / square);
  }
}

TEST_CASE("A narrow stable band at large q is not inverted", "[floquet][characteristic][extreme][N07]") {
  // b_(m+1) - a_m ~ 2^(4m+5)/m! sqrt(2/pi) q^(m/2+3/4) exp(-4 sqrt(q)) (DLMF 28.8.2)
  for (const double q : {25.0, 49.0, 64.0, 100.0, 400.0, 1e6}) {
    const double band =
        32.0 * std::sqrt(2.0 / std::acos(-1.0)) * std::pow(q, 0.75) * std::exp(-4.0 * std::sqrt(q));
    const auto below = at(0, q).a;
    const auto above = at(1, q).b.value();
    CAPTURE(q, band);
    CHECK(std::abs(above.value - below.value - band) <= below.error + above.error + 0.2 * band);
  }
}

TEST_CASE("Followed through q, every order stays on its curve", "[floquet][characteristic][extreme][N51]") {
  // |d a/d q| <= 2, since the derivative is a mean of 2 cos 2t
  for (double q = 0.0, step = 0.25; q < 60.0; q += step) {
    const auto here = characteristic_values(0, 12, q), there = characteristic_values(0, 12, q + step);
    for (std::size_t n = 0; n < here.size(); ++n) {
      CAPTURE(q, n);
      CHECK(std::abs(here[n].a.value - there[n].a.value) <= 2.0 * step + here[n].a.error + there[n].a.error);
      if (n > 0)
        CHECK(std::abs(here[n].b->value - there[n].b->value) <=
              2.0 * step + here[n].b->error + there[n].b->error);
    }
  }
}

TEST_CASE("SciPy #4479: nine orders at q = 21 are nine values",
          "[floquet][characteristic][extreme][defect]") {
  const auto values = characteristic_values(0, 8, 21.0);
  const auto is_14_988 = [](const auto& pair) { return std::abs(pair.a.value - 14.988) < 1e-3; };
  CHECK(std::count_if(values.begin(), values.end(), is_14_988) == 1);
  CHECK(is_14_988(values[3]));
}

TEST_CASE("SciPy #14526: a_4 has no jump from q = 600 to 1500",
          "[floquet][characteristic][extreme][defect]") {
  double previous = at(4, 600.0).a.value;
  for (double q = 601.0; q <= 1500.0; q += 1.0) {
    const double value = at(4, q).a.value;
    // da/dq is the mean of 2 cos 2t under the squared solution, which lies in the wells
    CHECK(value < previous - 1.0);
    CHECK(value > previous - 2.0);
    previous = value;
  }
}

TEST_CASE("SciPy #25856, #10316: the largest orders and parameters are values, or refused by name",
          "[floquet][characteristic][extreme][defect]") {
  for (const double q : {5e7, 1e8}) {
    for (const int order : {0, 1, 51, 55, 500, 501, 9999, 10'000}) {
      const auto pair = at(order, q);
      CAPTURE(order, q);
      CHECK(std::isfinite(pair.a.value));
      CHECK(pair.a.error <= promise(pair.a.value, q));
      if (order > 0)
        CHECK((pair.b->value <= pair.a.value + pair.a.error && pair.b->error <= promise(pair.b->value, q)));
    }
  }
  CHECK_THROWS_AS(at(100'000'000, 1e8), InvalidInput);
  CHECK_THROWS_AS(at(-1, 1.0), InvalidInput);
}

TEST_CASE("The log-q rule for the length of the matrix fails from q = 1e5 on: these are right",
          "[floquet][characteristic][extreme][N10][defect]") {
  // DLMF 28.8.1, s = 2 n + 1; the error is about the first term left out
  for (const auto& [order, q] : {std::pair{0, 1e5}, {10, 1e6}, {40, 1e6}, {40, 1e8}, {0, 1e8}}) {
    const double s = 2.0 * order + 1.0, s2 = s * s, root = std::sqrt(q);
    const double levels = -2.0 * q + 2.0 * s * root - (s2 + 1.0) / 8.0 - s * (s2 + 3.0) / (128.0 * root) -
                          (5.0 * s2 * s2 + 34.0 * s2 + 9.0) / (4096.0 * q);
    const double left_out = s * (33.0 * s2 * s2 + 410.0 * s2 + 405.0) / (131072.0 * q * root);
    CAPTURE(order, q);
    CHECK(std::abs(at(order, q).a.value - levels) <= 1.5 * left_out + promise(levels, q));
  }
}

TEST_CASE("GSL, Savannah #50343: b_70 - a_69 is positive at q = 2000",
          "[floquet][characteristic][extreme][defect]") {
  for (double q = 1000.0; q <= 2400.0; q += 100.0) {
    const auto pairs = characteristic_values(69, 70, q);
    CHECK(pairs[1].b->value - pairs[0].a.value > 70.0);
  }
}

TEST_CASE("GSL, Savannah #50343: at negative q the letters of odd orders change places, as in DLMF 28.2.28",
          "[floquet][characteristic][extreme][defect]") {
  for (const double q : {0.3, 25.0, 3000.0}) {
    for (const auto& [order, a, b] : characteristic_values(1, 12, -q)) {
      const auto there = at(order, q);
      CHECK(a.value == (order % 2 == 0 ? there.a.value : there.b->value));
      CHECK(b->value == (order % 2 == 0 ? there.b->value : there.a.value));
    }
  }
}

TEST_CASE("A characteristic value does not depend on the other orders asked for",
          "[floquet][characteristic][law]") {
  for (const double q : {1e-3, 0.2, 3.7, -3.7, 60.0, 3e3, 1e5}) {
    for (const auto& pair : characteristic_values(3, 120, q)) {
      const auto alone = at(pair.order, q);
      CHECK(alone.a.value == pair.a.value);
      CHECK(alone.b->value == pair.b->value);
      CHECK(alone.b->error == pair.b->error);
    }
  }
}

TEST_CASE("Orders and parameters out of range are refused by name", "[floquet][characteristic]") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(characteristic_values(-1, 3, 1.0), Contains("first") && Contains("10000"));
  CHECK_THROWS_WITH(characteristic_values(4, 3, 1.0), Contains("last") && Contains("10000"));
  CHECK_THROWS_WITH(characteristic_values(0, 10'001, 1.0), Contains("last"));
  for (const double q : {std::nextafter(1e8, 1e9), -1.1e8, HUGE_VAL, std::nan("")})
    CHECK_THROWS_WITH(characteristic_values(0, 3, q), Contains("q = ") && Contains("1e8"));
  CHECK_THROWS_AS(characteristic_values(0, 3, HUGE_VAL), InvalidInput);
  CHECK(characteristic_values(10'000, 10'000, -1e8).size() == 1);
}

}  // namespace strutt::test::characteristic_values_test
