#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "integrate/methods.hpp"
#include "strutt/base/error.hpp"
#include "strutt/integrate/integrator.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::trajectory_test {

using Eigen::VectorXd;

namespace {

void piecewise_oscillator(double t, double, StateView y, StateOut dydt) { oscillator(t, y, dydt); }

VectorXd exact(double t) { return vector({std::cos(t), -std::sin(t)}); }

std::vector<double> grid(double from, double to, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(from + (to - from) * i / count);
  return times;
}

}  // namespace

TEST_CASE("states in between are as accurate as those at the end", "[integrate][trajectory][ratchet]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    const double tolerance = method.order <= 3 ? 1e-6 : 1e-10;
    for (const double end : {20.0, -20.0}) {
      for (const int count : {7, 400}) {
        const std::vector<double> times = grid(0.0, end, count);
        Integrator integrator(2, options_of(method, tolerance));
        const Trajectory trajectory = integrator.trajectory(piecewise_oscillator, 0.0, exact(0.0), times);
        REQUIRE(trajectory.result.outcome == Outcome::converged);
        CHECK(trajectory.result.t == end);
        double worst = 0.0;
        for (int i = 0; i <= count; ++i)
          worst = std::max(worst, (trajectory.states.col(i) - exact(times[i])).norm());
        const double at_end = (trajectory.states.col(count) - exact(end)).norm();
        CHECK(worst < 3.0 * at_end + 20.0 * tolerance);
        check_within("states in between over the tolerance", worst / tolerance, 2000.0);
      }
    }
  }
}

TEST_CASE("times may repeat, be close, and begin late", "[integrate][trajectory][ratchet]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    const double next = std::nextafter(2.0, 3.0);
    const std::vector<double> times{0.0, 0.0, 1e-300, 1e-17, 2.0, 2.0, next, 2.0 + 1e-14, 2.0 + 1e-12, 3.0};
    Integrator integrator(2, options_of(method, 1e-6));
    const Trajectory trajectory = integrator.trajectory(piecewise_oscillator, 0.0, exact(0.0), times);
    REQUIRE(trajectory.result.outcome == Outcome::converged);
    for (std::size_t i = 0; i < times.size(); ++i)
      check_within("states at times that repeat or are close at tolerance 1e-6",
                   (trajectory.states.col(static_cast<Eigen::Index>(i)) - exact(times[i])).norm(), 5e-5);
    CHECK(same_bits(trajectory.states.col(0), exact(0.0)));
    CHECK(same_bits(trajectory.states.col(4), trajectory.states.col(5)));
  }
}

TEST_CASE("a jump is met exactly, from the right side on either side", "[integrate][trajectory][ratchet]") {
  // y' = 1 before 1, -2 up to 2.5, then 4: y = t, 1 - 2 (t - 1), -2 + 4 (t - 2.5).
  const std::vector<double> breakpoints{-3.0, 1.0, 2.5, 7.0};
  for (const Method& method : kMethods) {
    INFO(name(method));
    std::set<double> interiors;
    const auto f = [&interiors](double t, double interior, StateView, StateOut dydt) {
      interiors.insert(interior);
      CHECK((interior < 1.0 ? t <= 1.0 : interior < 2.5 ? t >= 1.0 && t <= 2.5 : t >= 2.5));
      dydt[0] = interior < 1.0 ? 1.0 : interior < 2.5 ? -2.0 : 4.0;
    };
    Integrator integrator(1, options_of(method, 1e-8));
    const std::vector<double> forward{0.5, 1.0, 1.5, 2.5, 3.0};
    const Trajectory there = integrator.trajectory(f, 0.0, vector({0.0}), forward, breakpoints);
    CHECK(there.result.outcome == Outcome::converged);
    check_within("trajectory with jumps of the right-hand side",
                 (there.states.transpose() - vector({0.5, 1.0, 0.0, -2.0, 0.0})).norm(), 2e-14);
    CHECK(interiors == std::set<double>{0.5, 1.75, 2.75});
    CHECK(there.result.cost.rejections == 0);

    const std::vector<double> backward{2.5, 1.0, 0.0};
    const Trajectory back = integrator.trajectory(f, 3.0, vector({0.0}), backward, breakpoints);
    check_within("trajectory with jumps of the right-hand side",
                 (back.states.transpose() - vector({-2.0, 1.0, 0.0})).norm(), 2e-14);
  }
}

TEST_CASE("a terminal event ends a trajectory, budgets span its pieces", "[integrate][trajectory][ratchet]") {
  const std::vector<double> times = grid(0.0, 4.0, 8);
  const std::vector<double> breakpoints{1.0, 2.0};
  const auto position = [](double, StateView y, StateOut g) { g[0] = y[0]; };
  const EventRequest request{position, {Crossing::both}};
  for (const Method& method : kMethods) {
    INFO(name(method));
    Integrator integrator(2, options_of(method, 1e-6));
    const Trajectory trajectory =
        integrator.trajectory(piecewise_oscillator, 0.0, exact(0.0), times, breakpoints, &request);
    CHECK(trajectory.result.outcome == Outcome::converged);
    check_within("time of an event on a trajectory at tolerance 1e-6",
                 std::abs(trajectory.result.t - M_PI / 2.0), 1.2e-5);
    for (int i = 0; i <= 8; ++i) CHECK(trajectory.states.col(i).allFinite() == (times[i] < M_PI / 2.0));

    IntegratorOptions few = options_of(method, 1e-6);
    few.max_steps = trajectory.result.cost.steps - 2;
    integrator.set_options(few);
    const Trajectory shorter =
        integrator.trajectory(piecewise_oscillator, 0.0, exact(0.0), times, breakpoints, &request);
    CHECK(shorter.result.outcome == Outcome::step_limit);
    CHECK(shorter.result.cost.steps == few.max_steps);
  }
}

TEST_CASE("odd trajectories", "[integrate][trajectory]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Integrator integrator(2, {});
  const auto run = [&](std::vector<double> times, std::vector<double> breakpoints = {}) {
    return integrator.trajectory(piecewise_oscillator, 0.0, exact(0.0), times, breakpoints);
  };
  CHECK(run({}).result.outcome == Outcome::converged);
  CHECK(run({}).states.cols() == 0);
  CHECK(same_bits(run({0.0}).states.col(0), exact(0.0)));
  CHECK(run({1.0, nan}).result.outcome == Outcome::non_finite);
  CHECK_THROWS_AS(run({1.0, 0.5}), InvalidInput);
  CHECK_THROWS_AS(run({-1.0, 0.5}), InvalidInput);
  CHECK_THROWS_AS(run({1.0}, {0.5, 0.25}), InvalidInput);
}

}  // namespace strutt::test::trajectory_test
