#include "strutt/integrate/hill_family.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "strutt/base/error.hpp"

namespace strutt::test {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<PeriodicFunction> two_cosines() {
  return {PeriodicFunction::fourier(0.0, {{1, 1.0, 0.0}}), PeriodicFunction::fourier(0.0, {{3, 1.0, 0.0}})};
}

/// Numbers of very different sizes, so that many plans occur.
std::vector<double> numbers(std::size_t count, double largest, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(-4.0, std::log10(largest));
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back((i % 2 ? 1.0 : -1.0) * std::pow(10.0, exponent(random)));
  return result;
}

}  // namespace

TEST_CASE("every lane comes once, with the steps planned for it", "[integrate][family][simd]") {
  const std::size_t lanes = 5000;
  const auto mean = numbers(lanes, 300.0, 1), first = numbers(lanes, 100.0, 2), third = numbers(lanes, 10.0, 3);
  HillFamily family(two_cosines(), 0.0, kPi, 1e-9);
  const HillStepPlanner planner(3, kPi, 1e-9);
  std::vector<int> seen(lanes, 0);
  std::size_t groups = 0;
  family.propagate({mean, {first, third}}, true, [&](const HillGroup& group) {
    ++groups;
    for (std::size_t l = 0; l < group.lanes.size(); ++l) {
      const std::size_t lane = group.lanes[l];
      ++seen[lane];
      const double bound = std::abs(mean[lane]) + std::abs(first[lane]) + std::abs(third[lane]);
      CHECK(planner.plan(bound).steps == group.plan.steps);
      CHECK(group.batch.mean[l] == mean[lane]);
      CHECK(group.batch.weights[1][l] == third[lane]);
    }
    HillPropagators own;
    const auto basis = two_cosines();
    HillPropagator(group.plan, basis, 0.0, kPi).propagate(group.batch, own);
    CHECK(own.u1 == group.result.u1);
    HillPropagator({group.plan.order, group.plan.steps / 2}, basis, 0.0, kPi).propagate(group.batch, own);
    CHECK(own.du2 == group.check.du2);
  });
  CHECK(groups > 10);
  CHECK(std::ranges::all_of(seen, [](int times) { return times == 1; }));
}

TEST_CASE("the cheapest plan serves every size, and larger ones take more steps", "[integrate][family]") {
  for (const double tolerance : {1e-3, 1e-9, 1e-13}) {
    const HillStepPlanner planner(1, kPi, tolerance);
    long work = 0;
    for (double bound = 1e-3; bound < 1e5; bound *= 1.3) {
      const auto plan = planner.plan(bound);
      REQUIRE(plan.steps > 0);
      const long now = plan.steps * (plan.order == 4 ? 6L : 11L);
      CHECK(now >= work);
      work = now;
    }
  }
}

TEST_CASE("lanes that need too many steps come without a result", "[integrate][family][extreme]") {
  const std::vector<double> mean{1.0, 1e20, 2.0}, none(3, 0.0);
  HillFamily family(two_cosines(), 0.0, kPi, 1e-9);
  std::size_t without = 0;
  family.propagate({mean, {none, none}}, false, [&](const HillGroup& group) {
    if (group.full != nullptr) return;
    ++without;
    CHECK(group.plan.steps == 0);
    CHECK(group.lanes.size() == 1);
    CHECK(group.lanes[0] == 1);
  });
  CHECK(without == 1);
}

TEST_CASE("misuse of a family is refused", "[integrate][family][error]") {
  CHECK_THROWS_AS(HillFamily(two_cosines(), 1.0, 1.0, 1e-9), InvalidInput);
  CHECK_THROWS_AS(HillFamily(two_cosines(), 0.0, kPi, 0.0), InvalidInput);
  HillFamily family(two_cosines(), 0.0, kPi, 1e-9);
  const std::vector<double> one{1.0};
  CHECK_THROWS_AS(family.propagate({one, {one}}, false, [](const HillGroup&) {}), InvalidInput);
}

}  // namespace strutt::test
