#include "base/minimum.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace strutt::test::minimum_test {

TEST_CASE("a minimum is found wherever it lies between its ends", "[base]") {
  for (const double place : {1e-9, 0.3, 1e6 + 0.3}) {
    const auto [found, value] =
        least_between([&](double x) { return 2.0 + (x - place) * (x - place); }, place - 0.1, place + 0.4);
    CAPTURE(place);
    CHECK(std::abs(found - place) <= 2e-8);
    CHECK(value <= 2.0 + 0x1p-51);
  }
}

TEST_CASE("a minimum at an end is found there", "[base]") {
  CHECK(least_between([](double x) { return x; }, -3.0, 5.0).place <= -3.0 + 2e-7);
  CHECK(least_between([](double x) { return -x; }, -3.0, 5.0).place >= 5.0 - 2e-7);
}

}  // namespace strutt::test::minimum_test
