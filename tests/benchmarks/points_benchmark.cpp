// Discriminants of x'' + (delta + epsilon cos t) x = 0 at scattered points, with error bounds, and what
// integrators called point by point do.
//   points_per_s  of one thread, by processor time
//   error         largest true error of the trace / max(1, largest |entry|) at the points of
//   tests/reference/mathieu.csv ratio         rate of `discriminants` over this rate, at the error that
//   `discriminants` reached or better: medians of
//                 runs side by side
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "contestant.hpp"
#include "odeint_loop.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/floquet/hill_discriminants.hpp"
#include "strutt/floquet/stability.hpp"
#ifdef STRUTT_HAS_GSL
#include "gsl_loop.hpp"
#endif

namespace {

using namespace benchmarks;

constexpr std::size_t kPoints = 1'000'000;
constexpr std::size_t kBlock = 1 << 16;  // of points that a thread takes
constexpr const char* kTolerances[] = {"1e-5", "1e-7", "1e-9", "1e-12"};

struct Scattered {
  std::vector<double> delta, epsilon, value, error;

  Scattered() : value(kPoints), error(kPoints) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> x(-1.0, 5.0), y(0.0, 6.0);
    for (std::size_t i = 0; i < kPoints; ++i) {
      delta.push_back(x(random));
      epsilon.push_back(y(random));
    }
  }

  void compute(strutt::HillDiscriminants& engine, std::size_t first, std::size_t count) {
    const std::span<const double> d(delta), e(epsilon);
    engine.compute({d.subspan(first, count), {e.subspan(first, count)}},
                   std::span(value).subspan(first, count), std::span(error).subspan(first, count));
  }
};

Scattered& scattered() {
  static Scattered all;
  return all;
}

const std::vector<Point>& points() {
  static const std::vector<Point> all = mathieu_points();
  return all;
}

double scaled_error(double trace, const Matrix& exact) {
  const double size =
      std::max({1.0, std::abs(exact.m11), std::abs(exact.m12), std::abs(exact.m21), std::abs(exact.m22)});
  return std::abs(trace - (exact.m11 + exact.m22)) / size;
}

double largest_trace_error(const Answers& answers, const std::vector<Point>& all) {
  double largest = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double error = scaled_error(answers.matrices[k].m11 + answers.matrices[k].m22, all[k].exact);
    if (!(error <= largest)) largest = error;
  }
  return largest;
}

struct Reached {
  double error = 0.0, bound = 0.0;
};

Reached reached(strutt::HillDiscriminants& engine) {
  Reached result;
  for (const auto& point : points()) {
    double value = 0.0, promised = 0.0;
    engine.compute({std::span(&point.delta, 1), {std::span(&point.epsilon, 1)}}, {&value, 1}, {&promised, 1});
    result.error = std::max(result.error, scaled_error(value, point.exact));
    result.bound = std::max(result.bound, promised);
  }
  return result;
}

double seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <typename Work>
double seconds_of(const Work& work, clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  const double start = seconds(clock);
  work();
  return seconds(clock) - start;
}

double median(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<long>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

void count_points(benchmark::State& state, std::size_t count) {
  state.counters["points_per_s"] =
      benchmark::Counter(static_cast<double>(count * state.iterations()), benchmark::Counter::kIsRate);
}

void discriminants(benchmark::State& state, double tolerance) {
  strutt::HillDiscriminants engine({1}, tolerance);
  for (auto _ : state) scattered().compute(engine, 0, kPoints);
  count_points(state, kPoints);
  const auto found = reached(engine);
  state.counters["error"] = found.error;
  state.counters["bound"] = found.bound;
}

/// From nothing: plans and tables are made, too.
void discriminants_at_first(benchmark::State& state, double tolerance) {
  for (auto _ : state) {
    strutt::HillDiscriminants engine({1}, tolerance);
    scattered().compute(engine, 0, kPoints);
  }
  count_points(state, kPoints);
}

/// What storing values and bounds takes.
void memory_fill(benchmark::State& state) {
  auto& all = scattered();
  for (auto _ : state) {
    std::fill(all.value.begin(), all.value.end(), 1.0);
    std::fill(all.error.begin(), all.error.end(), 1.0);
    benchmark::ClobberMemory();
  }
  count_points(state, kPoints);
}

void run(benchmark::State& state, const Contestant& contestant, double tolerance) {
  strutt::HillDiscriminants engine({1}, tolerance);
  const auto tuned =
      tuned_tolerance(contestant, points(), std::max(reached(engine).error, 1e-15), largest_trace_error);
  if (!tuned) {
    state.SkipWithError("out of reach");
    return;
  }
  Answers answers;
  std::vector<double> ratios;
  for (auto _ : state) {
    const double own = seconds_of([&] { contestant.compute(*tuned, answers); });
    const double ours = seconds_of([&] { scattered().compute(engine, 0, kBlock); });
    state.SetIterationTime(own);
    ratios.push_back(own / static_cast<double>(points().size()) / (ours / kBlock));
  }
  count_points(state, points().size());
  state.counters["error"] = largest_trace_error(answers, points());
  state.counters["ratio"] = median(ratios);
}

/// All points by one thread and by two, in turn, by wall clock; and the processor time that two take for that
/// of one.
void two_threads(benchmark::State& state, double tolerance) {
  std::vector<std::unique_ptr<strutt::HillDiscriminants>> engines;
  for (int i = 0; i < 2; ++i)
    engines.push_back(std::make_unique<strutt::HillDiscriminants>(std::vector{1}, tolerance));
  const auto all = [&](int threads) {
    strutt::parallel_for((kPoints + kBlock - 1) / kBlock, {.threads = threads},
                         [&](std::size_t block, int slot) {
                           scattered().compute(*engines[static_cast<std::size_t>(slot)], block * kBlock,
                                               std::min(kBlock, kPoints - block * kBlock));
                         });
  };
  std::vector<double> faster, work;
  for (auto _ : state) {
    double wall[2] = {};
    double processor[2] = {};
    for (const int threads : {1, 2}) {
      const double start = seconds(CLOCK_PROCESS_CPUTIME_ID);
      wall[threads - 1] = seconds_of([&] { all(threads); }, CLOCK_MONOTONIC);
      processor[threads - 1] = seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
    }
    faster.push_back(wall[0] / wall[1]);
    work.push_back(processor[1] / processor[0]);
  }
  state.counters["faster_by"] = median(faster);
  state.counters["work"] = median(work);
}

/// The same points by the engine of charts: everything that `strutt stability` says, without the matrix.
void stability(benchmark::State& state, double tolerance) {
  strutt::MonodromyEngine engine;
  std::vector<strutt::LinearModel> models;
  for (std::size_t i = 0; i < 4096; ++i)
    models.emplace_back(strutt::mathieu_delta_epsilon(scattered().delta[i], scattered().epsilon[i]));
  for (auto _ : state) {
    auto results =
        strutt::analyse(engine, models, {.tolerance = tolerance}, {.winding = false, .matrix = false});
    benchmark::DoNotOptimize(results.data());
  }
  count_points(state, models.size());
}

const std::vector<Contestant>& contestants() {
  using boost::numeric::odeint::runge_kutta_dopri5;
  using boost::numeric::odeint::runge_kutta_fehlberg78;
  using strutt::detail::butcher_table;
  constexpr auto half = Span::half_period;
  static const std::vector<Contestant> all{
      contestant<CvodeLoop>("cvode", points(), half),
      contestant<ArkodeLoop>("arkode", points(), half, butcher_table(5), StepControl{}),
      contestant<ArkodeLoop>("arkode_order_8", points(), half, butcher_table(8), StepControl{}),
      contestant<OdeintLoop<runge_kutta_dopri5>>("odeint_dopri5", points(), half),
      contestant<OdeintLoop<runge_kutta_fehlberg78>>("odeint_fehlberg78", points(), half),
#ifdef STRUTT_HAS_GSL
      contestant<GslLoop>("gsl_rk8pd", points(), half),
#endif
  };
  return all;
}

[[maybe_unused]] const bool kRegistered = [] {
  const auto add = [](const std::string& name, auto body) {
    return benchmark::RegisterBenchmark(name.c_str(), body)->Unit(benchmark::kMillisecond);
  };
  add("memory_fill", memory_fill);
  for (const std::string name : kTolerances) {
    const double tolerance = std::stod(name);
    const auto at = [tolerance](auto body) {
      return [=](benchmark::State& state) { body(state, tolerance); };
    };
    add("discriminants/" + name, at(discriminants));
    add("discriminants_at_first/" + name, at(discriminants_at_first));
    add("two_threads/" + name, at(two_threads))->UseRealTime()->Iterations(15);
    add("stability/" + name, at(stability));
    for (const auto& contestant : contestants()) {
      add(contestant.name + "/" + name,
          [&contestant, tolerance](benchmark::State& state) { run(state, contestant, tolerance); })
          ->UseManualTime()
          ->MinTime(0.1);
    }
  }
  return true;
}();

}  // namespace
