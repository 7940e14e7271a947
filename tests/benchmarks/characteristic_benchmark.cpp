// The 41 characteristic values a_0 ... a_20, b_1 ... b_20 of Mathieu's equation at one q: Strutt in one call,
// GSL by its array calls and order by order. `values_per_second` counts single values; `worst` is the largest
// error of GSL against Strutt's, divided by 4 x 2^-52 x (|a| + 2 |q|), the accuracy that Strutt promises.
#include <benchmark/benchmark.h>
#ifdef STRUTT_HAS_GSL
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_mathieu.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "strutt/floquet/characteristic_values.hpp"

namespace {

constexpr int kLast = 20;
constexpr int kValues = 2 * kLast + 1;

void count_values(benchmark::State& state) {
  state.counters["values_per_second"] =
      benchmark::Counter(kValues, benchmark::Counter::kIsIterationInvariantRate);
}

void strutt_batch(benchmark::State& state) {
  const auto q = static_cast<double>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(strutt::characteristic_values(0, kLast, q));
  count_values(state);
}
BENCHMARK(strutt_batch)->Arg(1)->Arg(100)->Arg(100'000)->Arg(100'000'000)->Unit(benchmark::kMicrosecond);

void strutt_one_by_one(benchmark::State& state) {
  const auto q = static_cast<double>(state.range(0));
  for (auto _ : state)
    for (int n = 0; n <= kLast; ++n) benchmark::DoNotOptimize(strutt::characteristic_values(n, n, q));
  count_values(state);
}
BENCHMARK(strutt_one_by_one)->Arg(100'000)->Unit(benchmark::kMicrosecond);

#ifdef STRUTT_HAS_GSL
using Values = std::array<double, kLast + 1>;

void gsl(benchmark::State& state, const std::function<void(double q, Values& a, Values& b)>& compute) {
  gsl_set_error_handler_off();
  const auto q = static_cast<double>(state.range(0));
  Values a{}, b{};
  for (auto _ : state) {
    compute(q, a, b);
    benchmark::DoNotOptimize(a.data());
    benchmark::DoNotOptimize(b.data());
  }
  double worst = 0.0;
  const auto compare = [&](double found, double value) {
    worst = std::max(worst, std::abs(found - value) / (4.0 * 0x1p-52 * (std::abs(value) + 2.0 * q)));
  };
  for (const auto& pair : strutt::characteristic_values(0, kLast, q)) {
    compare(a[static_cast<std::size_t>(pair.order)], pair.a.value);
    if (pair.b) compare(b[static_cast<std::size_t>(pair.order)], pair.b->value);
  }
  state.counters["worst"] = worst;
  count_values(state);
}

void gsl_arrays(benchmark::State& state) {
  gsl_sf_mathieu_workspace* workspace = gsl_sf_mathieu_alloc(kLast, static_cast<double>(state.range(0)));
  gsl(state, [&](double q, Values& a, Values& b) {
    gsl_sf_mathieu_a_array(0, kLast, q, workspace, a.data());
    gsl_sf_mathieu_b_array(0, kLast, q, workspace, b.data());
  });
  gsl_sf_mathieu_free(workspace);
}
BENCHMARK(gsl_arrays)->Arg(1)->Arg(100)->Arg(100'000)->Unit(benchmark::kMicrosecond);

void gsl_one_by_one(benchmark::State& state) {
  gsl(state, [](double q, Values& a, Values& b) {
    for (int n = 0; n <= kLast; ++n) {
      gsl_sf_result value;
      gsl_sf_mathieu_a_e(n, q, &value);
      a[static_cast<std::size_t>(n)] = value.val;
      if (n == 0) continue;
      gsl_sf_mathieu_b_e(n, q, &value);
      b[static_cast<std::size_t>(n)] = value.val;
    }
  });
}
BENCHMARK(gsl_one_by_one)->Arg(1)->Arg(100)->Arg(100'000)->Unit(benchmark::kMicrosecond);
#endif

}  // namespace
