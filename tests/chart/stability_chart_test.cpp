#include "strutt/chart/stability_chart.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>

#include "io/scratch.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "strutt/io/scene_file.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::stability_chart_test {

namespace {

const std::vector<Layer> kAll{Layer::verdict,      Layer::growth, Layer::winding,
                              Layer::discriminant, Layer::margin, Layer::outcome};

Scene mathieu() { return parse_scene("[mathieu]\nepsilon = 0.5\ndamping = 0.1\n", "scene").scene; }

Scene coupled() {
  return parse_scene(
             "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\n"
             "stiffness = { mean = [[1, 0], [0, 2]] }\n",
             "scene")
      .scene;
}

ChartRequest request_of(std::size_t nx, std::size_t ny, std::vector<Layer> layers = kAll) {
  return {.x = {.parameter = "mathieu.delta", .from = -1.0, .to = 5.0, .points = nx},
          .y = {.parameter = "mathieu.epsilon", .from = 3.0, .to = 0.5, .points = ny},
          .layers = std::move(layers),
          .tolerance = 1e-6};
}

/// The whole chart in memory, layer by layer; strips must come in order and without gaps.
struct Chart {
  ChartSummary summary;
  std::vector<std::vector<double>> layers;
  std::size_t rows = 0;
};

Chart compute(const Scene& scene, const ChartRequest& request) {
  Chart chart;
  chart.layers.resize(request.layers.size());
  chart.summary = compute_chart(scene, request, [&](const ChartStrip& strip) {
    REQUIRE(strip.first_row == chart.rows);
    REQUIRE(strip.columns == request.x.points);
    REQUIRE(strip.values.size() == request.layers.size());
    for (std::size_t l = 0; l < chart.layers.size(); ++l) {
      const auto& values = strip.values[l];
      chart.layers[l].insert(chart.layers[l].end(), values.begin(),
                             values.begin() + static_cast<std::ptrdiff_t>(strip.rows * strip.columns));
    }
    chart.rows += strip.rows;
  });
  return chart;
}

/// Equal as bits are, NaN too.
bool same(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t l = 0; l < a.size(); ++l) {
    if (a[l].size() != b[l].size() || std::memcmp(a[l].data(), b[l].data(), 8 * a[l].size()) != 0)
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("a chart is what its points are one by one, in every layer", "[chart][stability_chart]") {
  const Scene scene = mathieu();
  const ChartRequest request = request_of(7, 4);
  const Chart chart = compute(scene, request);
  REQUIRE(chart.rows == 4);
  CHECK(chart.summary.cells == 28);
  MonodromyEngine engine;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 7; ++i) {
      Scene point = scene;
      parameter(point, "mathieu.delta") = request.x.value(i);
      parameter(point, "mathieu.epsilon") = request.y.value(j);
      const Stability s = analyse(engine, linear_model(point), {.tolerance = 1e-6});
      const std::size_t cell = 7 * j + i;
      INFO("row " << j << ", column " << i);
      CHECK(chart.layers[0][cell] == static_cast<double>(s.verdict));
      CHECK(chart.layers[1][cell] == s.growth);
      CHECK(chart.layers[2][cell] == s.winding);
      CHECK(chart.layers[3][cell] == s.discriminant);
      CHECK(chart.layers[4][cell] == s.margin);
      CHECK(chart.layers[5][cell] == static_cast<double>(s.outcome));
    }
  }
}

TEST_CASE("a chart of the constant coefficient is the closed form", "[chart][stability_chart][ratchet]") {
  // x'' + c x' + delta x: trace = 2 exp(-cT/2) cos(T sqrt(delta - c^2/4)), T = 2 pi.
  ChartRequest request = request_of(9, 2, {Layer::discriminant, Layer::growth});
  request.x.from = 0.2;
  request.y = {.parameter = "mathieu.damping", .from = 0.0, .to = 0.5, .points = 2};
  Scene scene = mathieu();
  parameter(scene, "mathieu.epsilon") = 0.0;
  const Chart chart = compute(scene, request);
  constexpr double T = 2.0 * std::numbers::pi;
  for (std::size_t cell = 0; cell < 18; ++cell) {
    const double delta = request.x.value(cell % 9), c = cell < 9 ? 0.0 : 0.5;
    const double trace = 2.0 * std::exp(-c * T / 2.0) * std::cos(T * std::sqrt(delta - c * c / 4.0));
    check_within("D in a chart of constant coefficients", std::abs(chart.layers[0][cell] - trace), 5e-15);
    check_within("growth in a chart of constant coefficients", std::abs(chart.layers[1][cell] - -c * T / 2.0),
                 8e-16);
  }
}

TEST_CASE("a layer alone is the same as among the others", "[chart][stability_chart]") {
  const Chart all = compute(mathieu(), request_of(5, 3));
  for (std::size_t l = 0; l < kAll.size(); ++l) {
    const Chart one = compute(mathieu(), request_of(5, 3, {kAll[l]}));
    INFO(to_string(kAll[l]));
    CHECK(same(one.layers, {all.layers[l]}));
    CHECK(one.summary.unresolved == (kAll[l] == Layer::verdict ? all.summary.unresolved : 0));
  }
}

TEST_CASE("all layers of a cell come from one integration", "[chart][stability_chart]") {
  const auto cost = [](std::vector<Layer> layers) {
    return compute(mathieu(), request_of(5, 3, std::move(layers))).summary.right_hand_sides;
  };
  const long verdict = cost({Layer::verdict});
  CHECK(verdict > 0);
  CHECK(cost(kAll) == verdict);
  const auto bytes = [](std::vector<Layer> layers) {
    return plan_chart(mathieu(), request_of(50, 30, std::move(layers))).result_bytes;
  };
  CHECK(bytes(kAll) - bytes({Layer::verdict}) == 8.0 * 5 * 1500);
}

TEST_CASE("a chart has the same bits for any number of threads",
          "[chart][stability_chart][threads][extreme][N48]") {
  ChartRequest request = request_of(17, 6);
  request.threads = 1;
  const Chart one = compute(mathieu(), request);
  for (const int threads : {2, 5}) {
    request.threads = threads;
    const Chart many = compute(mathieu(), request);
    INFO(threads);
    CHECK(same(many.layers, one.layers));
    CHECK(many.summary.right_hand_sides == one.summary.right_hand_sides);
    CHECK(many.summary.largest_error == one.summary.largest_error);
  }
}

TEST_CASE("a cell that fails says so and the rest goes on", "[chart][stability_chart]") {
  // The middle column has no mass: no equation of motion is left.
  ChartRequest request{.x = {.parameter = "linear.mass.0.0", .from = -1.0, .to = 1.0, .points = 3},
                       .y = {.parameter = "linear.period", .from = 1.0, .to = 2.0, .points = 2},
                       .layers = {Layer::verdict, Layer::growth, Layer::outcome, Layer::margin}};
  const Chart chart = compute(coupled(), request);
  for (std::size_t cell = 0; cell < 6; ++cell) {
    const bool fails = cell % 3 == 1;
    CHECK((chart.layers[0][cell] == static_cast<double>(Verdict::unresolved)) == fails);
    CHECK(std::isnan(chart.layers[1][cell]) == fails);
    CHECK(chart.layers[2][cell] == static_cast<double>(fails ? Outcome::failed : Outcome::converged));
    CHECK(std::isnan(chart.layers[3][cell]) == fails);
  }
  CHECK(chart.summary.unresolved == 2);
  CHECK(chart.summary.outcomes[static_cast<std::size_t>(Outcome::failed)] == 2);
  CHECK(chart.summary.outcomes[static_cast<std::size_t>(Outcome::converged)] == 4);
}

TEST_CASE("beyond 1e300 the discriminant is infinite and growth is not",
          "[chart][stability_chart][extreme][N01][ratchet]") {
  ChartRequest request = request_of(2, 1, {Layer::discriminant, Layer::growth, Layer::verdict});
  request.x = {.parameter = "mathieu.delta", .from = -4e4, .to = -1e4, .points = 2};
  request.y = {.parameter = "mathieu.epsilon", .from = 0.0, .to = 0.0, .points = 1};
  Scene scene = mathieu();
  parameter(scene, "mathieu.damping") = 0.0;
  const Chart chart = compute(scene, request);
  CHECK(chart.layers[0][0] == std::numeric_limits<double>::infinity());
  check_close("N01 growth in a chart beyond 1e300 (relative)", chart.layers[1][0],
              2.0 * std::numbers::pi * 200.0, 8e-16);
  CHECK(chart.layers[2][0] == static_cast<double>(Verdict::unstable));
  check_close("N01 D in a chart up to exp(628) (relative)", chart.layers[0][1],
              2.0 * std::cosh(2.0 * std::numbers::pi * 100.0), 5e-14);
}

TEST_CASE("cancelling ends a chart between strips and is reported", "[chart][stability_chart][threads]") {
  std::atomic<bool> cancel{false};
  ChartRequest request = request_of(400, 400, {Layer::verdict});
  request.cancel = &cancel;
  request.threads = 2;
  request.method = Method::propagator;
  bool strip_seen = false;
  std::size_t last = 0;
  const ChartSummary summary = compute_chart(
      mathieu(), request, [&](const ChartStrip&) { strip_seen = true; },
      [&](std::size_t done, std::size_t total) {
        CHECK(total == 160'000);
        CHECK(done > last);
        last = done;
        cancel = true;
      });
  CHECK(summary.cancelled);
  CHECK_FALSE(strip_seen);
  CHECK(summary.cells == last);
  CHECK(summary.cells < 160'000);
}

TEST_CASE("progress rises to the number of cells", "[chart][stability_chart]") {
  ChartRequest slow = request_of(40, 5, {Layer::growth});
  slow.threads = 2;  // batches begin small
  std::vector<std::size_t> seen;
  compute_chart(
      mathieu(), slow, [](const ChartStrip&) {},
      [&](std::size_t done, std::size_t total) {
        CHECK(total == 200);
        seen.push_back(done);
      });
  REQUIRE(seen.size() > 1);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
  CHECK(seen.front() < 200);
  CHECK(seen.back() == 200);
}

TEST_CASE("an exception of the sink passes through", "[chart][stability_chart]") {
  struct Stop {};
  CHECK_THROWS_AS(compute_chart(mathieu(), request_of(3, 2), [](const ChartStrip&) { throw Stop{}; }), Stop);
}

TEST_CASE("the plan counts before anything is computed", "[chart][stability_chart][plan]") {
  const ChartPlan plan = plan_chart(mathieu(), request_of(30, 20, {Layer::verdict, Layer::growth}));
  CHECK(plan.cells == 600);
  CHECK(plan.result_bytes == 8.0 * (2 * 600 + 50));
  CHECK(plan.method == Method::propagator);
  CHECK(plan.expected_seconds > 0.0);
}

TEST_CASE("working memory does not grow with the number of rows",
          "[chart][stability_chart][plan][extreme][N42]") {
  const auto working = [](std::size_t rows) {
    return plan_chart(mathieu(), request_of(1000, rows)).working_bytes;
  };
  CHECK(working(100'000) == working(1000));
  CHECK(working(100'000) < 1e7);
  // What compute_chart hands out is as high as the plan said.
  ChartRequest request{.x = {.parameter = "hill.mean", .from = 1.0, .to = 2.0, .points = 30'000},
                       .y = {.parameter = "hill.amplitude", .from = 0.0, .to = 1.0, .points = 5},
                       .layers = {Layer::verdict}};
  const Scene meissner = parse_scene("[hill]\nperiod = 6\nwaveform = \"square\"\n", "scene").scene;
  const std::size_t high = plan_chart(meissner, request).rows_per_strip;
  CHECK(high == 2);
  std::vector<std::size_t> rows;
  compute_chart(meissner, request, [&](const ChartStrip& strip) { rows.push_back(strip.rows); });
  CHECK(rows == std::vector<std::size_t>{2, 2, 1});
}

TEST_CASE("a chart over the memory budget is refused unless forced",
          "[chart][stability_chart][plan][extreme][N41][N42]") {
  ChartRequest request = request_of(1'000'000, 1'000'000);
  const std::string message = test::message_of<MemoryBudgetExceeded>([&] { plan_chart(mathieu(), request); });
  CHECK(message.find("1000000 x 1000000") != std::string::npos);
  CHECK(message.find("budget of") != std::string::npos);
  request.force = true;
  CHECK(plan_chart(mathieu(), request).cells == 1'000'000'000'000);
  request.x.points = request.y.points = std::size_t{1} << 53;
  CHECK_THROWS_AS(plan_chart(mathieu(), request),
                  MemoryBudgetExceeded);  // force or not, it cannot be counted
}

TEST_CASE("requests that make no sense name what is wrong", "[chart][stability_chart][plan]") {
  const auto refusal = [](const auto& change) {
    ChartRequest request = request_of(3, 2);
    change(request);
    return test::message_of<InvalidInput>([&] { plan_chart(mathieu(), request); });
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(refusal([](auto& r) { r.x.parameter = "mathieu.dleta"; }), "'mathieu.delta'"));
  CHECK(has(refusal([](auto& r) { r.y.parameter = r.x.parameter; }), "different"));
  CHECK(has(refusal([](auto& r) { r.layers.clear(); }), "at least one"));
  CHECK(has(refusal([](auto& r) { r.layers = {Layer::growth, Layer::growth}; }), "growth"));
  CHECK(has(refusal([](auto& r) { r.tolerance = 0.0; }), "tolerance"));
  CHECK(has(refusal([](auto& r) { r.method = Method::exact; }), "piecewise-constant"));
  CHECK(has(refusal([](auto& r) { r.y = {"mathieu.damping", -1.0, 1.0, 3, AxisScale::linear}; }), ">= 0"));
}

TEST_CASE("layers have names, units and kinds", "[chart][stability_chart]") {
  for (const Layer layer : kAll) {
    CHECK(layer_from_string(to_string(layer)) == layer);
    const bool words = layer == Layer::verdict || layer == Layer::outcome;
    CHECK(is_categorical(layer) == words);
    CHECK(unit_of(layer) == (words ? "" : "1"));
  }
  CHECK_THROWS_AS(layer_from_string("Verdict"), InvalidInput);
}

}  // namespace strutt::test::stability_chart_test
