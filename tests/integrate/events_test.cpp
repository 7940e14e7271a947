#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "integrate/methods.hpp"
#include "strutt/base/error.hpp"
#include "strutt/integrate/integrator.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::events_test {

using Eigen::VectorXd;

namespace {

void pendulum(double, StateView y, StateOut dydt) {
  dydt[0] = y[1];
  dydt[1] = -std::sin(y[0]);
}

void position(double, StateView y, StateOut g) { g[0] = y[0]; }

const std::vector<Method> kAccurate{
    {Backend::arkode_erk, 5}, {Backend::arkode_erk, 6}, {Backend::arkode_erk, 8}, {Backend::cvode_adams, 8}};

/// The times of the events of a run of the oscillator x = cos t.
std::vector<double> event_times(const Method& method, const EventRequest& request, double t0, double t1) {
  VectorXd y = vector({std::cos(t0), -std::sin(t0)});
  const IntegrationResult result = integrate(oscillator, t0, t1, y, options_of(method, 1e-11), &request);
  CHECK(result.outcome == Outcome::converged);
  CHECK(result.t == t1);
  check_within("state at the end of an oscillation at tolerance 1e-11",
               (y - vector({std::cos(t1), -std::sin(t1)})).norm(), 1e-8);
  std::vector<double> times;
  for (const Event& event : result.events) {
    times.push_back(event.t);
    check_within("state at an event of an oscillation at tolerance 1e-11",
                 (event.state - vector({std::cos(event.t), -std::sin(event.t)})).norm(), 1e-8);
  }
  return times;
}

void check_times(const std::vector<double>& found, const std::vector<double>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    check_within("time of an event of an oscillation at tolerance 1e-11", std::abs(found[i] - expected[i]),
                 4e-10);
}

}  // namespace

TEST_CASE("a quarter of the period of the pendulum", "[integrate][events][ratchet]") {
  const double expected = 1.18034059901609622604533794 * M_PI / 2.0;
  for (const Method& method : kAccurate) {
    INFO(name(method));
    for (const double direction : {1.0, -1.0}) {
      VectorXd y = vector({M_PI / 2.0, 0.0});
      const EventRequest request{position, {Crossing::falling}};
      const auto result = integrate(pendulum, 0.0, 10.0 * direction, y, options_of(method, 1e-13), &request);
      CHECK(result.outcome == Outcome::converged);
      REQUIRE(result.events.size() == 1);
      check_within("time of an event at tolerance 1e-13", std::abs(result.t * direction - expected), 1e-12);
      CHECK(result.events[0].t == result.t);
      CHECK(same_bits(result.events[0].state, y));
      check_within("angle at an event of the pendulum at tolerance 1e-13", std::abs(y[0]), 1e-13);
      check_within("velocity at an event of the pendulum at tolerance 1e-13",
                   std::abs(y[1] + direction * std::sqrt(2.0)), 1.5e-12);
    }
  }
}

TEST_CASE("zeros of an oscillator, by direction of the crossing and of the run",
          "[integrate][events][ratchet]") {
  const double quarter = M_PI / 2.0;
  for (const Method& method : kAccurate) {
    INFO(name(method));
    check_times(event_times(method, {position, {Crossing::both}, false}, 0.0, 9.0),
                {quarter, 3 * quarter, 5 * quarter});
    check_times(event_times(method, {position, {Crossing::rising}, false}, 0.0, 12.0),
                {3 * quarter, 7 * quarter});
    check_times(event_times(method, {position, {Crossing::falling}, false}, 0.0, 12.0),
                {quarter, 5 * quarter});
    // Backward the oscillator rises where it falls forward.
    check_times(event_times(method, {position, {Crossing::rising}, false}, 9.0, 0.0), {5 * quarter, quarter});
    check_times(event_times(method, {position, {Crossing::both}, false}, 0.0, -6.0),
                {-quarter, -3 * quarter});
  }
}

TEST_CASE("a zero at the start is not an event, and the next one is found", "[integrate][events][ratchet]") {
  for (const Method& method : kAccurate) {
    INFO(name(method));
    VectorXd y = vector({0.0, 1.0});
    const EventRequest request{position, {Crossing::both}};
    const auto result = integrate(oscillator, 0.0, 10.0, y, options_of(method, 1e-11), &request);
    REQUIRE(result.events.size() == 1);
    check_within("time of an event after a zero at the start at tolerance 1e-11", std::abs(result.t - M_PI),
                 1.2e-10);
  }
}

TEST_CASE("several event functions, in one step and in order", "[integrate][events][ratchet]") {
  // With loose tolerances and a high order steps span many of these zeros.
  const auto levels = [](double t, StateView y, StateOut g) {
    g[0] = y[0] - 0.5;
    g[1] = y[0] - 0.51;
    g[2] = y[0] + 0.1;
    g[3] = t - 1.3;
  };
  const EventRequest request{levels, std::vector<Crossing>(4, Crossing::both), false};
  for (const Method& method : kAccurate) {
    INFO(name(method));
    VectorXd y = vector({1.0, 0.0});
    const auto result = integrate(oscillator, 0.0, 2.0, y, options_of(method, 1e-6), &request);
    REQUIRE(result.events.size() == 4);
    const std::vector<int> order{1, 0, 3, 2};
    const std::vector<double> times{std::acos(0.51), std::acos(0.5), 1.3, std::acos(-0.1)};
    for (int i = 0; i < 4; ++i) {
      CHECK(result.events[i].index == order[i]);
      check_within("time of one of several events at tolerance 1e-6", std::abs(result.events[i].t - times[i]),
                   4e-6);
    }
  }
}

TEST_CASE("an event at the end of the run", "[integrate][events][ratchet]") {
  const auto at_one = [](double t, StateView, StateOut g) { g[0] = t - 1.0; };
  for (const Method& method : kMethods) {
    INFO(name(method));
    for (const bool terminal : {true, false}) {
      VectorXd y = vector({1.0, 0.0});
      const EventRequest request{at_one, {Crossing::both}, terminal};
      const auto result = integrate(oscillator, 0.0, 1.0, y, options_of(method, 1e-6), &request);
      CHECK(result.outcome == Outcome::converged);
      check_within("time of an event at the end of a run", std::abs(result.t - 1.0), 8e-16);
      REQUIRE(result.events.size() == 1);
      check_within("time of an event at the end of a run", std::abs(result.events[0].t - 1.0), 8e-16);
    }
  }
}

TEST_CASE("an event function that vanishes does not stop a run for good", "[integrate][events]") {
  const auto zero = [](double, StateView, StateOut g) { g[0] = 0.0; };
  for (const Method& method : kAccurate) {
    VectorXd y = vector({1.0, 0.0});
    const EventRequest request{zero, {Crossing::both}};
    CHECK(integrate(oscillator, 0.0, 1.0, y, options_of(method, 1e-6), &request).outcome ==
          Outcome::converged);
  }
}

TEST_CASE("the cost of locating events is counted", "[integrate][events][cost]") {
  for (const Method& method : kAccurate) {
    long calls = 0;
    const auto counted = [&calls](double t, StateView y, StateOut dydt) {
      ++calls;
      oscillator(t, y, dydt);
    };
    VectorXd y = vector({1.0, 0.0});
    const EventRequest request{position, {Crossing::both}, false};
    const auto result = integrate(counted, 0.0, 30.0, y, options_of(method, 1e-9), &request);
    CHECK(result.events.size() == 10);
    CHECK(result.cost.right_hand_sides == calls);
  }
}

TEST_CASE("bad event requests are refused", "[integrate][events]") {
  VectorXd y = vector({1.0, 0.0});
  const EventRequest empty{{}, {Crossing::both}};
  CHECK_THROWS_AS(integrate(oscillator, 0.0, 1.0, y, {}, &empty), InvalidInput);
  const EventRequest none{position, {}};
  CHECK_THROWS_AS(integrate(oscillator, 0.0, 1.0, y, {}, &none), InvalidInput);
}

}  // namespace strutt::test::events_test
