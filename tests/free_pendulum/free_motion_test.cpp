#include "strutt/free_pendulum/free_motion.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "reference/free_pendulum.hpp"
#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::free_motion_test {

using exact::Real;
using exact::State;
using strutt::test::check_within;

namespace {

const double kPiRounded = exact::pi<double>();

struct Case {
  double angle, velocity, tau;
};

/// s of the accuracy promise: the largest entry of d(phi, v)/d(phi0, v0), at least 1.
double sensitivity(const Case& c) {
  const Real step("1e-45");
  const State base = exact::by_functions(c.angle, c.velocity, c.tau);
  double largest = 1.0;
  for (const bool of_angle : {true, false}) {
    const State moved = exact::by_functions(Real(c.angle) + (of_angle ? step : Real(0)),
                                            Real(c.velocity) + (of_angle ? Real(0) : step), c.tau);
    largest = std::max({largest, std::abs(static_cast<double>(Real((moved.angle - base.angle) / step))),
                        std::abs(static_cast<double>(Real((moved.velocity - base.velocity) / step)))});
  }
  return largest;
}

void check(const Case& c) {
  INFO("phi0 = " << c.angle << ", v0 = " << c.velocity << ", tau = " << c.tau);
  const State truth = exact::by_functions(c.angle, c.velocity, c.tau);
  const FreeState state = FreeMotion({}, c.angle, c.velocity).at(c.tau);
  const auto angle = static_cast<double>(truth.angle);
  const auto error = static_cast<double>(Real(abs(Real(state.angle) - truth.angle)));
  CHECK(error <= state.error);
  const double promise = 2e-15 * (sensitivity(c) * std::max({1.0, std::abs(c.angle), std::abs(c.velocity)}) +
                                  std::abs(c.tau * state.velocity) + std::abs(angle));
  check_within("angle of a free motion over what is promised", error / promise, 0.2);
  check_within("bound of a free motion over what is promised", state.error / promise, 1.0);
  const auto velocity_error = static_cast<double>(Real(abs(Real(state.velocity) - truth.velocity)));
  check_within("velocity of a free motion over what is promised", velocity_error / promise, 0.2);
}

}  // namespace

TEST_CASE("the two references of the free motion agree", "[free_pendulum][motion][reference]") {
  const Case c = GENERATE(Case{1.0, 0.0, 30.0}, Case{3.14, 1e-4, 40.0}, Case{-2.0, 1.5, 17.0},
                          Case{0.5, 3.0, 20.0}, Case{7.0, -2.5, 20.0}, Case{0.0, 1.9999999, 25.0});
  const State a = exact::by_functions(c.angle, c.velocity, c.tau);
  const State b = exact::by_taylor(c.angle, c.velocity, c.tau, static_cast<int>(c.tau * 8));
  CHECK(abs(a.angle - b.angle) < Real("1e-40"));
  CHECK(abs(a.velocity - b.velocity) < Real("1e-40"));
}

TEST_CASE("the free motion is as accurate as promised, and its bound holds",
          "[free_pendulum][motion][accuracy][ratchet]") {
  SECTION("librations") {
    check(GENERATE(Case{1.0, 0.0, 0.0}, Case{1.0, 0.0, 1.0}, Case{-1.0, 0.5, 123.0}, Case{2.9, -0.1, 1e4},
                   Case{0.0, 1.0, 7.0}, Case{100.0, 0.3, 55.0}));
  }
  SECTION("rotations") {
    check(GENERATE(Case{1.0, 3.0, 1.0}, Case{-1.0, -2.5, 123.0}, Case{3.0, 0.5, 1e4}, Case{-1e6, 10.0, 3.0}));
  }
  SECTION("tiny amplitudes") {
    check(GENERATE(Case{1e-8, 0.0, 1e5}, Case{1e-300, 1e-300, 1e3}, Case{1e-160, -3e-161, 1.0},
                   Case{0.0, 1e-20, 1e9}, Case{5e-324, 0.0, 1.0}, Case{1e-16, 1e-3, 1e6}));
  }
  SECTION("1e9 periods") {
    check(
        GENERATE(Case{1.0, 0.0, 6.3e9}, Case{3.1, 0.0, 2e10}, Case{0.3, 2.5, 3e9}, Case{1e-5, 1e-5, 6.3e9}));
  }
  SECTION("next to the separatrix, inside and outside") {
    check(GENERATE(Case{kPiRounded, 0.0, 20.0}, Case{kPiRounded, 0.0, 40.0}, Case{kPiRounded, 0.0, 1e4},
                   Case{0.0, std::nextafter(2.0, 0.0), 100.0}, Case{0.0, std::nextafter(2.0, 3.0), 100.0},
                   Case{0.0, -std::nextafter(2.0, 3.0), 18.0}, Case{kPiRounded, 1e-17, 50.0},
                   Case{kPiRounded, 2e-16, 50.0}, Case{-kPiRounded, -1.3e-16, 300.0},
                   Case{3.0, 2.0 * std::cos(1.5), 30.0}, Case{1.0, 2.0 * std::cos(0.5), 10.0}));
  }
  SECTION("huge rotations") {
    check(GENERATE(Case{1.0, 1e5, 1e3}, Case{-2.0, -1e8, 1.0}, Case{0.0, 1e12, 1e-3}));
  }
  SECTION("random") {
    std::mt19937_64 generator(7);
    std::uniform_real_distribution<double> angle(-7.0, 7.0), velocity(-3.0, 3.0), exponent(-3.0, 6.0);
    for (int i = 0; i < 150; ++i)
      check({angle(generator), velocity(generator), std::pow(10.0, exponent(generator))});
  }
}

TEST_CASE("a velocity whose square is beyond double still rotates",
          "[free_pendulum][motion][extremes][ratchet]") {
  // phi = v0 t to all digits: gravity changes it by 1/v0.
  const FreeMotion motion({}, 0.0, 1e200);
  CHECK(motion.energy().kind == MotionKind::rotation);
  const FreeState state = motion.at(1e-195);
  check_close("rotation at 1e200 (relative)", state.angle, 1e5, 8e-16);
  check_close("rotation at 1e200 (relative)", state.velocity, 1e200, 8e-16);
  CHECK(std::isinf(motion.at(1e200).error));
  CHECK(std::isnan(motion.at(1e200).angle));
}

TEST_CASE("N28: beyond 2^53 turns the phase keeps digits, and says when it has none",
          "[free_pendulum][motion][extremes][ratchet]") {
  check(GENERATE(Case{1.0, 0.0, 1e17}, Case{3.0, 0.1, 1e20}, Case{1.0, 0.0, 1e24}, Case{-0.5, 2.5, 1e17}));
  check_within("bound of a free motion at alpha t = 1e17", FreeMotion({}, 1.0, 0.0).at(1e17).error, 2.5e-12);
  const auto outcome = [](double t) {
    return free_motion({10.0, 0.0}, {1.0, 0.0}, std::array{t}, 1e-2).points[0];
  };
  CHECK(outcome(1e20).outcome == Outcome::converged);
  CHECK(outcome(1e40).outcome == Outcome::tolerance_not_reached);
  CHECK(outcome(1e40).error > kPiRounded);
  CHECK(std::abs(outcome(1e40).angle) <= 1.0);  // somewhere on its orbit
  const MotionPoint lost = outcome(1e308);
  CHECK(lost.outcome == Outcome::tolerance_not_reached);
  CHECK(std::isnan(lost.angle));
  CHECK(std::isnan(lost.velocity));
  CHECK(std::isinf(lost.error));
}

TEST_CASE("the exact separatrix is the Gudermannian", "[free_pendulum][motion][exact][ratchet]") {
  const double sign = GENERATE(1.0, -1.0);
  const FreeMotion motion({}, 0.0, 2.0 * sign);
  REQUIRE(motion.energy().kind == MotionKind::separatrix);
  const double tau = GENERATE(-3.0, 1e-9, 0.5, 4.0, 30.0, 800.0);
  const FreeState state = motion.at(tau);
  const Real truth = sign * 2 * atan(sinh(Real(tau)));
  CHECK(abs(Real(state.angle) - truth) <= Real(state.error));
  check_within("bound of an angle on the separatrix", state.error, 4e-15);
  check_close("velocity on the separatrix (relative)", state.velocity,
              sign * static_cast<double>(Real(2 / cosh(Real(tau)))), 8e-16);
}

TEST_CASE("rest at the bottom stays, and time runs backwards too",
          "[free_pendulum][motion][exact][ratchet]") {
  const FreeState rest = FreeMotion({3.0, 0.0}, 0.0, 0.0).at(1e10);
  CHECK(rest.angle == 0.0);
  CHECK(rest.velocity == 0.0);
  CHECK(rest.error < 1e-320);
  const FreeState later = FreeMotion({}, 1.0, 0.2).at(5.0);
  const FreeState back = FreeMotion({}, later.angle, later.velocity).at(-5.0);
  check_close("angle of a free motion there and back (relative)", back.angle, 1.0, 8e-16);
  check_close("velocity of a free motion there and back (relative)", back.velocity, 0.2, 8e-16);
}

TEST_CASE("alpha scales time, with its rest", "[free_pendulum][motion][ratchet]") {
  const Eigenfrequency alpha{3.0, 3.0 * 0x1p-54};
  const double t = 1e9, velocity = 1.5;
  const FreeState state = FreeMotion(alpha, 1.0, velocity).at(t);
  const Real a = Real(alpha.value) + Real(alpha.rest);
  const State truth = exact::by_functions(Real(1), velocity / a, a * t);
  CHECK(abs(Real(state.angle) - truth.angle) <= Real(state.error));
  check_within("bound of a free motion at alpha t = 3e9", state.error, 1.5e-15);
  check_close("velocity of a free motion at alpha t = 3e9 (relative)", state.velocity,
              static_cast<double>(Real(truth.velocity * a)), 8e-16);
}

TEST_CASE("a free motion refuses misuse", "[free_pendulum][motion][error]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(FreeMotion({}, nan, 0.0), InvalidInput);
  CHECK_THROWS_AS(FreeMotion({}, 2e9, 0.0), InvalidInput);
  CHECK_THROWS_AS(FreeMotion({}, 0.0, nan), InvalidInput);
  CHECK_THROWS_AS(FreeMotion({0.0, 0.0}, 0.0, 0.0), InvalidInput);
  CHECK_THROWS_AS(FreeMotion({1.0, 1e-3}, 0.0, 0.0), InvalidInput);
  CHECK_THROWS_AS(FreeMotion({}, 1.0, 0.0).at(nan), InvalidInput);
}

TEST_CASE("a series has the states of the single calls, in the order of the times",
          "[free_pendulum][motion]") {
  const Eigenfrequency alpha{3.8, 0.0};
  const std::array<double, 4> times{5.0, 0.0, 1e8, 2.5};
  const FreeMotion single(alpha, 1.0, -0.3);
  const Motion series = free_motion(alpha, {1.0, -0.3}, times, 1e-13);
  REQUIRE(series.points.size() == times.size());
  CHECK(series.method == Method::exact);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(series.points[i].t == times[i]);
    CHECK(series.points[i].angle == single.at(times[i]).angle);
    CHECK(series.points[i].velocity == single.at(times[i]).velocity);
    CHECK(series.points[i].energy == single.energy().separatrix_excess);
    CHECK(series.points[i].outcome == Outcome::converged);
  }
  // 2 alpha is the separatrix, but not if alpha has a rest: that is told from it only for a while.
  const Eigenfrequency shifted{1.0, 1e-40};
  const Motion late = free_motion(shifted, {0.0, 2.0}, std::array{1.0, 1e3});
  CHECK(late.points[0].outcome == Outcome::converged);
  CHECK(late.points[1].outcome == Outcome::tolerance_not_reached);
  std::atomic<bool> stop{true};
  CHECK(free_motion(alpha, {}, times, 1e-9, &stop).cancelled);
  CHECK_THROWS_AS(free_motion(alpha, {}, std::array{-1.0}), InvalidInput);
  CHECK_THROWS_AS(free_motion(alpha, {}, times, 0.0), InvalidInput);
}

TEST_CASE("the closed form and the integrator give one motion", "[free_pendulum][motion][referee][ratchet]") {
  const PendulumTable table{.length = 1.0};
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 1.0);
  const MotionStart start = GENERATE(MotionStart{1.0, 0.5}, MotionStart{3.0, 0.0}, MotionStart{-1.0, 12.0});
  const std::array<double, 2> times{3.0, 20.0};
  const Motion closed = free_motion(eigenfrequency(table), start, times);
  const Motion integrated = integrate_motion(rod, nullptr, nullptr, start, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(std::abs(closed.points[i].angle - integrated.points[i].angle) <=
          closed.points[i].error + integrated.points[i].error);
    check_within("bound of a free motion over 20 s", closed.points[i].error, 8e-14);
  }
}

}  // namespace strutt::test::free_motion_test
