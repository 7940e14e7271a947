#include "strutt/floquet/hill_discriminants.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "strutt/base/error.hpp"
#include "support/hill_series.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::hill_discriminants_test {
namespace {

struct Points {
  std::vector<double> delta, epsilon, value, error;

  std::size_t size() const { return delta.size(); }

  void add(double d, double e) {
    delta.push_back(d);
    epsilon.push_back(e);
  }

  void compute(double tolerance, int order = 1) {
    value.resize(size());
    error.resize(size());
    HillDiscriminants({order}, tolerance).compute({delta, {epsilon}}, value, error);
  }
};

Points scattered(std::size_t count, double low, double high, double largest_epsilon, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> delta(low, high), epsilon(0.0, largest_epsilon);
  Points result;
  for (std::size_t i = 0; i < count; ++i) {
    const double d = delta(random);
    result.add(d, epsilon(random));
  }
  return result;
}

/// |value - D|/max(1, largest |entry|) against long double.
double true_error(const Points& p, std::size_t l, int order) {
  const auto m =
      reference::hill_matrix(PeriodicFunction::fourier(p.delta[l], {{order, p.epsilon[l], 0.0}}), 512);
  const long double kappa = std::max(1.0, std::sqrt(std::abs(p.delta[l])));
  const long double size = std::max(
      {1.0L, std::abs(m[0][0]), std::abs(kappa * m[0][1]), std::abs(m[1][0] / kappa), std::abs(m[1][1])});
  return static_cast<double>(std::abs(p.value[l] - (m[0][0] + m[1][1])) / size);
}

struct Box {
  double low, high, epsilon;
  int order;
};

}  // namespace

TEST_CASE("the error of a discriminant is below its bound and the tolerance",
          "[floquet][discriminants][simd][ratchet]") {
  const auto box =
      GENERATE(values<Box>({{-1, 5, 6, 1}, {-50, 200, 200, 1}, {0, 5, 5, 7}, {-1e-3, 1e-3, 1e-3, 1}}));
  const double tolerance = GENERATE(1e-3, 1e-7, 1e-9, 1e-12);
  CAPTURE(box.high, box.order, tolerance);
  Points points = scattered(60, box.low, box.high, box.epsilon, 11);
  points.add(box.high, 0.0);
  points.add(0.0, box.epsilon);
  points.compute(tolerance, box.order);
  std::size_t close = 0;
  for (std::size_t l = 0; l < points.size(); ++l) {
    CAPTURE(points.delta[l], points.epsilon[l]);
    const double error = true_error(points, l, box.order);
    CHECK(error <= points.error[l]);
    if (error > 0.0) check_within("true error of D in a batch over its bound", error / points.error[l], 1.0);
    if (tolerance > 1e-11 || box.high <= 5.0) CHECK(points.error[l] <= tolerance);  // else rounding is left
    close += points.error[l] <= 3000.0 * std::max(error, 1e-15);
  }
  // the bound holds for all signs of the terms; elsewhere the errors of the steps cancel in the trace, too
  if (box.epsilon == 6.0) CHECK(2 * close >= points.size());
}

TEST_CASE("the discriminant of reference is met", "[floquet][discriminants][ratchet]") {
  Points points;
  points.add(1.0, 0.5);
  points.compute(1e-12);
  check_within("D of a batch at (1 0.5) at tolerance 1e-12",
               std::abs(points.value[0] - 2.021314397416841636175261), 1.5e-15);
}

TEST_CASE("more harmonics than there are columns of classes", "[floquet][discriminants][simd]") {
  std::vector<int> orders;
  for (int k = 1; k <= 15; ++k) orders.push_back(k);
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  constexpr std::size_t lanes = 20;
  std::vector<double> mean(lanes), value(lanes), error(lanes);
  std::vector<std::vector<double>> weights(orders.size(), std::vector<double>(lanes));
  for (auto& x : mean) x = 2.0 + 2.0 * number(random);
  for (std::size_t f = 0; f < weights.size(); ++f)
    for (auto& x : weights[f]) x = 3.0 * number(random) / orders[f];
  const double tolerance = GENERATE(1e-6, 1e-11);
  HillDiscriminants(orders, tolerance).compute({mean, {weights.begin(), weights.end()}}, value, error);
  for (std::size_t l = 0; l < lanes; ++l) {
    std::vector<Harmonic> harmonics;
    for (std::size_t f = 0; f < weights.size(); ++f) harmonics.push_back({orders[f], weights[f][l], 0.0});
    const auto m = reference::hill_matrix(PeriodicFunction::fourier(mean[l], harmonics), 512);
    const long double kappa = std::max(1.0, std::sqrt(std::abs(mean[l])));
    const long double size = std::max(
        {1.0L, std::abs(m[0][0]), std::abs(kappa * m[0][1]), std::abs(m[1][0] / kappa), std::abs(m[1][1])});
    CHECK(std::abs(value[l] - (m[0][0] + m[1][1])) <= error[l] * size);
    CHECK(error[l] <= tolerance);
  }
}

TEST_CASE("a point has the same bits whatever stands beside it",
          "[floquet][discriminants][simd][N46][extreme]") {
  Points all = scattered(5000, -5.0, 50.0, 40.0, 3);
  all.compute(1e-9);
  for (std::size_t l = 0; l < all.size(); l += 97) {
    Points one;
    one.add(all.delta[l], all.epsilon[l]);
    one.compute(1e-9);
    CHECK(one.value[0] == all.value[l]);
    CHECK(one.error[0] == all.error[l]);
  }
}

TEST_CASE("extremes have a bound or no value", "[floquet][discriminants][extreme][N01]") {
  Points points;
  points.add(1e4, 10.0);
  points.add(1.0, 1000.0);
  points.add(-50.0, 0.0);
  const std::size_t known = points.size();
  points.add(-1e6, 1.0);
  points.add(1e300, 1.0);
  points.add(std::nan(""), 1.0);
  points.compute(1e-9);
  for (std::size_t l = 0; l < known; ++l) CHECK(true_error(points, l, 1) <= points.error[l]);
  CHECK(points.value[known] == std::numeric_limits<double>::infinity());  // cosh(2000 pi)
  CHECK(std::isinf(points.error[known + 1]));
  CHECK(std::isinf(points.error[known + 2]));
}

TEST_CASE("misuse of discriminants is refused", "[floquet][discriminants][error]") {
  CHECK_THROWS_AS(HillDiscriminants({0}, 1e-9), InvalidInput);
  CHECK_THROWS_AS(HillDiscriminants({1, 1}, 1e-9), InvalidInput);
  CHECK_THROWS_AS(HillDiscriminants({1}, 1e-14), InvalidInput);
  HillDiscriminants discriminants({1}, 1e-9);
  const std::vector<double> two{1.0, 2.0}, one{1.0};
  std::vector<double> value(2), error(2);
  CHECK_THROWS_AS(discriminants.compute({two, {one}}, value, error), InvalidInput);
  CHECK_THROWS_AS(discriminants.compute({two, {}}, value, error), InvalidInput);
  CHECK_THROWS_AS(discriminants.compute({one, {one}}, value, error), InvalidInput);
}

}  // namespace strutt::test::hill_discriminants_test
