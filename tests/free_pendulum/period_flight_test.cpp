// Parts of a period: times of flight, and the quarter period as an event of the integrator.
#include <catch2/catch.hpp>
#include <cmath>

#include "reference/free_pendulum.hpp"
#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/period.hpp"
#include "strutt/integrate/integrator.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::period_flight_test {

namespace {

const double kPiRounded = exact::pi<double>();

}  // namespace

TEST_CASE("the time of flight is the elliptic integral", "[free_pendulum][period][flight][ratchet]") {
  using exact::Real;  // 100 digits: k next to 1
  SECTION("librations") {
    const auto [amplitude, angle] = GENERATE(table<double, double>(
        {{1.0, 0.3}, {3.1, 3.0}, {3.1, 3.0999999}, {1e-10, 3e-11}, {kPiRounded, 3.14}}));
    const Real k = sin(Real(amplitude) / 2);
    const Real psi = asin(Real(sin(Real(angle) / 2) / k));
    const Real truth = boost::math::ellint_1(k, psi);
    const BoundedNumber time = libration_time_of_flight(amplitude, angle);
    CHECK(abs(time.value / truth - 1) <= Real(time.error));
    check_close("time of flight to the turning point against a quarter of the period (relative)",
                libration_time_of_flight(amplitude, amplitude).value, period_of_amplitude(amplitude).quarter,
                8e-16);
  }
  SECTION("rotations") {
    const auto [excess, angle] =
        GENERATE(table<double, double>({{1.0, 0.3}, {1e-10, 3.0}, {5.0, 4.0}, {1e6, 1000.0}}));
    const Real w = sqrt(4 + Real(excess));
    const Real truth = 2 / w * boost::math::ellint_1(Real(2 / w), Real(Real(angle) / 2));
    const BoundedNumber time = rotation_time_of_flight(excess, angle);
    CHECK(abs(time.value / truth - 1) <= Real(time.error));
  }
  SECTION("down to the smallest angles") {
    const double angle = GENERATE(5e-324, 1e-320, 1e-310, 1e-305, 1e-250, 0.99e-150, 1.01e-150);
    for (const double amplitude : {2e-323, 1e-310, 1e-300, 1e-150, 1e-99, 1.0, kPiRounded}) {
      if (angle > amplitude) continue;
      const Real truth = asin(Real(sin(Real(angle) / 2) / sin(Real(amplitude) / 2)));  // F(psi) = psi here
      const BoundedNumber time = libration_time_of_flight(amplitude, angle);
      CAPTURE(amplitude, angle, time.value);
      CHECK(abs(time.value / truth - 1) <= Real(time.error));
      CHECK((time.error < 1.2e-16 || time.value < 1e-290));
    }
    for (const double excess : {1e-80, 1.0, 1e300}) {
      const Real truth = Real(angle) / sqrt(4 + Real(excess));
      const BoundedNumber time = rotation_time_of_flight(excess, angle);
      CAPTURE(excess, angle, time.value);
      CHECK(abs(time.value / truth - 1) <= Real(time.error));
    }
  }
  SECTION("misuse") {
    CHECK_THROWS_AS(libration_time_of_flight(1.0, 1.1), InvalidInput);
    CHECK_THROWS_AS(libration_time_of_flight(1.0, -0.1), InvalidInput);
    CHECK_THROWS_AS(rotation_time_of_flight(0.0, 1.0), InvalidInput);
    CHECK(libration_time_of_flight(0.0, 0.0).value == 0.0);
  }
}

TEST_CASE("integration to the quarter-period event agrees with the elliptic period to its tolerance",
          "[free_pendulum][period][referee]") {
  const RightHandSide pendulum = [](double, StateView y, StateOut dydt) {
    dydt[0] = y[1];
    dydt[1] = -std::sin(y[0]);
  };
  const EventRequest bottom{[](double, StateView y, StateOut g) { g[0] = y[0]; }, {Crossing::falling}};
  const double tolerance = GENERATE(1e-6, 1e-9, 1e-12);
  Integrator integrator(2, {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
  for (const double amplitude : {1e-3, 0.3, 1.0, 2.0, 2.7, 3.0, 3.1}) {
    Eigen::VectorXd y{{amplitude, 0.0}};
    const IntegrationResult result = integrator.advance(pendulum, 0.0, 20.0, y, &bottom);
    REQUIRE(result.events.size() == 1);
    const double error = std::abs(result.t / period_of_amplitude(amplitude).quarter - 1.0);
    CAPTURE(tolerance, amplitude, error, result.cost.right_hand_sides);
    CHECK(error <= tolerance);
    CHECK(result.cost.right_hand_sides > 10);
  }
}

}  // namespace strutt::test::period_flight_test
