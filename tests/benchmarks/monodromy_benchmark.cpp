// Monodromy matrices of x'' + (delta + epsilon cos t) x = 0, point by point: Strutt's engine, loops written
// by hand around the same SUNDIALS steppers, and Boost.odeint. Every method but "as asked" runs at the
// tolerance of its own that reaches the target with the fewest right-hand sides, so that what is compared is
// the price of equal accuracy.
//   points_per_s   of one core, by processor time
//   error          largest true error of the entries and the trace / max(1, largest |entry|)
//   rhs            right-hand sides a point
#include <time.h>

#include <algorithm>
#include <array>

#include "contestant.hpp"
#include "odeint_loop.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/monodromy.hpp"
#include "sundials_loop.hpp"

namespace {

using namespace benchmarks;

const std::vector<Point>& points() {
  static const std::vector<Point> all = mathieu_points();
  return all;
}

/// Strutt, asked for a tolerance as a user would.
class Engine {
 public:
  explicit Engine(bool estimate_error)
      : options_{.method = strutt::Method::arkode, .estimate_error = estimate_error} {}
  void set_tolerance(double tolerance) { options_.tolerance = std::clamp(tolerance, 1e-13, 1e-2); }

  Matrix compute(const Point& point, long& right_hand_sides) {
    const auto result = engine_.compute(strutt::mathieu_delta_epsilon(point.delta, point.epsilon), options_);
    right_hand_sides += result.cost.right_hand_sides + result.estimate_cost.right_hand_sides;
    const auto& m = result.matrix.value.mantissa;
    const double scale = std::ldexp(1.0, static_cast<int>(result.matrix.value.exponent));
    return {scale * m(0, 0), scale * m(0, 1), scale * m(1, 0), scale * m(1, 1)};
  }

 private:
  strutt::MonodromyOptions options_;
  strutt::MonodromyEngine engine_;
};

strutt::detail::ButcherTable built_in(ARKODE_ERKTableID id) {
  return strutt::detail::ButcherTable(ARKodeButcherTable_LoadERK(id));
}

/// Loops by hand over SUNDIALS steppers; the fastest of them is what Strutt is measured against.
const std::vector<Contestant>& loops() {
  static const std::vector<Contestant> all = [] {
    using strutt::detail::butcher_table;
    const auto half = Span::half_period;
    const StepControl plain{}, first_step{.first_step_radians = 5.0},
        tuned{.first_step_radians = 5.0, .grow_at_once = true};
    return std::vector{
        contestant<ArkodeLoop>("order_8", points(), half, butcher_table(8), plain),
        contestant<ArkodeLoop>("order_8_first_step", points(), half, butcher_table(8), first_step),
        contestant<ArkodeLoop>("order_8_tuned", points(), half, butcher_table(8), tuned),
        contestant<ArkodeLoop>("order_6_tuned", points(), half, butcher_table(6), tuned),
        contestant<ArkodeLoop>("order_5_tuned", points(), half, butcher_table(5), tuned),
        contestant<ArkodeLoop>("fehlberg_7_8", points(), half, built_in(ARKODE_FEHLBERG_13_7_8), plain),
        contestant<ArkodeLoop>("order_8_full_period", points(), Span::period, butcher_table(8), plain),
        contestant<CvodeLoop>("adams", points(), half),
        contestant<CvodeLoop>("adams_full_period", points(), Span::period),
    };
  }();
  return all;
}

/// What is more than a loop around a SUNDIALS stepper.
const std::vector<Contestant>& others() {
  static const std::vector<Contestant> all{
      contestant<ArkodeLoop>("order_8_tuned_own_sums", points(), Span::half_period,
                             strutt::detail::butcher_table(8),
                             StepControl{.first_step_radians = 5.0, .grow_at_once = true, .own_sums = true}),
      contestant<OdeintLoop<boost::numeric::odeint::runge_kutta_fehlberg78>>("odeint_fehlberg_7_8", points(),
                                                                             Span::half_period)};
  return all;
}

const Contestant& strutt_value() {
  static const Contestant engine = contestant<Engine>("strutt", points(), false);
  return engine;
}

const Contestant& strutt_estimate() {
  static const Contestant engine = contestant<Engine>("strutt_with_estimate", points(), true);
  return engine;
}

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double seconds_of(const Contestant& contestant, double tolerance, Answers& answers) {
  const double start = processor_seconds();
  contestant.compute(tolerance, answers);
  return processor_seconds() - start;
}

void run(benchmark::State& state, const Contestant& contestant, std::optional<double> tolerance) {
  if (!tolerance) {
    state.SkipWithError("out of reach");
    return;
  }
  Answers answers;
  for (auto _ : state) contestant.compute(*tolerance, answers);
  const auto count = static_cast<double>(points().size());
  state.counters["points_per_s"] =
      benchmark::Counter(count * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["error"] = largest_error(answers, points());
  state.counters["rhs"] = static_cast<double>(answers.right_hand_sides) / count;
  state.counters["tolerance"] = *tolerance;
}

/// Time of Strutt at the tolerance asked for, divided by that of the fastest loop that reaches the error
/// Strutt had; the median of runs side by side, which other work on the machine does not shift.
void ratio_to_best_loop(benchmark::State& state, double tolerance) {
  Answers answers;
  strutt_value().compute(tolerance, answers);
  const double error = largest_error(answers, points());
  const Contestant* best = nullptr;
  double best_tolerance = 0.0, least = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops()) {
    const auto tuned = tuned_tolerance(loop, points(), error);
    if (!tuned) continue;
    std::array<double, 15> seconds{};
    for (double& s : seconds) s = seconds_of(loop, *tuned, answers);
    const double fastest = *std::min_element(seconds.begin(), seconds.end());
    if (fastest < least) best = &loop, best_tolerance = *tuned, least = fastest;
  }
  if (best == nullptr) {
    state.SkipWithError("no loop reaches the error");
    return;
  }
  std::vector<double> value, estimate;
  for (auto _ : state) {
    const double with_estimate = seconds_of(strutt_estimate(), tolerance, answers);
    const double alone = seconds_of(strutt_value(), tolerance, answers);
    const double by_hand = seconds_of(*best, best_tolerance, answers);
    value.push_back(alone / by_hand);
    estimate.push_back(with_estimate / alone);
  }
  const auto median = [](std::vector<double>& ratios) {
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<long>(ratios.size() / 2), ratios.end());
    return ratios[ratios.size() / 2];
  };
  state.SetLabel("best loop: " + best->name);
  state.counters["time_ratio"] = median(value);
  state.counters["price_of_estimate"] = median(estimate);
  state.counters["error"] = error;
  state.counters["loop_error"] = largest_error(answers, points());
}

/// A chart through compute_chart(), by wall clock: 64 x 64 points with error estimates.
void chart_on_threads(benchmark::State& state) {
  strutt::Scene scene;
  scene.mathieu.emplace();
  const strutt::ChartRequest request{
      .x = {.parameter = "mathieu.delta", .from = -1.0, .to = 5.0, .points = 64},
      .y = {.parameter = "mathieu.epsilon", .from = 0.0, .to = 6.0, .points = 64},
      .threads = static_cast<int>(state.range(0))};
  double sum = 0.0;
  const auto sink = [&sum](const strutt::ChartStrip& strip) { sum += strip.values[0][0]; };
  for (auto _ : state) strutt::compute_chart(scene, request, sink);
  benchmark::DoNotOptimize(sum);
  state.counters["points_per_s"] =
      benchmark::Counter(64.0 * 64.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(chart_on_threads)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

[[maybe_unused]] const bool kRegistered = [] {
  const auto add = [](const std::string& name, auto body) {
    benchmark::RegisterBenchmark(name.c_str(), body)->Unit(benchmark::kMillisecond);
  };
  for (const auto* target : {"1e-6", "1e-9", "1e-12"}) {
    const double tolerance = std::stod(target);
    const auto name = [target](const std::string& method) { return method + "/" + target; };
    const auto tuned = [&](const Contestant& c) {
      add(name(c.name), [&c, tolerance](benchmark::State& state) {
        run(state, c, tuned_tolerance(c, points(), tolerance));
      });
    };
    add(name("ratio_to_best_loop"),
        [tolerance](benchmark::State& state) { ratio_to_best_loop(state, tolerance); });
    for (const auto* engine : {&strutt_value(), &strutt_estimate()}) {
      add(name(engine->name + "_as_asked"),
          [engine, tolerance](benchmark::State& state) { run(state, *engine, tolerance); });
      tuned(*engine);
    }
    for (const auto& loop : loops()) tuned(loop);
    for (const auto& other : others()) tuned(other);
  }
  return true;
}();

}  // namespace
