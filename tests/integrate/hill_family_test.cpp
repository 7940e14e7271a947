#include "strutt/integrate/hill_family.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::hill_family_test {
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
  for (std::size_t i = 0; i < count; ++i)
    result.push_back((i % 2 ? 1.0 : -1.0) * std::pow(10.0, exponent(random)));
  return result;
}

}  // namespace

TEST_CASE("every lane comes once, by a plan of its own", "[integrate][family][simd]") {
  const std::size_t lanes = 5000;
  const auto mean = numbers(lanes, 300.0, 1), first = numbers(lanes, 100.0, 2),
             third = numbers(lanes, 10.0, 3);
  HillFamily family(two_cosines(), 0.0, kPi, 1e-9);
  std::vector<int> seen(lanes, 0);
  std::size_t groups = 0;
  family.propagate({mean, {first, third}}, [&](const HillGroup& group) {
    ++groups;
    for (std::size_t l = 0; l < group.lanes.size(); ++l) {
      const std::size_t lane = group.lanes[l];
      ++seen[lane];
      CHECK(group.batch.mean[l] == mean[lane]);
      CHECK(group.batch.weights[1][l] == third[lane]);
    }
    HillPropagators own;
    HillSeries(group.plan, two_cosines(), 0.0, kPi).propagate(group.batch, group.tails, own);
    CHECK(own.u1 == group.result.u1);
    CHECK(own.du2_error == group.result.du2_error);
  });
  CHECK(groups > 10);
  CHECK(std::ranges::all_of(seen, [](int times) { return times == 1; }));
  for (std::size_t lane = 0; lane < lanes; lane += 500) {
    family.propagate({std::span(mean).subspan(lane, 1),
                      {std::span(first).subspan(lane, 1), std::span(third).subspan(lane, 1)}},
                     [&](const HillGroup& alone) {
                       const auto plan = alone.plan;
                       const double u1 = alone.result.u1[0];
                       HillPropagators own;
                       HillSeries(plan, two_cosines(), 0.0, kPi).propagate(alone.batch, alone.tails, own);
                       CHECK(own.u1[0] == u1);
                     });
  }
}

TEST_CASE("the tolerance of a family is kept, and larger equations take more work",
          "[integrate][family][simd][ratchet]") {
  for (const double tolerance : {1e-3, 1e-9, 1e-13}) {
    HillFamily family(two_cosines(), 0.0, kPi, tolerance);
    long least = 0;
    for (double size = 1e-3; size < 1e5; size *= 1.7) {
      const std::vector<double> mean{size}, weight{0.1 * size};
      family.propagate({mean, {weight, weight}}, [&](const HillGroup& group) {
        REQUIRE(group.plan.steps > 0);
        const long work = (group.plan.steps + 1L) * (group.plan.terms * group.plan.terms + 200L);
        CHECK(static_cast<double>(work) >= 0.7 * static_cast<double>(least));
        least = std::max(least, work);
        const auto& r = group.result;
        const double largest = std::max(std::abs(r.u1[0]), std::abs(r.du2[0]));
        check_within("bound of a family's propagator over max(2 tolerance; 2e-12 sqrt(1 + w))",
                     r.u1_error[0] / (largest * std::max(2.0 * tolerance, 2e-12 * std::sqrt(1.0 + size))),
                     0.3);
      });
    }
  }
}

TEST_CASE("lanes that need too many steps come without a result", "[integrate][family][extreme]") {
  const std::vector<double> mean{1.0, 1e20, std::nan("")}, none(3, 0.0);
  HillFamily family(two_cosines(), 0.0, kPi, 1e-9);
  std::vector<std::uint32_t> without;
  family.propagate({mean, {none, none}}, [&](const HillGroup& group) {
    if (group.plan.steps == 0) without.assign(group.lanes.begin(), group.lanes.end());
  });
  CHECK(without == std::vector<std::uint32_t>{1, 2});
}

TEST_CASE("misuse of a family is refused", "[integrate][family][error]") {
  CHECK_THROWS_AS(HillFamily(two_cosines(), 1.0, 1.0, 1e-9), InvalidInput);
  CHECK_THROWS_AS(HillFamily(two_cosines(), 0.0, kPi, 0.0), InvalidInput);
  HillFamily family(two_cosines(), 0.0, kPi, 1e-9);
  const std::vector<double> one{1.0};
  CHECK_THROWS_AS(family.propagate({one, {one}}, [](const HillGroup&) {}), InvalidInput);
}

}  // namespace strutt::test::hill_family_test
