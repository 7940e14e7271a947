#include "base/bracketed_zero.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace strutt::test::bracketed_zero_test {

TEST_CASE("a bracketed zero is enclosed as closely as was asked for", "[base]") {
  int evaluations = 0;
  const auto f = [&](double x) {
    ++evaluations;
    return x * x * x - 2.0;
  };
  const double exact = std::cbrt(2.0);
  const auto neighbours = bracketed_zero(f, 0.0, 2.0, -2.0, 6.0, are_neighbours);
  CHECK(std::nextafter(neighbours.low, 2.0) >= neighbours.high);
  CHECK(std::abs(neighbours.middle() - exact) <= 0x1p-52);
  CHECK(evaluations < 20);
  const auto close = bracketed_zero(f, 0.0, 2.0, -2.0, 6.0, are_close);
  CHECK(close.low <= exact);
  CHECK(close.high >= exact);
  CHECK(close.high - close.low <= 2.0 * kUnit * (close.low + close.high));
  const auto coarse = [](double a, double b) { return b - a < 0.1; };
  CHECK(bracketed_zero(f, 0.0, 2.0, -2.0, 6.0, coarse).high - exact < 0.1);
  // few evaluations leave a bracket all the same
  const auto early = bracketed_zero(f, 0.0, 2.0, -2.0, 6.0, are_neighbours, 4);
  CHECK(early.high - early.low > 1e-12);
  CHECK((f(early.low) < 0.0 && f(early.high) > 0.0));
  // where the function only jumps, the jump
  const auto jump =
      bracketed_zero([](double x) { return x < 0.3 ? -1.0 : 1.0; }, 0.0, 1.0, -1.0, 1.0, are_neighbours);
  CHECK(jump.high == 0.3);
}

TEST_CASE("the way to certainty doubles until it is certain, or ends", "[base]") {
  int asked = 0;
  const auto beyond = [&](double x) {
    ++asked;
    return std::abs(x - 5.0) > 0.9;
  };
  CHECK(certain_distance(5.0, 10.0, 0.125, beyond) == 1.0);
  CHECK(asked == 4);
  CHECK(certain_distance(5.0, -1.0, 0.125, beyond) == 1.0);
  CHECK(certain_distance(5.0, 5.5, 0.125, beyond) == 0.5);  // nowhere certain before the end
}

}  // namespace strutt::test::bracketed_zero_test
