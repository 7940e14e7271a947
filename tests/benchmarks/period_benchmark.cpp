// A million periods T/T0 at given amplitudes: Strutt against the elliptic integrals of Boost, GSL and the
// standard library and against a plain loop of arithmetic-geometric means. Nine of ten amplitudes are uniform
// in [0, pi], the tenth comes to within 1e-12 of pi. `worst_ulp` is the largest error of 5000 of them against
// 50 digits.
#include <benchmark/benchmark.h>
#ifdef STRUTT_HAS_GSL
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_ellint.h>
#endif

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "strutt/free_pendulum/period.hpp"

namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
using std::numbers::pi;
constexpr std::size_t kCount = 1'000'000;

std::vector<double> make_amplitudes() {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(0.0, pi), exponent(-12.0, 0.0);
  std::vector<double> amplitudes(kCount);
  for (std::size_t i = 0; i < kCount; ++i)
    amplitudes[i] = i % 10 == 9 ? pi - std::pow(10.0, exponent(generator)) : uniform(generator);
  return amplitudes;
}

const std::vector<double>& amplitudes() {
  static const auto values = make_amplitudes();
  return values;
}

double worst_ulp(const std::vector<double>& ratios) {
  double worst = 0.0;
  for (std::size_t i = 0; i < kCount; i += kCount / 5000 - 1) {
    Real a = 1, b = cos(Real(amplitudes()[i]) / 2);
    for (int step = 0; step < 12; ++step) {
      const Real mean = (a + b) / 2;
      b = sqrt(a * b);
      a = mean;
    }
    const Real truth = 1 / a;
    const double nearest = static_cast<double>(truth);
    const double ulp = std::nextafter(nearest, 1e300) - nearest;
    const double error = std::abs(static_cast<double>(Real((ratios[i] - truth) / ulp)));
    worst = std::isnan(error) ? INFINITY : std::max(worst, error);
  }
  return worst;
}

template <typename Work>
void measure(benchmark::State& state, const Work& work) {
  std::vector<double> ratios(kCount);
  work(amplitudes(), ratios);
  for (auto _ : state) {
    work(amplitudes(), ratios);
    benchmark::DoNotOptimize(ratios.data());
  }
  state.counters["worst_ulp"] = worst_ulp(ratios);
  state.counters["ns_per_period"] =
      benchmark::Counter(static_cast<double>(kCount) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Element by element, ratio = (2/pi) K(sin(amplitude/2)).
template <typename Integral>
void measure_library(benchmark::State& state, const Integral& complete_integral) {
  measure(state, [&](const std::vector<double>& in, std::vector<double>& out) {
    std::transform(in.begin(), in.end(), out.begin(),
                   [&](double a) { return 2.0 / pi * complete_integral(std::sin(0.5 * a)); });
  });
}

void strutt_batch(benchmark::State& state) {
  measure(state, [](const auto& in, auto& out) { strutt::period_ratios(in, out); });
}

void strutt_single(benchmark::State& state) {
  measure(state, [](const auto& in, auto& out) {
    std::transform(in.begin(), in.end(), out.begin(), strutt::period_ratio);
  });
}

/// Nine steps and the last mean reach double precision from k' = 6e-17 on: no branch, so that the compiler
/// makes vector code of it.
[[gnu::target_clones("avx512f", "avx2", "default")]] void agm_loop(const double* __restrict k_prime,
                                                                   double* __restrict ratio,
                                                                   std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    double a = 1.0, b = k_prime[i];
    for (int step = 0; step < 9; ++step) {
      const double mean = 0.5 * (a + b);
      b = std::sqrt(a * b);
      a = mean;
    }
    ratio[i] = 2.0 / (a + b);
  }
}

void plain_agm_loop(benchmark::State& state) {
  std::vector<double> k_prime(kCount);
  measure(state, [&](const auto& in, auto& out) {
    std::transform(in.begin(), in.end(), k_prime.begin(), [](double a) { return std::cos(0.5 * a); });
    agm_loop(k_prime.data(), out.data(), kCount);
  });
}

void plain_agm_loop_from_k_prime(benchmark::State& state) {
  std::vector<double> k_prime(kCount);
  std::transform(amplitudes().begin(), amplitudes().end(), k_prime.begin(),
                 [](double a) { return std::cos(0.5 * a); });
  measure(state, [&](const auto&, auto& out) { agm_loop(k_prime.data(), out.data(), kCount); });
}

void boost_ellint_1(benchmark::State& state) {
  // At k = 1 it throws; the default of no exceptions is an infinity.
  using namespace boost::math::policies;
  using Quiet = policy<overflow_error<ignore_error>, domain_error<ignore_error>, pole_error<ignore_error>>;
  measure_library(state, [](double k) { return boost::math::ellint_1(k, Quiet()); });
}

void standard_comp_ellint_1(benchmark::State& state) {
  measure_library(state, [](double k) { return std::comp_ellint_1(k); });
}

#ifdef STRUTT_HAS_GSL
void gsl_kcomp(benchmark::State& state) {
  gsl_set_error_handler_off();
  measure_library(state, [](double k) { return gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE); });
}
BENCHMARK(gsl_kcomp)->Unit(benchmark::kMillisecond);
#endif

BENCHMARK(strutt_batch)->Unit(benchmark::kMillisecond);
BENCHMARK(strutt_single)->Unit(benchmark::kMillisecond);
BENCHMARK(plain_agm_loop)->Unit(benchmark::kMillisecond);
BENCHMARK(plain_agm_loop_from_k_prime)->Unit(benchmark::kMillisecond);
BENCHMARK(boost_ellint_1)->Unit(benchmark::kMillisecond);
BENCHMARK(standard_comp_ellint_1)->Unit(benchmark::kMillisecond);

}  // namespace
