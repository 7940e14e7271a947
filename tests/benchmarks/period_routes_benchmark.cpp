// What a period costs by every route, and how good it is: the approximate formulas, the closed form, elliptic
// integrals of libraries, and integration until the pendulum passes the bottom, a quarter of a period after
// it was let go. Amplitudes are uniform in (0, 3] rad. `up_to_1`, `up_to_2`, `up_to_3`: the largest
// relative error of those up to 1, 2, 3 rad, against 50 digits.
#include <benchmark/benchmark.h>
#ifdef STRUTT_HAS_GSL
#include <gsl/gsl_sf_ellint.h>
#endif

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "strutt/free_pendulum/period_formulas.hpp"
#include "strutt/integrate/integrator.hpp"

namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
using std::numbers::pi;
using strutt::PeriodMethod;

std::vector<double> amplitudes(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = 3.0 * static_cast<double>(i + 1) / static_cast<double>(count);
  return values;
}

Real exact_ratio(double amplitude) {
  Real a = 1, b = cos(Real(amplitude) / 2);
  for (int step = 0; step < 10; ++step) {
    const Real mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return 1 / a;
}

double worst_error(const std::vector<double>& amplitude, const std::vector<double>& ratio, double limit) {
  double worst = 0.0;
  for (std::size_t i = 0; i < amplitude.size() && amplitude[i] <= limit; i += 1 + amplitude.size() / 3000) {
    const double error = std::abs(static_cast<double>(Real(Real(ratio[i]) / exact_ratio(amplitude[i]) - 1)));
    worst = std::isnan(error) ? INFINITY : std::max(worst, error);
  }
  return worst;
}

/// `work` fills ratios from amplitudes.
template <typename Work>
void measure(benchmark::State& state, std::size_t count, const Work& work) {
  const auto in = amplitudes(count);
  std::vector<double> out(count);
  for (auto _ : state) {
    work(in, out);
    benchmark::DoNotOptimize(out.data());
  }
  for (const int limit : {1, 2, 3})
    state.counters["up_to_" + std::to_string(limit)] = worst_error(in, out, limit);
  state.counters["ns_per_period"] =
      benchmark::Counter(static_cast<double>(count) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <typename Ratio>
void measure_single(benchmark::State& state, const Ratio& ratio, std::size_t count = 30'000) {
  measure(state, count,
          [&](const auto& in, auto& out) { std::transform(in.begin(), in.end(), out.begin(), ratio); });
}

void formula(benchmark::State& state, PeriodMethod method) {
  measure_single(state, [=](double a) { return strutt::formula_ratio(method, a); });
}

/// Without checks and calls, so that the compiler vectorises it: the least that (31) can cost.
void formula_written_out(benchmark::State& state) {
  measure_single(state, [](double a) { return 1.0 / (1.0 - a * a / 16.0); });
}

void cheapest(benchmark::State& state, double tolerance) {
  const strutt::CheapestPeriod periods(tolerance);
  measure_single(state, [&](double a) { return periods.ratio(a); });
}

void cheapest_with_error(benchmark::State& state, double tolerance) {
  const strutt::CheapestPeriod periods(tolerance);
  measure_single(state, [&](double a) { return periods.of_amplitude(a).ratio; });
}

void elliptic_single(benchmark::State& state) { measure_single(state, strutt::period_ratio); }

void elliptic_batch(benchmark::State& state) {
  measure(state, 30'000, [](const auto& in, auto& out) { strutt::period_ratios(in, out); });
}

double agm_ratio(double amplitude) {
  double a = 1.0, b = std::cos(0.5 * amplitude);
  while (a - b > 1e-8 * a) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2.0 / (a + b);
}

void plain_agm(benchmark::State& state) { measure_single(state, agm_ratio); }

void boost_ellint_1(benchmark::State& state) {
  measure_single(state, [](double a) { return 2.0 / pi * boost::math::ellint_1(std::sin(0.5 * a)); });
}

void standard_comp_ellint_1(benchmark::State& state) {
  measure_single(state, [](double a) { return 2.0 / pi * std::comp_ellint_1(std::sin(0.5 * a)); });
}

#ifdef STRUTT_HAS_GSL
void gsl_kcomp(benchmark::State& state) {
  measure_single(state,
                 [](double a) { return 2.0 / pi * gsl_sf_ellint_Kcomp(std::sin(0.5 * a), GSL_PREC_DOUBLE); });
}
BENCHMARK(gsl_kcomp);
#endif

void pendulum(double, strutt::StateView y, strutt::StateOut dydt) {
  dydt[0] = y[1];
  dydt[1] = -std::sin(y[0]);
}

/// Released at the amplitude, until the angle is 0.
void integration(benchmark::State& state, double tolerance) {
  strutt::Integrator integrator(2, {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
  const strutt::EventRequest bottom{[](double, strutt::StateView y, strutt::StateOut g) { g[0] = y[0]; },
                                    {strutt::Crossing::falling}};
  const auto ratio = [&](double amplitude) {
    Eigen::VectorXd y{{amplitude, 0.0}};
    return integrator.advance(pendulum, 0.0, 10.0, y, &bottom).t * 2.0 / pi;
  };
  measure_single(state, ratio, 300);
}

BENCHMARK_CAPTURE(formula, normal_form, PeriodMethod::normal_form);
BENCHMARK_CAPTURE(formula, krylov, PeriodMethod::krylov);
BENCHMARK_CAPTURE(formula, krylov_squared, PeriodMethod::krylov_squared);
BENCHMARK_CAPTURE(formula, series, PeriodMethod::series);
BENCHMARK(formula_written_out);
BENCHMARK_CAPTURE(cheapest, 1e-3, 1e-3);
BENCHMARK_CAPTURE(cheapest, 1e-15, 1e-15);
BENCHMARK_CAPTURE(cheapest_with_error, 1e-3, 1e-3);
BENCHMARK(elliptic_batch);
BENCHMARK(elliptic_single);
BENCHMARK(plain_agm);
BENCHMARK(boost_ellint_1);
BENCHMARK(standard_comp_ellint_1);
BENCHMARK_CAPTURE(integration, 1e-6, 1e-6);
BENCHMARK_CAPTURE(integration, 1e-9, 1e-9);
BENCHMARK_CAPTURE(integration, 1e-13, 1e-13);

}  // namespace
