// What a plan expects against what it takes, one thread: the constants of src/chart/cost_table.hpp.
//   expected_s    time that plan_chart expects
//   to_expected   median processor time of compute_chart by that
//   expected_cell, cell_s   the same for one cell
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "strutt/chart/stability_chart.hpp"
#include "strutt/io/scene_file.hpp"

namespace {

using strutt::AxisScale;
using strutt::Layer;
using strutt::Method;

strutt::Scene scene_of(const char* text) { return strutt::parse_scene(text, "scene").scene; }

const char* const kMathieu = "[mathieu]\n";
const char* const kMeissner = "[hill]\nperiod = 6\nmean = 1\nwaveform = \"square\"\namplitude = 0.5\n";
const char* const kSkew =
    "[hill]\nperiod = 1\nmean = 30\nharmonics = [{ order = 1, cos = 5 }, { order = 2, sin = 15 }]\n";
const char* const kRod = "[pendulum]\nlength = 1\n[support]\namplitude = 0.1\nfrequency = 12\n";
const char* const kCoupled =
    "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\nstiffness = { mean = [[1, 0], [0, 3]], harmonics = [{ "
    "order = 1, cos = [[0.4, 0.3], [0.3, 0.1]] }] }\n";
const char* const kGyroscopic =
    "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\ndamping = { mean = [[0.2, 0.1], [-0.1, 0.3]] "
    "}\nstiffness "
    "= { mean = [[1, 0], [0, 3]], harmonics = [{ order = 1, cos = [[0.4, 0.3], [0.3, 0.1]] }] }\n";

struct Place {
  const char* scene;
  strutt::Axis x, y;
};
const Place kNear{kMathieu, {"mathieu.delta", -1.0, 5.0}, {"mathieu.epsilon", 0.0, 6.0}};
const Place kFar{kMathieu, {"mathieu.delta", -50.0, 200.0}, {"mathieu.epsilon", 0.0, 200.0}};
const Place kJumps{kMeissner, {"hill.mean", -1.0, 3.0}, {"hill.amplitude", 0.0, 3.0}};
const Place kUneven{kSkew, {"hill.mean", -20.0, 100.0}, {"hill.harmonics.1.cos", 0.0, 40.0}};
const Place kPendulum{kRod, {"support.frequency", 2.0, 40.0}, {"support.amplitude", 0.0, 0.3}};
const Place kPair{
    kCoupled, {"linear.stiffness.mean.0.0", 0.5, 4.0}, {"linear.stiffness.harmonics.1.cos.0.0", 0.0, 1.0}};
const Place kGyro{
    kGyroscopic, {"linear.stiffness.mean.0.0", 0.5, 4.0}, {"linear.stiffness.harmonics.1.cos.0.0", 0.0, 1.0}};

void plan(benchmark::State& state, const Place& place, Method method, std::vector<Layer> layers,
          double tolerance) {
  strutt::ChartRequest request{.x = place.x,
                               .y = place.y,
                               .layers = std::move(layers),
                               .tolerance = tolerance,
                               .method = method,
                               .threads = 1};
  request.x.points = request.y.points = static_cast<std::size_t>(state.range(0));
  const auto scene = scene_of(place.scene);
  const auto expected = strutt::plan_chart(scene, request).expected_seconds;
  std::vector<double> seconds;
  for (auto _ : state) {
    const auto begin = std::clock();
    strutt::compute_chart(scene, request, [](const strutt::ChartStrip&) {});
    seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::sort(seconds.begin(), seconds.end());
  const double median = seconds[seconds.size() / 2];
  const auto cells = static_cast<double>(request.x.points * request.y.points);
  state.counters["expected_s"] = expected;
  state.counters["to_expected"] = median / expected;
  state.counters["expected_cell"] = expected / cells;
  state.counters["cell_s"] = median / cells;
}

const std::vector<Layer> kVerdict{Layer::verdict, Layer::growth};
const std::vector<Layer> kTrace{Layer::discriminant};
const std::vector<Layer> kAll{Layer::verdict, Layer::growth, Layer::winding, Layer::discriminant,
                              Layer::margin};

BENCHMARK_CAPTURE(plan, near_points, kNear, Method::propagator, kVerdict, 1e-9)->Arg(400);
BENCHMARK_CAPTURE(plan, near_points_12, kNear, Method::propagator, kVerdict, 1e-12)->Arg(400);
BENCHMARK_CAPTURE(plan, near_points_winding, kNear, Method::propagator, {Layer::winding}, 1e-9)->Arg(400);
BENCHMARK_CAPTURE(plan, near_points_trace, kNear, Method::propagator, kTrace, 1e-9)->Arg(400);
BENCHMARK_CAPTURE(plan, near_points_all, kNear, Method::propagator, kAll, 1e-9)->Arg(400);
BENCHMARK_CAPTURE(plan, far_points, kFar, Method::propagator, kVerdict, 1e-9)->Arg(400);
BENCHMARK_CAPTURE(plan, meissner_points, kJumps, Method::exact, kVerdict, 1e-9)->Arg(400);
BENCHMARK_CAPTURE(plan, uneven_points, kUneven, Method::propagator, kVerdict, 1e-9)->Arg(400);
BENCHMARK_CAPTURE(plan, pair_points, kPair, Method::propagator, kVerdict, 1e-8)->Arg(150);
BENCHMARK_CAPTURE(plan, pair_points_trace, kPair, Method::propagator, kTrace, 1e-8)->Arg(150);
BENCHMARK_CAPTURE(plan, gyro_points, kGyro, Method::propagator, kVerdict, 1e-8)->Arg(150);
BENCHMARK_CAPTURE(plan, near_arkode, kNear, Method::arkode, kVerdict, 1e-9)->Arg(40);
BENCHMARK_CAPTURE(plan, near_cvode, kNear, Method::cvode, kVerdict, 1e-6)->Arg(16);
BENCHMARK_CAPTURE(plan, pair_arkode, kPair, Method::arkode, kVerdict, 1e-8)->Arg(40);
BENCHMARK_CAPTURE(plan, pair_cvode, kPair, Method::cvode, kVerdict, 1e-8)->Arg(16);
BENCHMARK_CAPTURE(plan, near_surrogate, kNear, Method::surrogate, kVerdict, 1e-10)->Arg(100)->Arg(4096);
BENCHMARK_CAPTURE(plan, near_surrogate_trace, kNear, Method::surrogate, kTrace, 1e-10)->Arg(4096);
BENCHMARK_CAPTURE(plan, near_surrogate_all, kNear, Method::surrogate, kAll, 1e-10)->Arg(2048);
BENCHMARK_CAPTURE(plan, far_surrogate, kFar, Method::surrogate, kVerdict, 1e-9)->Arg(1000);
BENCHMARK_CAPTURE(plan, rod_surrogate, kPendulum, Method::surrogate, kVerdict, 1e-9)->Arg(300)->Arg(1000);
BENCHMARK_CAPTURE(plan, uneven_surrogate, kUneven, Method::surrogate, kVerdict, 1e-8)->Arg(400);
BENCHMARK_CAPTURE(plan, pair_surrogate, kPair, Method::surrogate, kVerdict, 1e-8)->Arg(800);
BENCHMARK_CAPTURE(plan, gyro_surrogate, kGyro, Method::surrogate, kVerdict, 1e-8)->Arg(200);

}  // namespace
