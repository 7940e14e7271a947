// Charts of x'' + (delta + epsilon cos t) x = 0, delta in [-1, 5], epsilon in [0, 6], by surrogate at 1e-10,
// beside one product of matrices of the same size and the same chart point by point. All on one core, into
// strips that are thrown away.
//   cells_per_s   by processor time
//   interpolated  share of the cells that come from the surrogate
#include <benchmark/benchmark.h>

#include <Eigen/Core>

#include "chart/tensor_kernel.hpp"
#include "strutt/chart/stability_chart.hpp"

namespace {

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

void chart(benchmark::State& state, std::vector<strutt::Layer> layers, strutt::Method method) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto request = request_of(n, std::move(layers), method);
  strutt::ChartSummary summary;
  for (auto _ : state) {
    summary = strutt::compute_chart(mathieu(), request, [](const strutt::ChartStrip& strip) {
      benchmark::DoNotOptimize(strip.values[0].data());
    });
  }
  const auto cells = static_cast<double>(summary.cells);
  report(state, cells, static_cast<double>(summary.interpolated) / cells);
}

/// (n x rank) (rank x n) by Eigen, compiled for the processor's baseline, into strips of 16 rows.
void eigen_product(benchmark::State& state) {
  const auto n = static_cast<Eigen::Index>(state.range(0));
  constexpr Eigen::Index rank = 20, rows = 16;
  const Eigen::MatrixXd left = Eigen::MatrixXd::Random(n, rank), right = Eigen::MatrixXd::Random(rank, n);
  Eigen::MatrixXd strip(n, rows);
  for (auto _ : state) {
    for (Eigen::Index row = 0; row < n; row += rows) {
      strip.noalias() = left * right.middleCols(row, rows);
      benchmark::DoNotOptimize(strip.data());
    }
  }
  report(state, static_cast<double>(n * n), 0.0);
}

/// The same by the kernel of the surrogate, with the widest instruction set.
void kernel_product(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  constexpr std::size_t rank = 20, rows = 16;
  const std::vector<double> basis(rank * n, 0.5), weights(rank * rows, 0.25);
  std::vector<double> values(rows * n);
  for (auto _ : state) {
    for (std::size_t row = 0; row < n; row += rows) {
      strutt::detail::evaluate(
          {basis.data(), n, weights.data(), rows, rows, n, rank, values.data(), n});
      benchmark::DoNotOptimize(values.data());
    }
  }
  report(state, static_cast<double>(n) * static_cast<double>(n), 0.0);
}

using strutt::Layer;
using strutt::Method;

BENCHMARK_CAPTURE(chart, discriminant, {Layer::discriminant}, Method::surrogate)->Arg(1024)->Arg(4096);
BENCHMARK_CAPTURE(chart, verdict_growth, {Layer::verdict, Layer::growth}, Method::surrogate)
    ->Arg(1024)
    ->Arg(4096);
BENCHMARK_CAPTURE(chart, verdict_growth_winding, {Layer::verdict, Layer::growth, Layer::winding},
                  Method::surrogate)
    ->Arg(1024)
    ->Arg(4096);
BENCHMARK_CAPTURE(chart, point_by_point, {Layer::verdict, Layer::growth}, Method::propagator)->Arg(256);
BENCHMARK(eigen_product)->Arg(4096);
BENCHMARK(kernel_product)->Arg(4096);

}  // namespace
