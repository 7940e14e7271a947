#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/floquet/stability.hpp"
#include "support/models.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::winding_test {

using strutt::test::check_close;
using strutt::test::check_within;

namespace {

Stability at(const HillEquation& equation, double tolerance = 1e-9) {
  MonodromyEngine engine;
  return analyse(engine, equation, {.tolerance = tolerance});
}

}  // namespace

TEST_CASE("The winding number of a constant coefficient is sqrt(delta)", "[floquet][winding][ratchet]") {
  for (const double delta : {1e-6, 0.1, 0.3, 1.1, 2.0, 7.3, 123.4, 1e4 + 0.3, 1e6 + 0.7}) {
    const double winding = at(mathieu_delta_epsilon(delta, 0.0)).winding;
    check_within("winding of a constant coefficient (relative)", std::abs(winding / std::sqrt(delta) - 1.0),
                 1e-15);
  }
  for (const double delta : {-0.1, -30.0}) CHECK(at(mathieu_delta_epsilon(delta, 0.0)).winding == 0.0);
}

TEST_CASE("The winding number grows with delta and rests at n/2 inside tongue n", "[floquet][winding]") {
  for (const double epsilon : {0.3, 2.0, 6.0, -4.0}) {
    double previous = 0.0;
    for (double delta = -3.0; delta < 12.0; delta += 0.0613) {
      const auto result = at(mathieu_delta_epsilon(delta, epsilon), 1e-7);
      CHECK(result.winding >= previous);
      previous = result.winding;
      const double halves = 2.0 * result.winding;
      if (result.verdict == Verdict::unstable) CHECK(halves == std::round(halves));
      if (result.verdict == Verdict::stable) CHECK(halves != std::round(halves));
      // its parity is the sign of the discriminant
      if (result.verdict == Verdict::unstable)
        CHECK((std::fmod(halves, 2.0) == 0.0) == (result.discriminant > 0.0));
    }
    CHECK(previous > 3.0);
  }
}

TEST_CASE("Winding does not depend on damping's scaling, the phase or the route",
          "[floquet][winding][law][ratchet]") {
  for (const double delta : {0.4, 1.3, 2.8, 9.7}) {
    const double reference = at(mathieu_delta_epsilon(delta, 1.5)).winding;
    auto sine = mathieu_delta_epsilon(delta, 1.5);
    sine.coefficient = PeriodicFunction::fourier(delta, {{1, 0.0, 1.5}});
    check_close("winding seen from another phase (relative)", at(sine).winding, reference, 3e-13);
    auto shifted = sine;
    shifted.coefficient = sine.coefficient.shifted(1.234);
    check_close("winding seen from another phase (relative)", at(shifted).winding, reference, 3e-13);
    // with damping c the equation of y has delta - c^2/4
    check_close("winding with damping (relative)", at(mathieu_delta_epsilon(delta + 0.01, 1.5, 0.2)).winding,
                reference, 8e-16);
  }
}

TEST_CASE("Alternating growth and oscillation is counted", "[floquet][winding][extreme][N15]") {
  // epsilon = 1e3: for a third of the period the solution turns at up to 31 radians a unit of time
  const auto result = at(mathieu_delta_epsilon(500.0, 1000.0), 1e-6);
  CHECK(2.0 * result.winding == std::round(2.0 * result.winding));
  CHECK(result.winding > 10.0);
  CHECK(result.winding < std::sqrt(1500.0));
}

TEST_CASE("64 periods taken for one: growth and turns are 64 times those of one",
          "[floquet][winding][extreme][N21][ratchet]") {
  double largest = 0.0;
  for (const auto& [delta, epsilon] : {std::pair{1.0, 0.5}, {0.25, 0.1}, {-2.0, 1.0}, {1.7, 0.4}}) {
    const auto one = mathieu_delta_epsilon(delta, epsilon);
    auto many = one;
    for (int k = 0; k < 6; ++k) many = test::over_two_periods(many);
    const auto a = at(one, 1e-12), b = at(many, 1e-12);
    CAPTURE(delta, epsilon, a.growth, b.growth, b.error);
    CHECK(a.verdict == b.verdict);
    largest =
        std::max({largest, std::abs(b.growth / 64.0 - a.growth), std::abs(b.winding / 64.0 - a.winding)});
  }
  check_within("N21 growth and winding of 64 periods over 64: difference from those of one", largest, 1e-14);
}

}  // namespace strutt::test::winding_test
