// Discriminants of x'' + (delta + epsilon cos t) x = 0 at scattered points, with error bounds: points per second and
// the error reached, one thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mathieu_points.hpp"
#include "strutt/floquet/hill_discriminants.hpp"
#include "strutt/floquet/stability.hpp"

namespace {

constexpr std::size_t kPoints = 100'000;
constexpr double kTolerances[] = {1e-5, 1e-7, 1e-9, 1e-12};

struct Points {
  std::vector<double> delta, epsilon;

  Points() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> x(-1.0, 5.0), y(0.0, 6.0);
    for (std::size_t i = 0; i < kPoints; ++i) {
      delta.push_back(x(random));
      epsilon.push_back(y(random));
    }
  }
};

/// Largest error at the points of tests/reference/mathieu.csv, and the largest bound.
void report_errors(benchmark::State& state, strutt::HillDiscriminants& discriminants) {
  double error = 0.0, bound = 0.0;
  for (const auto& point : benchmarks::mathieu_points()) {
    double value = 0.0, promised = 0.0;
    discriminants.compute({std::span(&point.delta, 1), {std::span(&point.epsilon, 1)}}, {&value, 1}, {&promised, 1});
    const auto& m = point.exact;
    const double size = std::max({1.0, std::abs(m.m11), std::abs(m.m12), std::abs(m.m21), std::abs(m.m22)});
    error = std::max(error, std::abs(value - (m.m11 + m.m22)) / size);
    bound = std::max(bound, promised);
  }
  state.counters["error"] = error;
  state.counters["bound"] = bound;
}

void discriminants(benchmark::State& state) {
  const double tolerance = kTolerances[state.range(0)];
  const Points points;
  std::vector<double> value(kPoints), error(kPoints);
  strutt::HillDiscriminants engine({1}, tolerance);
  for (auto _ : state) {
    engine.compute({points.delta, {points.epsilon}}, value, error);
    benchmark::DoNotOptimize(value.data());
  }
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>(kPoints * state.iterations()), benchmark::Counter::kIsRate);
  state.counters["tolerance"] = tolerance;
  report_errors(state, engine);
}
BENCHMARK(discriminants)->DenseRange(0, std::size(kTolerances) - 1)->Unit(benchmark::kMillisecond);

/// The same by the engine of charts: everything that `strutt stability` says, without the matrix.
void stability(benchmark::State& state) {
  const double tolerance = kTolerances[state.range(0)];
  const Points points;
  strutt::MonodromyEngine engine;
  std::vector<strutt::LinearModel> models;
  for (std::size_t i = 0; i < 4096; ++i)
    models.emplace_back(strutt::mathieu_delta_epsilon(points.delta[i], points.epsilon[i]));
  for (auto _ : state) {
    auto results = strutt::analyse(engine, models, {.tolerance = tolerance}, {.winding = false, .matrix = false});
    benchmark::DoNotOptimize(results.data());
  }
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>(models.size() * state.iterations()), benchmark::Counter::kIsRate);
  state.counters["tolerance"] = tolerance;
}
BENCHMARK(stability)->DenseRange(0, std::size(kTolerances) - 1)->Unit(benchmark::kMillisecond);

}  // namespace
