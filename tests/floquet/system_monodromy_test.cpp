// The monodromy matrix of systems by Taylor series and by SUNDIALS: bounds against the truth, the route over
// half a period, which method runs, and the cost.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/random_systems.hpp"
#include "support/ratchet.hpp"
#include "support/system_series.hpp"

namespace strutt::test::system_monodromy_test {

using Eigen::MatrixXd;
using reference::LongMatrix;

namespace {

/// |computed - true| of the trace and of the entries, as MonodromyOptions::tolerance means it.
double true_error(const Monodromy& m, const LongMatrix& exact) {
  const LongMatrix value = m.matrix.value.mantissa.cast<long double>() *
                           std::pow(2.0L, static_cast<long double>(m.matrix.value.exponent));
  const LongMatrix distance = (value - exact).cwiseAbs();
  const long double error = std::max(distance.maxCoeff(), std::abs((value - exact).trace()));
  return static_cast<double>(error / std::max(1.0L, exact.cwiseAbs().maxCoeff()));
}

LongMatrix truth(const LinearPeriodicSystem& system) {
  const MatrixXd inverse = system.mass.inverse();
  const double size = inverse.cwiseAbs().rowwise().sum().maxCoeff(),
               unit = system.period / (2.0 * std::numbers::pi);
  double rate = unit * (std::sqrt(size * system.stiffness.bound()) + size * system.damping.bound());
  for (const auto& h : system.stiffness.harmonics) rate = std::max(rate, 2.0 * h.order);
  return reference::system_matrix(system, 20 + static_cast<int>(8.0 * rate));
}

LinearPeriodicSystem pendulums() {
  LinearPeriodicSystem system;
  system.period = 3.0;
  system.mass = MatrixXd{{1.0, 0.2}, {0.2, 1.5}};
  system.stiffness = {
      MatrixXd{{1.3, -0.3}, {-0.3, 2.3}},
      {{1, MatrixXd{{0.4, 0.1}, {0.1, -0.2}}, {}}, {3, MatrixXd{{0.0, 0.2}, {0.2, 0.3}}, {}}}};
  return system;
}

}  // namespace

TEST_CASE("The bound of systems is above the true error, and within the tolerance",
          "[floquet][random][ratchet][slow]") {
  MonodromyEngine engine;
  RandomSystems systems(31);
  int converged = 0, count = 0;
  for (int i = 0; i < 120; ++i) {
    const auto system = systems.next();
    const auto exact = truth(system);
    for (const double tolerance : {1e-2, 1e-5, 1e-8, 1e-11, 1e-13}) {
      const auto m = engine.compute(system, {.tolerance = tolerance, .method = Method::propagator});
      INFO("system " << i << " tolerance " << tolerance);
      check_within("true error of M of a system over its bound", true_error(m, exact) / m.error, 1.0);
      CHECK((m.outcome != Outcome::converged || m.error <= tolerance));
      if (tolerance >= 1e-11) ++count, converged += m.outcome == Outcome::converged;
    }
  }
  CHECK(converged >= 98 * count / 100);
}

TEST_CASE("The bound holds for a mass matrix that is hard to invert", "[floquet][extreme][slow]") {
  MonodromyEngine engine;
  for (const double nearness : {1e-3, 1e-6, 1e-8}) {
    auto system = pendulums();
    system.mass = MatrixXd{{1.0, 1.0 - nearness}, {1.0 - nearness, 1.0}};
    system.stiffness.mean =
        MatrixXd{{1.0, 1.0 - 0.7 * nearness}, {1.0 - 0.7 * nearness, 1.1}} * (0.01 + nearness);
    system.stiffness.harmonics[0].cosine *= 0.1 * nearness;
    system.stiffness.harmonics[1].cosine *= 0.1 * nearness;
    const auto exact = truth(system);
    for (const auto method : {Method::propagator, Method::arkode}) {
      const auto m = engine.compute(system, {.tolerance = 1e-9, .method = method});
      INFO("nearness " << nearness << " " << to_string(method));
      CHECK(true_error(m, exact) <= m.error);
    }
  }
}

TEST_CASE("Half a period of a symmetric even system gives the whole", "[floquet][law]") {
  MonodromyEngine engine;
  for (const double c : {0.0, 0.3}) {
    auto even = pendulums();
    if (c > 0.0) even.damping.mean = c * even.mass;
    auto broken = even;  // the same but for a sine of 1e-13
    broken.stiffness.harmonics[0].sine = 1e-13 * even.mass;
    for (const double tolerance : {1e-6, 1e-11}) {
      const MonodromyOptions options{.tolerance = tolerance, .method = Method::propagator};
      const auto half = engine.compute(even, options), whole = engine.compute(broken, options);
      CHECK(true_error(half, truth(even)) <= half.error);
      CHECK(true_error(whole, truth(broken)) <= whole.error);
      CHECK(3 * half.cost.right_hand_sides <= 2 * whole.cost.right_hand_sides);
    }
  }
}

TEST_CASE("Systems begin with the propagator, and SUNDIALS is behind it", "[floquet][cost][ratchet]") {
  MonodromyEngine engine;
  const auto system = pendulums();
  CHECK(method_for(system, Method::automatic) == Method::propagator);
  CHECK(method_for(system, Method::propagator) == Method::propagator);
  CHECK_THROWS_AS(method_for(system, Method::exact), InvalidInput);
  CHECK_THROWS_AS(method_for(system, Method::fourier), InvalidInput);

  const auto m = engine.compute(system, {.tolerance = 1e-9});
  CHECK(m.method == Method::propagator);
  CHECK(m.estimate_cost.right_hand_sides == 0);  // the bound comes with the series
  const auto by_arkode = engine.compute(system, {.tolerance = 1e-9, .method = Method::arkode});
  CHECK(2 * m.cost.right_hand_sides <
        by_arkode.cost.right_hand_sides + by_arkode.estimate_cost.right_hand_sides);
  const auto plain = engine.compute(system, {.tolerance = 1e-9, .estimate_error = false});
  check_within("error of M of a system by a Taylor series at tolerance 1e-9",
               true_error(plain, truth(system)), 1.2e-12);
  check_within("rounding of M of a system by a Taylor series", plain.error, 3e-13);  // of the rounding alone

  // A phase of 1e4 radians is beyond 1e-13: rounding is what is left, and SUNDIALS is not asked.
  auto far = system;
  far.stiffness.mean *= 3e6;
  const auto both = engine.compute(far, {.tolerance = 1e-13});
  const auto alone = engine.compute(far, {.tolerance = 1e-13, .method = Method::propagator});
  CHECK(both.outcome == Outcome::tolerance_not_reached);
  CHECK(alone.outcome == Outcome::tolerance_not_reached);
  CHECK(both.method == Method::propagator);
  CHECK(both.cost.right_hand_sides == alone.cost.right_hand_sides);
}

TEST_CASE("A system that grows beyond double is right in log form", "[floquet][extreme][N01][ratchet]") {
  MonodromyEngine engine;
  auto system = pendulums();
  system.mass.setIdentity();
  system.stiffness.mean = MatrixXd{{-2.0e5, 0.0}, {0.0, -1.0e5}};  // growth exp(3 sqrt(2e5)) = exp(1342)
  const auto s = analyse(engine, system, {.tolerance = 1e-9});
  CHECK(s.method == Method::propagator);
  CHECK(s.outcome == Outcome::converged);
  CHECK(s.verdict == Verdict::unstable);
  check_close("N01 growth of a system up to exp(1342) against that of its mean (relative)", s.growth,
              3.0 * std::sqrt(2.0e5), 1.2e-12);  // the harmonics change it by 1e-6
  CHECK(s.log_scale > 1000.0);
  const auto by_arkode = analyse(engine, system, {.tolerance = 1e-7, .method = Method::arkode});
  check_within("N01 growth of a system up to exp(1342): Taylor series against ARKODE",
               std::abs(s.growth - by_arkode.growth), 1.5e-9);
}

TEST_CASE("A cancelled system has no result", "[floquet][error]") {
  MonodromyEngine engine;
  const std::atomic<bool> cancel = true;
  for (const auto method : {Method::automatic, Method::propagator, Method::arkode}) {
    const auto m = engine.compute(pendulums(), {.method = method, .cancel = &cancel});
    CHECK(m.outcome == Outcome::cancelled);
    CHECK(std::isinf(m.error));
  }
}

}  // namespace strutt::test::system_monodromy_test
