#include "strutt/integrate/taylor_propagator.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "strutt/base/error.hpp"
#include "support/random_systems.hpp"
#include "support/ratchet.hpp"
#include "support/system_series.hpp"

namespace strutt::test::taylor_propagator_test {

using Eigen::MatrixXd;
using reference::LongMatrix;

namespace {

constexpr double kPi = std::numbers::pi;

/// Over a period with the identity as mass: canonical already.
LinearPeriodicSystem system_of(const PeriodicMatrix& stiffness, const PeriodicMatrix& damping = {}) {
  const auto d = stiffness.mean.rows();
  return {2.0 * kPi, MatrixXd::Identity(d, d), damping, stiffness};
}

LinearPeriodicSystem canonical(LinearPeriodicSystem system) {
  system.mass.setIdentity();
  return system;
}

BoundedMatrix propagated(const LinearPeriodicSystem& system, const TaylorStepPlan& plan,
                         bool with_truncation = true) {
  return TaylorPropagator({system.damping, system.stiffness}, plan, 2)
      .propagate(0, plan.steps, with_truncation);
}

TaylorStepPlan planned(const LinearPeriodicSystem& system, double tolerance) {
  return plan_taylor_steps({system.damping, system.stiffness}, 2, tolerance);
}

LongMatrix long_value(const ScaledMatrix& m) {
  return m.mantissa.cast<long double>() * std::pow(2.0L, static_cast<long double>(m.exponent));
}

LongMatrix truth(const LinearPeriodicSystem& system) {
  double rate = std::sqrt(system.stiffness.bound()) + system.damping.bound();
  for (const auto& h : system.stiffness.harmonics) rate = std::max(rate, 2.0 * h.order);
  return reference::system_matrix(system, 20 + static_cast<int>(8.0 * rate));
}

/// Largest error of an entry, relative to the largest entry.
double relative_error(const BoundedMatrix& m, const LongMatrix& exact) {
  return static_cast<double>((long_value(m.value) - exact).cwiseAbs().maxCoeff() /
                             exact.cwiseAbs().maxCoeff());
}

double relative_bound(const BoundedMatrix& m) {
  return m.error.maxCoeff() / m.value.mantissa.cwiseAbs().maxCoeff();
}

const PeriodicMatrix kPendulums{MatrixXd{{1.3, -0.3}, {-0.3, 2.3}},
                                {{1, MatrixXd{{0.4, 0.1}, {0.0, -0.3}}, {}}}};
const PeriodicMatrix kGyroscopic{MatrixXd{{0.05, -1.2}, {1.2, 0.1}}, {}};
const PeriodicMatrix kPeriodic{MatrixXd{{0.3, 0.1}, {0.1, 0.2}},
                               {{2, MatrixXd{{0.4, 0.1}, {-0.2, 0.3}}, MatrixXd{{0.0, 0.3}, {0.1, 0.0}}}}};

}  // namespace

TEST_CASE("halving the step of the series divides the error by 2^order",
          "[integrate][taylor][order][ratchet]") {
  for (const int order : {6, 8, 10}) {
    const int steps = 26 - order;
    double coarse = 0.0, fine = 0.0;
    for (const auto& damping : {PeriodicMatrix{}, kGyroscopic, kPeriodic}) {
      const auto system = system_of(kPendulums, damping);
      const auto exact = truth(system);
      coarse += relative_error(propagated(system, {order, steps}), exact);
      fine += relative_error(propagated(system, {order, 2 * steps}), exact);
    }
    check_within("order of the Taylor series of a system: measured against expected",
                 std::abs(std::log2(coarse / fine) - order), 0.25);
  }
}

TEST_CASE("the bound of the series is above the true error on random systems",
          "[integrate][taylor][random][ratchet][slow]") {
  RandomSystems systems(21);
  double sharp = 0.0, count = 0.0, planned_well = 0.0;
  for (int i = 0; i < 160; ++i) {
    const auto system = canonical(systems.next());
    const auto exact = truth(system);
    for (const double tolerance : {1e-2, 1e-4, 1e-7, 1e-10, 1e-14}) {
      const auto plan = planned(system, tolerance);
      REQUIRE(plan.steps > 0);
      const auto found = propagated(system, plan);
      const double error = relative_error(found, exact), bound = relative_bound(found);
      INFO("system " << i << " tolerance " << tolerance << " order " << plan.order << " steps "
                     << plan.steps);
      // a margin, since no random sample is the worst
      check_within("true error of a system's propagator over its bound", error / bound, 0.6);
      sharp += bound <= 300.0 * std::max(error, 1e-15);
      planned_well += bound <= 25.0 * tolerance + 1e-13;
      ++count;
    }
  }
  CHECK(sharp >= 0.5 * count);
  CHECK(planned_well >= 0.95 * count);
}

TEST_CASE("without its truncation the bound is that of the rounding",
          "[integrate][taylor][random][ratchet][slow]") {
  RandomSystems systems(22);
  for (int i = 0; i < 80; ++i) {
    const auto system = canonical(systems.next());
    const auto plan = planned(system, 1e-16);
    const auto found = propagated(system, plan, false);
    const double bound = relative_bound(found);
    CHECK(relative_error(found, truth(system)) <= bound);
    check_within("bound of the rounding of a system's propagator over its steps", bound / plan.steps, 5e-14);
  }
}

TEST_CASE("constant coefficients turn without limit", "[integrate][taylor][extreme][ratchet]") {
  for (const double stiffness : {1e-9, 1.0234e4, 1.0234e6, 3.3e8}) {
    const auto system = system_of({stiffness * MatrixXd::Identity(2, 2), {}});
    const double tolerance = 1e-9;
    const auto found = propagated(system, planned(system, tolerance));
    const double scale = std::ldexp(1.0, static_cast<int>(found.value.exponent));
    const long double s = std::sqrt(static_cast<long double>(stiffness));
    const long double phase = 2.0L * std::numbers::pi_v<long double> * s;
    INFO("stiffness " << stiffness);
    for (const int i : {0, 1, 2, 3}) {
      CHECK(std::abs(found.value.mantissa(i, i) * scale - static_cast<double>(std::cos(phase))) <=
            found.error(i, i) * scale);
      check_within("bound of a propagator of constant coefficients at tolerance 1e-9",
                   found.error(i, i) * scale, 5e-9);
    }
    CHECK(std::abs(found.value.mantissa(2, 0) * scale / s + std::sin(phase)) <=
          found.error(2, 0) * scale / s);
    CHECK(found.value.mantissa(1, 0) == 0.0);
  }
}

TEST_CASE("constant coefficients grow without limit, in log form", "[integrate][taylor][extreme][ratchet]") {
  for (const double stiffness : {-25.0, -1e4, -1e6, -1e8}) {
    const auto system = system_of({stiffness * MatrixXd::Identity(2, 2), {}});
    const auto found = propagated(system, planned(system, 1e-9));
    const auto& m = found.value;
    const long double phase =
        2.0L * std::numbers::pi_v<long double> * std::sqrt(std::abs(static_cast<long double>(stiffness)));
    const long double log_found = std::log(static_cast<long double>(m.mantissa(0, 0))) +
                                  static_cast<long double>(m.exponent) * std::log(2.0L);
    INFO("stiffness " << stiffness);
    const double bound = found.error(0, 0) / m.mantissa(0, 0);
    CHECK(std::abs(log_found - (phase - std::log(2.0L))) <= bound);  // of cosh(phase)
    check_within("bound of a propagator that grows up to exp(62832) (relative)", bound, 5e-8);
  }
}

TEST_CASE("every size gives the same numbers", "[integrate][taylor][ratchet]") {
  // Two copies of a system of 2 side by side are one of 4, of which the compiler does not know the size.
  const auto doubled = [](const MatrixXd& m) {
    MatrixXd result = MatrixXd::Zero(4, 4);
    result.topLeftCorner(2, 2) = result.bottomRightCorner(2, 2) = m;
    return result;
  };
  const auto two = propagated(system_of(kPendulums), {14, 6});
  const auto four = propagated(
      system_of({doubled(kPendulums.mean), {{1, doubled(kPendulums.harmonics[0].cosine), {}}}}), {14, 6});
  const LongMatrix a = long_value(two.value), b = long_value(four.value);
  const auto largest = [](const LongMatrix& m) { return static_cast<double>(m.cwiseAbs().maxCoeff()); };
  check_within("propagator of a system as a part of a larger one",
               largest(a.topLeftCorner(2, 2) - b.topLeftCorner(2, 2)), 1e-15);
  check_within("propagator of a system as a part of a larger one",
               largest(a.topRightCorner(2, 2) - b.block(2, 6, 2, 2)), 1e-15);
  CHECK(b.block(0, 2, 2, 2).cwiseAbs().maxCoeff() == 0.0L);
}

TEST_CASE("plans get dearer with the tolerance and the equation, and say when it is too much",
          "[integrate][taylor][cost]") {
  const auto cost = [](const LinearPeriodicSystem& system, double tolerance) {
    const auto plan = planned(system, tolerance);
    return plan.steps * TaylorPropagator({system.damping, system.stiffness}, plan, 2).products_per_step();
  };
  const auto system = system_of(kPendulums);
  long before = 0;
  for (const double tolerance : {1e-2, 1e-5, 1e-8, 1e-11, 1e-14}) {
    CHECK(cost(system, tolerance) > before);
    before = cost(system, tolerance);
  }
  CHECK(before < 3000);  // products; arkode takes 2800 right-hand sides for 1e-12 (with their check)
  auto faster = system;
  faster.stiffness.mean *= 100.0;
  CHECK(cost(faster, 1e-8) > 3 * cost(system, 1e-8));
  auto waves = system;
  waves.stiffness.harmonics[0].order = 12;
  CHECK(cost(waves, 1e-8) > 2 * cost(system, 1e-8));
  for (const double far : {1e20, 1e300, std::numeric_limits<double>::infinity()}) {
    CHECK(planned(system_of({far * MatrixXd::Identity(2, 2), {}}), 1e-8).steps == 0);
  }
  // of a constant coefficient there is one product a term
  CHECK(TaylorPropagator({{}, {MatrixXd::Identity(2, 2), {}}}, {12, 3}, 2).products_per_step() == 12);
}

TEST_CASE("half a period is the first half of the steps", "[integrate][taylor][ratchet]") {
  const auto system = system_of(kPendulums, kPeriodic);
  const TaylorEquation equation{system.damping, system.stiffness};
  const auto whole = TaylorPropagator(equation, {16, 12}, 2).propagate(0, 6);
  const auto half = TaylorPropagator(equation, {16, 6}, 1).propagate(0, 6);
  check_within("propagator over half a period against the first half of that over a period",
               static_cast<double>((long_value(whole.value) - long_value(half.value)).cwiseAbs().maxCoeff()),
               8e-16);
}

TEST_CASE("misuse of the Taylor propagator is refused", "[integrate][taylor][error]") {
  const auto system = system_of(kPendulums);
  const TaylorEquation equation{system.damping, system.stiffness};
  for (const int order : {4, 7, 24}) CHECK_THROWS_AS(TaylorPropagator(equation, {order, 4}, 2), InvalidInput);
  CHECK_THROWS_AS(TaylorPropagator(equation, {8, 0}, 2), InvalidInput);
  CHECK_THROWS_AS(TaylorPropagator(equation, {8, 4}, 3), InvalidInput);
  TaylorPropagator propagator(equation, {8, 4}, 2);
  CHECK_THROWS_AS(propagator.propagate(2, 2), InvalidInput);
  CHECK_THROWS_AS(propagator.propagate(-1, 2), InvalidInput);
  CHECK_THROWS_AS(propagator.propagate(0, 5), InvalidInput);
}

}  // namespace strutt::test::taylor_propagator_test
