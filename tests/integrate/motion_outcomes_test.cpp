// Motions without a result: outcomes, and what is refused.
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "strutt/base/error.hpp"
#include "strutt/integrate/motion.hpp"

namespace strutt::test::motion_outcomes_test {

namespace {

const PhysicalPendulum kRod = PhysicalPendulum::uniform_rod(1.0, 1.0);

}  // namespace

TEST_CASE("motions that cannot be computed end as outcomes", "[integrate][motion]") {
  const auto wild = sinusoidal_support(0.3, 7.0);
  const auto chaos = integrate_motion(kRod, &wild, nullptr, {2.5, 1.0}, std::array{300.0}, {});
  CHECK(chaos.points[0].outcome == Outcome::tolerance_not_reached);
  CHECK(chaos.points[0].error > 1e-9);
  CHECK(std::isfinite(chaos.points[0].angle));

  const auto late =
      integrate_motion(kRod, nullptr, nullptr, {1.0, 0.0}, std::array{1.0, 1e12}, {.max_steps = 20000});
  CHECK(late.points[0].outcome == Outcome::converged);
  CHECK(late.points[1].outcome == Outcome::step_limit);
  CHECK(std::isnan(late.points[1].angle));
  CHECK(late.points[1].error == std::numeric_limits<double>::infinity());

  // What no number of steps within the limit can reach is not even begun.
  for (const double t : {1e12, 1e300, 1e308}) {
    const auto never = integrate_motion(kRod, &wild, nullptr, {0.1, 0.0}, std::array{0.1, t}, {});
    CHECK(never.points[0].outcome == Outcome::converged);
    CHECK(never.points[1].outcome == Outcome::step_limit);
    CHECK(never.cost.steps < 1000);
  }

  const std::atomic<bool> cancel{true};
  const auto stopped =
      integrate_motion(kRod, nullptr, nullptr, {1.0, 0.0}, std::array{1.0}, {.cancel = &cancel});
  CHECK(stopped.cancelled);
  CHECK(stopped.points[0].outcome == Outcome::cancelled);

  const auto fallen = integrate_motion(kRod, nullptr, nullptr, {3.0, 0.0}, std::array{300.0},
                                       {.linear = true, .about = Equilibrium::inverted});
  CHECK(fallen.points[0].outcome != Outcome::converged);
}

TEST_CASE("misuse of a motion throws", "[integrate][motion]") {
  const auto run = [](const MotionStart& start, double t, const MotionOptions& options) {
    return integrate_motion(kRod, nullptr, nullptr, start, std::array{t}, options);
  };
  CHECK_THROWS_AS(run({NAN, 0.0}, 1.0, {}), InvalidInput);
  CHECK_THROWS_AS(run({0.0, INFINITY}, 1.0, {}), InvalidInput);
  CHECK_THROWS_AS(run({0.0, 0.0}, -1.0, {}), InvalidInput);
  CHECK_THROWS_AS(run({0.0, 0.0}, 1.0, {.tolerance = 1e-14}), InvalidInput);
  CHECK_THROWS_AS(run({0.0, 0.0}, 1.0, {.method = strutt::Method::exact}), InvalidInput);
  const auto support = sinusoidal_support(0.1, 3.0);
  const auto moment = sinusoidal_support(0.1, 4.0);
  CHECK_THROWS_AS(integrate_motion(kRod, &support, &moment, {}, std::array{1.0}, {}), InvalidInput);
}

}  // namespace strutt::test::motion_outcomes_test
