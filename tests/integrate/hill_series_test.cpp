#include "strutt/integrate/hill_series.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::hill_series_test {

using strutt::test::check_close;
using strutt::test::check_within;

namespace {

constexpr double kPi = std::numbers::pi;

struct Point {
  double delta, epsilon;
};

/// u1, u1', u2, u2' at pi of Y'' + (delta + epsilon cos(k theta)) Y = 0 by Taylor series of degree 22 in long
/// double.
std::array<long double, 4> taylor(Point p, int k, int steps) {
  constexpr int kDegree = 22;
  const long double h = std::numbers::pi_v<long double> / steps;
  std::array<long double, 4> y{1, 0, 0, 1};
  for (int step = 0; step < steps; ++step) {
    const long double c = std::cos(k * h * step), s = std::sin(k * h * step);
    const std::array<long double, 4> cycle{c, -s, -c, s};
    std::array<long double, kDegree> w{};
    long double factor = p.epsilon;
    for (int j = 0; j < kDegree; ++j) {
      w[static_cast<std::size_t>(j)] = factor * cycle[static_cast<std::size_t>(j % 4)];
      factor *= static_cast<long double>(k) / (j + 1);
    }
    w[0] += p.delta;
    for (std::size_t column : {0, 2}) {
      std::array<long double, kDegree + 1> a{y[column], y[column + 1]};
      for (std::size_t j = 0; j + 2 <= kDegree; ++j) {
        long double sum = 0;
        for (std::size_t i = 0; i <= j; ++i) sum += w[i] * a[j - i];
        a[j + 2] = -sum / static_cast<long double>((j + 1) * (j + 2));
      }
      long double value = 0, slope = 0;
      for (std::size_t j = kDegree + 1; j-- > 0;) value = value * h + a[j];
      for (std::size_t j = kDegree + 1; j-- > 1;) slope = slope * h + static_cast<long double>(j) * a[j];
      y[column] = value;
      y[column + 1] = slope;
    }
  }
  return y;
}

PeriodicFunction harmonic(double mean, double amplitude, int order) {
  return PeriodicFunction::fourier(mean, {{order, amplitude, 0.0}});
}

void propagate(const HillSeries& series, const HillBatch& batch, HillPropagators& result) {
  std::vector<double> tails, weights(batch.weights.size());
  for (std::size_t l = 0; l < batch.mean.size(); ++l) {
    for (std::size_t f = 0; f < weights.size(); ++f) weights[f] = batch.weights[f][l];
    tails.push_back(series.tail(batch.mean[l], weights));
  }
  series.propagate(batch, tails, result);
}

HillPropagators run(const HillSeriesPlan& plan, int order, const std::vector<Point>& points) {
  const std::vector<PeriodicFunction> basis{harmonic(0.0, 1.0, order)};
  std::vector<double> mean, weight;
  for (const auto& p : points) {
    mean.push_back(p.delta);
    weight.push_back(p.epsilon);
  }
  HillPropagators result;
  propagate(HillSeries(plan, basis, 0.0, kPi), {mean, {weight}}, result);
  return result;
}

/// Largest error of the entries in the state (Y, Y'/kappa), relative to the largest entry.
double error_of(const HillPropagators& r, std::size_t lane, const std::array<long double, 4>& truth,
                double kappa) {
  const std::array<long double, 4> scale{1.0L, 1.0L / kappa, kappa, 1.0L};
  const std::array<double, 4> value{r.u1[lane], r.du1[lane], r.u2[lane], r.du2[lane]};
  long double largest = 0, error = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    largest = std::max(largest, std::abs(truth[i] * scale[i]));
    error = std::max(
        error, std::abs((std::ldexp(static_cast<long double>(value[i]), static_cast<int>(r.exponent[lane])) -
                         truth[i]) *
                        scale[i]));
  }
  return static_cast<double>(error / largest);
}

double kappa_of(double delta) { return std::max(1.0, std::sqrt(std::abs(delta))); }

std::vector<Point> scattered(std::size_t count, Point low, Point high, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> delta(low.delta, high.delta), epsilon(low.epsilon, high.epsilon);
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({delta(random), epsilon(random)});
  return points;
}

/// Same bits? NaN never is.
bool same(const HillPropagators& a, std::size_t i, const HillPropagators& b, std::size_t j) {
  return a.u1[i] == b.u1[j] && a.du1[i] == b.du1[j] && a.u2[i] == b.u2[j] && a.du2[i] == b.du2[j] &&
         a.exponent[i] == b.exponent[j];
}

}  // namespace

TEST_CASE("halving the step divides the error by 2^(2 terms - 4)",
          "[integrate][series][order][simd][ratchet]") {
  const auto points = scattered(40, {-1.0, 0.0}, {5.0, 6.0}, 1);
  for (const int terms : {4, 5, 6, 8}) {
    const int steps = terms == 8 ? 6 : 24;
    double coarse = 0.0, fine = 0.0;
    const auto a = run({steps, terms}, 1, points), b = run({2 * steps, terms}, 1, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto truth = taylor(points[i], 1, 60);
      coarse += error_of(a, i, truth, kappa_of(points[i].delta));
      fine += error_of(b, i, truth, kappa_of(points[i].delta));
    }
    check_within("order of the series of Hill's equation: measured against expected",
                 std::abs(std::log2(coarse / fine) - (2 * terms - 4)), 0.3);
  }
}

TEST_CASE("every entry is within its bound, near and far from convergence",
          "[integrate][series][simd][ratchet]") {
  struct Region {
    Point low, high;
    int order;
  };
  const auto region = GENERATE(values<Region>({{{-1, 0}, {5, 6}, 1},
                                               {{-0.1, 0}, {0.1, 0.3}, 1},
                                               {{-50, 0}, {200, 200}, 1},
                                               {{0, 0}, {5, 5}, 5},
                                               {{0, 0}, {0.01, 1}, 20},
                                               {{1, 0}, {1, 1000}, 1}}));
  const auto points = scattered(100, region.low, region.high, 7);
  const double size = std::max(std::abs(region.low.delta), region.high.delta) + region.high.epsilon;
  const int least = static_cast<int>(std::ceil(std::max(std::sqrt(size), 1.5 * region.order)));
  CAPTURE(region.high.delta, region.high.epsilon, region.order);
  for (const int steps : {least, 2 * least}) {
    for (const int terms : {7, 9, 11, 13, 16, 20}) {
      CAPTURE(steps, terms);
      const auto r = run({steps, terms}, region.order, points);
      for (std::size_t l = 0; l < points.size(); ++l) {
        const auto truth =
            taylor(points[l], region.order, 60 + static_cast<int>(4.0 * std::sqrt(size)) + 8 * region.order);
        const std::array<double, 4> value{r.u1[l], r.du1[l], r.u2[l], r.du2[l]};
        const std::array<double, 4> bound{r.u1_error[l], r.du1_error[l], r.u2_error[l], r.du2_error[l]};
        // the cosines are rounded, which the bounds leave out
        const double kappa = kappa_of(points[l].delta);
        const double phase = 4e-16 * region.order * kPi * std::sqrt(size) *
                             std::max({std::abs(value[0]), std::abs(value[1]) / kappa,
                                       kappa * std::abs(value[2]), std::abs(value[3])});
        const std::array<double, 4> unit{1.0, kappa, 1.0 / kappa, 1.0};
        for (std::size_t i = 0; i < 4; ++i) {
          const long double error =
              std::abs(value[i] - std::ldexp(truth[i], static_cast<int>(-r.exponent[l])));
          check_within("true error of an entry of a half-period over its bound",
                       static_cast<double>(error) / (bound[i] + phase * unit[i]), 1.0);
        }
      }
    }
  }
}

TEST_CASE("a tail grows with the numbers, falls with the terms and knows no signs", "[integrate][series]") {
  const std::vector<PeriodicFunction> basis{harmonic(0.0, 1.0, 1), harmonic(0.0, 1.0, 2)};
  const std::vector<double> weights{1.5, -0.5}, larger{1.5, 0.6}, opposite{-1.5, 0.5};
  double before = std::numeric_limits<double>::infinity();
  for (const int terms : {6, 8, 10, 12}) {
    const HillSeries series({2, terms}, basis, 0.0, kPi);
    const double tail = series.tail(3.0, weights);
    CHECK(tail > 0.0);
    CHECK(tail < 0.1 * before);
    CHECK(series.tail(3.1, weights) > tail);
    CHECK(series.tail(3.0, larger) > tail);
    CHECK(series.tail(-3.0, opposite) == tail);
    before = tail;
  }
  CHECK(std::isinf(HillSeries({1, 20}, basis, 0.0, kPi).tail(1e5, weights)));
}

TEST_CASE("the determinant of a propagator is 1 within the bounds", "[integrate][series][law][simd]") {
  const auto points = scattered(200, {-1.0, 0.0}, {30.0, 6.0}, 3);
  for (const HillSeriesPlan plan : {HillSeriesPlan{4, 8}, {4, 15}, {20, 9}}) {
    const auto r = run(plan, 1, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double scale = std::exp2(2.0 * static_cast<double>(r.exponent[i]));
      const double defect = (r.u1[i] * r.du2[i] - r.u2[i] * r.du1[i]) * scale - 1.0;
      const double bound = r.u1_error[i] * std::abs(r.du2[i]) + r.du2_error[i] * std::abs(r.u1[i]) +
                           r.u2_error[i] * std::abs(r.du1[i]) + r.du1_error[i] * std::abs(r.u2[i]);
      CHECK(std::abs(defect) <= 1.01 * bound * scale);
    }
  }
}

TEST_CASE("a lane has the same bits whatever stands beside it", "[integrate][series][simd][N46][extreme]") {
  auto points = scattered(101, {-5.0, 0.0}, {50.0, 40.0}, 5);
  points[7] = {std::nan(""), 1.0};
  points[8] = {1e308, 1.0};
  for (const HillSeriesPlan plan : {HillSeriesPlan{6, 12}, {7, 10}, {1, 20}, {20, 9}}) {
    const auto together = run(plan, 1, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i == 7 || i == 8) continue;
      CHECK(same(together, i, run(plan, 1, {points[i]}), 0));
    }
    std::vector<Point> reversed(points.rbegin(), points.rend());
    const auto backwards = run(plan, 1, reversed);
    for (std::size_t i = 9; i < points.size(); ++i)
      CHECK(same(together, i, backwards, points.size() - 1 - i));
  }
}

TEST_CASE("a function without weight changes nothing", "[integrate][series][simd]") {
  const auto points = scattered(37, {-1.0, 0.0}, {5.0, 6.0}, 9);
  std::vector<double> mean, weight, none(points.size(), 0.0);
  for (const auto& p : points) {
    mean.push_back(p.delta);
    weight.push_back(p.epsilon);
  }
  const std::vector<PeriodicFunction> basis{harmonic(0.0, 1.0, 1), harmonic(0.0, 1.0, 3)};
  HillPropagators general;
  propagate(HillSeries({4, 12}, basis, 0.0, kPi), {mean, {weight, none}}, general);
  const auto special = run({4, 12}, 1, points);
  for (std::size_t i = 0; i < points.size(); ++i) CHECK(same(general, i, special, i));
}

TEST_CASE("several harmonics, and a start that is not 0", "[integrate][series][simd][ratchet]") {
  // W = 2 + 0.7 cos + 0.2 sin - 0.3 cos 2: the propagator over [a, c] is that over [b, c] times that over [a,
  // b]
  const std::vector<PeriodicFunction> basis{
      harmonic(0.0, 1.0, 1), PeriodicFunction::fourier(0.0, {{1, 0.0, 1.0}}), harmonic(0.0, 1.0, 2)};
  const std::vector<double> mean{2.0}, c1{0.7}, s1{0.2}, c2{-0.3};
  const auto over = [&](double from, double to) {
    HillPropagators r;
    propagate(HillSeries({5, 14}, basis, from, to), {mean, {c1, s1, c2}}, r);
    const double scale = std::exp2(static_cast<double>(r.exponent[0]));
    return Eigen::Matrix2d{{r.u1[0] * scale, r.u2[0] * scale}, {r.du1[0] * scale, r.du2[0] * scale}};
  };
  const Eigen::Matrix2d parts = over(1.7, 4.0) * over(0.5, 1.7),
                        there_and_back = over(0.5, 4.0) * over(4.0, 0.5);
  check_within("propagator from its parts", (over(0.5, 4.0) - parts).cwiseAbs().maxCoeff(), 4e-15);
  check_within("propagator there and back",
               (there_and_back - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_CASE("growth beyond the range of double stays in the exponent",
          "[integrate][series][extreme][N01][simd][ratchet]") {
  for (const double delta : {-1e4, -1e6}) {
    const auto r = run({static_cast<int>(std::sqrt(-delta)), 16}, 1, {{delta, 0.0}});
    const double growth = std::log(r.u1[0]) + static_cast<double>(r.exponent[0]) * std::numbers::ln2;
    check_close("N01 logarithm of an entry of up to exp(3141) (relative)", growth,
                kPi * std::sqrt(-delta) - std::numbers::ln2, 1e-15);
    check_within("N01 bound of an entry of up to exp(3141) (relative)", r.u1_error[0] / r.u1[0], 4e-11);
  }
}

TEST_CASE("series that do not fit are refused", "[integrate][series][error]") {
  const std::vector<PeriodicFunction> basis{harmonic(0.0, 1.0, 1)};
  for (const HillSeriesPlan plan : {HillSeriesPlan{0, 10}, {20'001, 10}, {4, 3}, {4, 21}}) {
    CHECK_THROWS_AS(HillSeries(plan, basis, 0.0, kPi), InvalidInput);
  }
  const HillSeries series({6, 10}, basis, 0.0, kPi);
  const std::vector<double> two{1.0, 2.0}, one{1.0};
  HillPropagators result;
  CHECK_THROWS_AS(series.propagate({two, {}}, two, result), InvalidInput);
  CHECK_THROWS_AS(series.propagate({two, {one}}, two, result), InvalidInput);
  CHECK_THROWS_AS(series.propagate({two, {two}}, one, result), InvalidInput);
  CHECK_THROWS_AS(series.tail(1.0, {}), InvalidInput);
}

}  // namespace strutt::test::hill_series_test
