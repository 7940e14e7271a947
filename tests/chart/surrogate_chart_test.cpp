// Charts by `Method::surrogate` against the same charts point by point with another integrator.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "strutt/base/error.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/verdict.hpp"
#include "strutt/io/scene_file.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::surrogate_chart_test {

namespace {

const std::vector<Layer> kAll{Layer::verdict,      Layer::growth, Layer::winding,
                              Layer::discriminant, Layer::margin, Layer::outcome};

Scene scene_of(const std::string& text) { return parse_scene(text, "scene").scene; }
Scene mathieu(double damping = 0.0) {
  Scene scene = scene_of("[mathieu]\nepsilon = 0.5\n");
  parameter(scene, "mathieu.damping") = damping;
  return scene;
}

ChartRequest request_of(std::size_t nx, std::size_t ny, double tolerance) {
  return {.x = {.parameter = "mathieu.delta", .from = -1.0, .to = 5.0, .points = nx},
          .y = {.parameter = "mathieu.epsilon", .from = 6.0, .to = 0.5, .points = ny},
          .layers = kAll,
          .tolerance = tolerance,
          .method = Method::surrogate};
}

struct Chart {
  ChartSummary summary;
  std::vector<std::vector<double>> layers;
};

Chart compute(const Scene& scene, const ChartRequest& request) {
  Chart chart;
  chart.layers.resize(request.layers.size());
  chart.summary = compute_chart(scene, request, [&](const ChartStrip& strip) {
    for (std::size_t l = 0; l < chart.layers.size(); ++l)
      chart.layers[l].insert(chart.layers[l].end(), strip.values[l].begin(), strip.values[l].end());
  });
  return chart;
}

bool same(const Chart& a, const Chart& b) {
  if (a.layers.size() != b.layers.size()) return false;
  for (std::size_t l = 0; l < a.layers.size(); ++l) {
    if (a.layers[l].size() != b.layers[l].size() ||
        std::memcmp(a.layers[l].data(), b.layers[l].data(), 8 * a.layers[l].size()) != 0)
      return false;
  }
  return true;
}

/// Cell by cell against the same chart by arkode. `deviation`: of margins and windings, scaled traces
/// likewise.
void check_against_arkode(const Scene& scene, ChartRequest request, double deviation) {
  const Chart chart = compute(scene, request);
  CHECK(chart.summary.interpolated == chart.summary.cells);
  CHECK(chart.summary.largest_error <= request.tolerance);
  request.method = Method::arkode;
  request.tolerance = std::max(0.01 * request.tolerance, 1e-12);
  const Chart exact = compute(scene, request);
  for (std::size_t cell = 0; cell < exact.layers[0].size(); ++cell) {
    INFO("x = " << request.x.value(cell % request.x.points)
                << ", y = " << request.y.value(cell / request.x.points));
    if (exact.layers[0][cell] != static_cast<double>(Verdict::unresolved))
      CHECK(chart.layers[0][cell] == exact.layers[0][cell]);
    const double size = std::exp(std::max(0.0, exact.layers[1][cell]));
    CHECK(std::abs(chart.layers[1][cell] - exact.layers[1][cell]) <= std::sqrt(deviation));
    CHECK(std::abs(chart.layers[2][cell] - exact.layers[2][cell]) <= std::sqrt(deviation));
    CHECK(std::abs(chart.layers[3][cell] - exact.layers[3][cell]) <= deviation * 100.0 * size);
    CHECK(std::abs(chart.layers[4][cell] - exact.layers[4][cell]) <= deviation * 100.0 * size);
    CHECK(chart.layers[5][cell] == static_cast<double>(Outcome::converged));
  }
}

}  // namespace

TEST_CASE("a chart by surrogate is the one point by point in every layer",
          "[chart][surrogate][stability_chart]") {
  check_against_arkode(mathieu(), request_of(61, 47, 1e-9), 1e-9);
  check_against_arkode(mathieu(0.3), request_of(61, 47, 1e-6), 1e-6);
}

TEST_CASE("a chart by surrogate over frequency and amplitude of a pendulum",
          "[chart][surrogate][stability_chart][slow]") {
  const Scene scene = scene_of(
      "[pendulum]\nlength = 0.7\ndamping = 0.2\nabout = \"inverted\"\n"
      "[support]\namplitude = 0.1\nfrequency = 12\nphase = 1\n");
  ChartRequest request = request_of(100, 50, 1e-8);
  request.x = {.parameter = "support.frequency",
               .from = 3.0,
               .to = 60.0,
               .points = 100,
               .scale = AxisScale::logarithmic};
  request.y = {.parameter = "support.amplitude", .from = 0.0, .to = 0.4, .points = 50};
  check_against_arkode(scene, request, 1e-8);
  request.y = {.parameter = "pendulum.damping", .from = 0.0, .to = 3.0, .points = 50};
  check_against_arkode(scene, request, 1e-8);
}

TEST_CASE("a chart by surrogate of a coefficient that is not even", "[chart][surrogate][stability_chart]") {
  const Scene skew = scene_of(
      "[hill]\nperiod = 1\nmean = 30\ndamping = 0.2\n"
      "harmonics = [{ order = 1, cos = 5 }, { order = 2, sin = 15 }]\n");
  ChartRequest request = request_of(80, 40, 1e-8);
  request.x = {.parameter = "hill.mean", .from = -20.0, .to = 100.0, .points = 80};
  request.y = {.parameter = "hill.harmonics.1.cos", .from = 0.0, .to = 40.0, .points = 40};
  check_against_arkode(skew, request, 1e-8);
}

TEST_CASE("a chart by surrogate of systems with two degrees of freedom",
          "[chart][surrogate][stability_chart][ratchet]") {
  const std::string damping = GENERATE("", "damping = { mean = [[0.2, 0], [0, 0.2]] }\n",
                                       "damping = { mean = [[0.2, 0.1], [-0.1, 0.3]] }\n");
  const Scene scene = scene_of("[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\n" + damping +
                               "stiffness = { mean = [[1, 0], [0, 3]], harmonics = [{ order = 1, cos = "
                               "[[0.4, 0.3], [0.3, 0.1]] }] }\n");
  ChartRequest request = request_of(60, 40, 1e-7);
  request.layers = {Layer::verdict, Layer::growth, Layer::discriminant, Layer::margin};
  request.x = {.parameter = "linear.stiffness.mean.0.0", .from = 0.5, .to = 4.0, .points = 60};
  request.y = {.parameter = "linear.stiffness.harmonics.1.cos.0.0", .from = 0.0, .to = 1.0, .points = 40};
  const Chart chart = compute(scene, request);
  CHECK(chart.summary.interpolated > 1800);
  request.method = Method::arkode;
  request.x.points = request.y.points = 2;  // the corners
  request.tolerance = 1e-9;
  const Chart exact = compute(scene, request);
  for (std::size_t cell = 0; cell < 4; ++cell) {
    const std::size_t corner = cell / 2 * 39 * 60 + cell % 2 * 59;
    INFO(damping << ", corner " << cell);
    if (chart.layers[0][corner] != 3.0 && exact.layers[0][cell] != 3.0)
      CHECK(chart.layers[0][corner] == exact.layers[0][cell]);
    const auto error = [&](int k) { return std::abs(chart.layers[k][corner] - exact.layers[k][cell]); };
    check_within("D of a system in a chart by surrogate", error(2), 1.5e-7);
    for (const int k : {1, 3}) check_within("growth and margin of a system by surrogate", error(k), 5e-7);
  }
}

TEST_CASE("the discriminant alone is that among other layers", "[chart][surrogate][stability_chart][simd]") {
  const double damping = GENERATE(0.0, 0.3);
  ChartRequest request = request_of(150, 100, 1e-8);
  const Chart all = compute(mathieu(damping), request);
  request.layers = {Layer::discriminant, Layer::outcome};
  const Chart one = compute(mathieu(damping), request);
  CHECK(one.summary.interpolated == one.summary.cells);
  for (std::size_t cell = 0; cell < one.layers[0].size(); ++cell) {
    INFO("cell " << cell);
    const double size = std::max(1.0, 0.5 * std::abs(all.layers[3][cell]));
    CHECK(std::abs(one.layers[0][cell] - all.layers[3][cell]) <=
          (one.summary.largest_error + all.summary.largest_error) * 4.0 * size);
    CHECK(one.layers[1][cell] == static_cast<double>(Outcome::converged));
  }
}

TEST_CASE("on wide damped charts cells that the discriminant cannot tell take their factors",
          "[chart][surrogate][stability_chart]") {
  // runs of |D| > 2 over more cells than factors are held for, with cells beside the damped edge in them
  Scene scene;
  scene.mathieu = MathieuTable{.damping = 0.2};
  ChartRequest request{.x = {.parameter = "mathieu.delta", .from = 0.23, .to = 0.28, .points = 601},
                       .y = {.parameter = "mathieu.epsilon", .from = 0.15, .to = 0.3, .points = 240},
                       .layers = {Layer::verdict, Layer::growth},
                       .tolerance = 1e-4,
                       .method = Method::surrogate,
                       .threads = 1};
  const std::size_t cells = request.x.points * request.y.points;
  const auto values_of = [&] {
    std::vector<std::vector<double>> values(2, std::vector<double>(cells));
    const std::vector<std::span<double>> places(values.begin(), values.end());
    compute_chart(scene, request, places);
    return values;
  };
  const auto by_surrogate = values_of();
  request.method = Method::propagator;
  request.tolerance = 1e-12;
  const auto point_by_point = values_of();
  std::size_t wrong = 0;
  double off = 0.0;
  for (std::size_t c = 0; c < cells; ++c) {
    wrong += by_surrogate[0][c] != point_by_point[0][c] ? 1 : 0;
    off = std::max(off, std::abs(by_surrogate[1][c] - point_by_point[1][c]));
  }
  CHECK(wrong == 0);
  CHECK(off < 1e-3);
}

TEST_CASE("windings are counted where the angle between tongues jumps",
          "[chart][surrogate][stability_chart][ratchet]") {
  ChartRequest request = request_of(300, 200, 1e-7);
  request.x.from = -30.0;
  request.x.to = 60.0;
  request.y.from = 0.0;
  request.y.to = 50.0;
  const Chart chart = compute(mathieu(), request);
  CHECK(chart.summary.interpolated > 50000);
  request.method = Method::propagator;
  const Chart exact = compute(mathieu(), request);
  for (std::size_t cell = 0; cell < exact.layers[0].size(); ++cell) {
    INFO("cell " << cell);
    check_within("winding where the angle between tongues jumps",
                 std::abs(chart.layers[2][cell] - exact.layers[2][cell]), 3e-8);
  }
}

TEST_CASE("windings are counted between cells that are tongues apart",
          "[chart][surrogate][stability_chart][ratchet]") {
  ChartRequest request = request_of(30, 2000, 1e-6);
  request.layers = {Layer::winding};
  request.x.from = 0.0;
  request.x.to = 900.0;  // two to eight quarter turns a column
  request.y.from = 0.0;
  request.y.to = 1.0;
  const Chart chart = compute(mathieu(), request);
  CHECK(chart.summary.interpolated > 50'000);
  request.method = Method::propagator;
  request.y.points = 2;
  const Chart exact = compute(mathieu(), request);
  for (std::size_t cell = 0; cell < 60; ++cell) {  // of the first and the last row
    const std::size_t far = cell < 30 ? cell : cell + 1998 * 30;
    check_within("winding between cells that are tongues apart",
                 std::abs(chart.layers[0][far] - exact.layers[0][cell]), 1e-4);
  }
}

TEST_CASE("a chart by surrogate has the same bits for any number of threads",
          "[chart][surrogate][stability_chart][threads][extreme][N48]") {
  ChartRequest request = request_of(300, 250, 1e-10);
  request.threads = 1;
  const Chart one = compute(mathieu(0.1), request);
  CHECK(one.summary.interpolated > 0);
  for (const int threads : {2, 5}) {
    request.threads = threads;
    const Chart many = compute(mathieu(0.1), request);
    CHECK(same(one, many));
    CHECK(many.summary.largest_error == one.summary.largest_error);
    CHECK(many.summary.interpolated == one.summary.interpolated);
  }
}

TEST_CASE("a chart without a surrogate is computed point by point and says why",
          "[chart][surrogate][stability_chart]") {
  const Scene square = scene_of("[hill]\nperiod = 1\nwaveform = \"square\"\namplitude = 0.5\n");
  ChartRequest request = request_of(20, 20, 1e-6);
  request.x = {.parameter = "hill.mean", .from = 0.0, .to = 1.0, .points = 20};
  request.y = {.parameter = "hill.amplitude", .from = 0.0, .to = 1.0, .points = 20};
  const ChartPlan plan = plan_chart(square, request);
  CHECK(plan.method == Method::exact);
  CHECK_THAT(plan.refusal, Catch::Matchers::Contains("not smooth"));
  const Chart chart = compute(square, request);
  CHECK(chart.summary.interpolated == 0);
  CHECK_FALSE(chart.summary.surrogate);
  request.method = Method::automatic;
  CHECK(same(chart, compute(square, request)));
}

TEST_CASE("cells that a surrogate cannot answer for are computed point by point",
          "[chart][surrogate][stability_chart]") {
  // at 1e-13 the rounding of the nodes alone is above the tolerance
  ChartRequest request = request_of(40, 30, 1e-13);
  const Chart chart = compute(mathieu(), request);
  CHECK(chart.summary.interpolated == 0);
  request.method = Method::automatic;
  CHECK(same(chart, compute(mathieu(), request)));
  // an edge of a tongue on a column: delta = 1/4, epsilon = 0
  request = request_of(41, 21, 1e-9);
  request.x.from = 0.0;
  request.x.to = 1.0;
  request.y = {.parameter = "mathieu.epsilon", .from = 0.0, .to = 1.0, .points = 21};
  const Chart edge = compute(mathieu(), request);
  CHECK(edge.layers[0][10] == static_cast<double>(Verdict::boundary));
  CHECK(edge.summary.interpolated < edge.summary.cells);
}

TEST_CASE("a chart goes straight into arrays of the caller", "[chart][stability_chart]") {
  ChartRequest request = request_of(230, 300, 1e-6);  // more than one strip
  request.method = GENERATE(Method::propagator, Method::surrogate);
  const Chart strips = compute(mathieu(), request);
  Chart whole;
  whole.layers.assign(kAll.size(), std::vector<double>(230 * 300, -1.0));
  std::vector<std::span<double>> arrays(whole.layers.begin(), whole.layers.end());
  const auto summary = compute_chart(mathieu(), request, arrays);
  CHECK(same(whole, strips));
  CHECK(summary.methods == strips.summary.methods);
  CHECK_THROWS_AS(compute_chart(mathieu(), request, std::span(arrays).first(5)), InvalidInput);
  arrays[3] = arrays[3].first(100);
  CHECK_THROWS_AS(compute_chart(mathieu(), request, arrays), InvalidInput);
}

TEST_CASE("growth beyond the range of double does not end a surrogate",
          "[chart][surrogate][stability_chart][ratchet]") {
  ChartRequest request = request_of(200, 200, 1e-7);
  request.x.from = -2020.0;
  request.x.to = -2000.0;
  request.y.from = 0.0;
  request.y.to = 1.0;
  const Chart chart = compute(mathieu(0.5), request);
  CHECK(chart.summary.interpolated > 35'000);
  request.method = Method::propagator;
  request.x.points = request.y.points = 3;
  const Chart exact = compute(mathieu(0.5), request);
  for (std::size_t cell = 0; cell < 9; ++cell) {
    if (cell % 3 == 1 || cell / 3 == 1) continue;  // only the corners are the same points
    const std::size_t corner = (cell < 3 ? 0 : 199 * 200) + (cell % 3 == 0 ? 0 : 199);
    INFO("corner " << corner);
    check_close("growth of up to exp(282) in a chart by surrogate (relative)", chart.layers[1][corner],
                exact.layers[1][cell], 6e-11);
    CHECK(chart.layers[0][corner] == static_cast<double>(Verdict::unstable));
    CHECK(chart.layers[2][corner] == 0.0);
    check_close("margin of growth up to exp(282) in a chart by surrogate (relative)", chart.layers[3][corner],
                exact.layers[3][cell], 1.5e-8);
  }
}

TEST_CASE("a surrogate chart is cancelled while it is built",
          "[chart][surrogate][stability_chart][threads]") {
  const std::atomic<bool> cancel{true};
  ChartRequest request = request_of(100, 100, 1e-9);
  request.cancel = &cancel;
  request.threads = 2;
  CHECK(compute_chart(mathieu(), request, [](const ChartStrip&) { FAIL("a strip"); }).cancelled);
}

}  // namespace strutt::test::surrogate_chart_test
