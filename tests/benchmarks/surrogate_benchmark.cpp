// Charts by surrogate, all on one core:
//  - x'' + (delta + epsilon cos t) x = 0, delta in [-1, 5], epsilon in [0, 6], at 1e-10, beside Eigen's
//  product of
//    (n x 20)(20 x n) compiled for the instruction set of this process (STRUTT_ISA), both into arrays that
//    were written before;
//  - two coupled pendulums, four states, at 1e-8, beside SUNDIALS point by point.
//  - the same box at 100,000 scattered points
//   cells_per_s   by processor time
//   interpolated  share of the cells that come from the surrogate
//   to_product    median time by that of one product
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "benchmarks/eigen_product.hpp"
#include "chart/tensor_kernel.hpp"
#include "strutt/base/instruction_set.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/io/scene_file.hpp"

namespace {

using strutt::Layer;
using strutt::Method;

strutt::Scene mathieu() {
  strutt::Scene scene;
  scene.mathieu = strutt::MathieuTable{};
  return scene;
}

strutt::ChartRequest request_of(std::size_t n, std::vector<strutt::Layer> layers, strutt::Method method) {
  return {.x = {.parameter = "mathieu.delta", .from = -1.0, .to = 5.0, .points = n},
          .y = {.parameter = "mathieu.epsilon", .from = 0.0, .to = 6.0, .points = n},
          .layers = std::move(layers),
          .tolerance = 1e-10,
          .method = method,
          .threads = 1};
}

void report(benchmark::State& state, double cells, double interpolated) {
  state.counters["cells_per_s"] = benchmark::Counter(cells, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["interpolated"] = interpolated;
}

/// Arrays of n x n cells for the layers, written once.
std::vector<std::vector<double>> arrays(std::size_t n, std::size_t layers) {
  return std::vector<std::vector<double>>(layers, std::vector<double>(n * n, 1.0));
}

strutt::ChartSummary chart_into(std::vector<std::vector<double>>& results, const strutt::Scene& scene,
                                const strutt::ChartRequest& request) {
  const std::vector<std::span<double>> places(results.begin(), results.end());
  return strutt::compute_chart(scene, request, places);
}

EigenProduct product_here() {
  switch (strutt::instruction_set()) {
    case strutt::InstructionSet::avx512:
      return eigen_product_avx512;
    case strutt::InstructionSet::avx2:
      return eigen_product_avx2;
    case strutt::InstructionSet::sse2:
      break;
  }
  return eigen_product_sse2;
}

constexpr std::size_t kRank = 20;

/// One product into an array that was written before.
class Product {
 public:
  explicit Product(std::size_t n)
      : n_(n), left_(n * kRank, 0.5), right_(n * kRank, 0.25), result_(n * n, 1.0) {}
  void run() {
    product_here()(left_.data(), right_.data(), result_.data(), static_cast<std::ptrdiff_t>(n_), kRank);
    benchmark::DoNotOptimize(result_.data());
  }

 private:
  std::size_t n_;
  std::vector<double> left_, right_, result_;
};

double seconds_of(const auto& function) {
  const auto begin = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void chart(benchmark::State& state, std::vector<strutt::Layer> layers, strutt::Method method) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto request = request_of(n, std::move(layers), method);
  auto results = arrays(n, request.layers.size());
  strutt::ChartSummary summary;
  for (auto _ : state) summary = chart_into(results, mathieu(), request);
  const auto cells = static_cast<double>(summary.cells);
  report(state, cells, static_cast<double>(summary.interpolated) / cells);
  if (method != strutt::Method::surrogate) return;
  Product product(n);
  std::vector<double> charts, products;
  for (int k = 0; k < 7; ++k) {  // in turn, so that both see the same neighbours
    charts.push_back(seconds_of([&] { chart_into(results, mathieu(), request); }));
    products.push_back(seconds_of([&] { product.run(); }));
  }
  state.counters["to_product"] = median(charts) / median(products);
}

/// Points scattered over the same box, by a surrogate that is there: what is interpolated, and all of
/// Monodromy.
void scattered(benchmark::State& state, bool monodromies) {
  const auto request = request_of(1024, {Layer::discriminant}, strutt::Method::surrogate);
  const strutt::Surrogate surrogate(mathieu(), request.x, request.y, {.tolerance = 1e-10, .threads = 1});
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<std::array<double, 2>> points(static_cast<std::size_t>(state.range(0)));
  for (auto& p : points) p = {std::lerp(-1.0, 5.0, share(random)), std::lerp(0.0, 6.0, share(random))};
  for (auto _ : state) {
    if (monodromies)
      benchmark::DoNotOptimize(surrogate.hill_monodromies(points));
    else
      benchmark::DoNotOptimize(surrogate.entries(points));
  }
  report(state, static_cast<double>(points.size()), 1.0);
}

/// Two pendulums, of which one is shaken (docs/examples/coupled_pendulums.toml).
void coupled_pendulums(benchmark::State& state, strutt::Method method) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto scene = strutt::read_scene(STRUTT_SOURCE_DIR "/docs/examples/coupled_pendulums.toml").scene;
  const strutt::ChartRequest request{
      .x = {.parameter = "linear.period", .from = 1.8, .to = 3.4, .points = n},
      .y = {.parameter = "linear.stiffness.harmonics.1.cos.0.0", .from = 0.0, .to = 1.2, .points = n},
      .layers = {strutt::Layer::verdict, strutt::Layer::growth},
      .tolerance = 1e-8,
      .method = method,
      .threads = 1};
  auto results = arrays(n, 2);
  strutt::ChartSummary summary;
  for (auto _ : state) summary = chart_into(results, scene, request);
  const auto cells = static_cast<double>(summary.cells);
  report(state, cells, static_cast<double>(summary.interpolated) / cells);
}

void eigen_product(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  Product product(n);
  for (auto _ : state) product.run();
  report(state, static_cast<double>(n) * static_cast<double>(n), 0.0);
}

/// The same by the kernel of the surrogate, into strips of 16 rows.
void kernel_product(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  constexpr std::size_t rows = 16;
  const std::vector<double> basis(kRank * n, 0.5), weights(kRank * rows, 0.25);
  std::vector<double> values(rows * n);
  for (auto _ : state) {
    for (std::size_t row = 0; row < n; row += rows) {
      strutt::detail::evaluate({basis.data(), n, weights.data(), rows, rows, n, kRank, values.data(), n});
      benchmark::DoNotOptimize(values.data());
    }
  }
  report(state, static_cast<double>(n) * static_cast<double>(n), 0.0);
}

BENCHMARK_CAPTURE(scattered, entries, false)->Arg(100'000);
BENCHMARK_CAPTURE(scattered, monodromies, true)->Arg(100'000);
BENCHMARK_CAPTURE(chart, discriminant, {Layer::discriminant}, Method::surrogate)->Arg(1024)->Arg(4096);
BENCHMARK_CAPTURE(chart, verdict_growth, {Layer::verdict, Layer::growth}, Method::surrogate)
    ->Arg(1024)
    ->Arg(4096);
BENCHMARK_CAPTURE(chart, verdict_growth_winding, {Layer::verdict, Layer::growth, Layer::winding},
                  Method::surrogate)
    ->Arg(1024)
    ->Arg(4096);
BENCHMARK_CAPTURE(chart, point_by_point, {Layer::verdict, Layer::growth}, Method::propagator)->Arg(256);
BENCHMARK_CAPTURE(coupled_pendulums, surrogate, Method::surrogate)->Arg(1024);
BENCHMARK_CAPTURE(coupled_pendulums, point_by_point, Method::automatic)->Arg(64);
BENCHMARK_CAPTURE(coupled_pendulums, arkode, Method::arkode)->Arg(32);
BENCHMARK_CAPTURE(coupled_pendulums, cvode, Method::cvode)->Arg(16);
BENCHMARK(eigen_product)->Arg(4096);
BENCHMARK(kernel_product)->Arg(4096);

}  // namespace
