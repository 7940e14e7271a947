#include "strutt/chart/forecast.hpp"

#include <catch2/catch.hpp>

#include "strutt/base/error.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt::test::forecast_test {

namespace {

Scene scene_of(const std::string& text) { return parse_scene(text, "scene").scene; }

const std::string kMathieu = "[mathieu]\nepsilon = 0.5\n";
const std::string kRod = "[pendulum]\nlength = 1\n[support]\namplitude = 0.1\nfrequency = 12\n";
const std::string kCoupled =
    "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\nstiffness = { mean = [[1, 0], [0, 3]], harmonics = [{ "
    "order = 1, cos = [[0.4, 0.3], [0.3, 0.1]] }] }\n";
const std::string kMeissner = "[hill]\nperiod = 1\nwaveform = \"square\"\namplitude = 0.5\n";

ChartRequest request_of(Axis x, Axis y, std::size_t points, double tolerance) {
  x.points = y.points = points;
  return {.x = x, .y = y, .layers = {Layer::verdict, Layer::growth}, .tolerance = tolerance};
}

ChartRequest near(std::size_t points, double tolerance) {
  return request_of({"mathieu.delta", -1.0, 5.0}, {"mathieu.epsilon", 0.0, 6.0}, points, tolerance);
}

ChartRequest pair(std::size_t points, double tolerance) {
  return request_of({"linear.stiffness.mean.0.0", 0.5, 4.0},
                    {"linear.stiffness.harmonics.1.cos.0.0", 0.0, 1.0}, points, tolerance);
}

}  // namespace

TEST_CASE("the forecast of a point counts what the engine does", "[chart][plan]") {
  const auto tolerance = GENERATE(1e-4, 1e-9, 1e-13);
  for (const auto& text : {kMathieu, kRod, kCoupled}) {
    const auto model = linear_model(scene_of(text));
    const auto point = forecast_point(model, {.tolerance = tolerance});
    MonodromyEngine engine;
    const auto done = analyse(engine, model, {.tolerance = tolerance});
    INFO(text << "at " << tolerance);
    CHECK(point.method == Method::propagator);
    CHECK(point.steps == static_cast<double>(done.cost.steps));
    CHECK(point.right_hand_sides == static_cast<double>(done.cost.right_hand_sides));
    CHECK(point.order >= 4);
    CHECK(point.order % 2 == 0);
    CHECK(point.seconds > 0.0);
  }
}

TEST_CASE("the order in a forecast is that of the propagator", "[chart][plan]") {
  // one step of order p of a system takes p (p + 1)/2 products
  const auto point = forecast_point(linear_model(scene_of(kCoupled)), {.tolerance = 1e-6});
  CHECK(0.5 * point.order * (point.order + 1) * point.steps == Approx(point.right_hand_sides));
  // one of a Hill equation with K terms has order 2 K - 4
  const auto hill = forecast_point(linear_model(scene_of(kMathieu)), {.tolerance = 1e-6});
  CHECK(0.5 * (hill.order + 4) * hill.steps == Approx(hill.right_hand_sides));
}

TEST_CASE("evaluations of ARKODE are forecast within a factor of two, of CVODE of three", "[chart][plan]") {
  const auto [method, factor] = GENERATE(std::pair{Method::arkode, 2.0}, std::pair{Method::cvode, 3.0});
  for (const auto& text : {kMathieu, std::string("[mathieu]\ndelta = 400\nepsilon = 30\n"), kCoupled}) {
    for (const double tolerance : {1e-6, 1e-9}) {
      const MonodromyOptions options{.tolerance = tolerance, .method = method};
      const auto model = linear_model(scene_of(text));
      const auto point = forecast_point(model, options);
      MonodromyEngine engine;
      const auto done = analyse(engine, model, options);
      const auto counted =
          static_cast<double>(done.cost.right_hand_sides + done.estimate_cost.right_hand_sides);
      INFO(text << to_string(method) << " at " << tolerance << ": " << counted << " evaluations");
      CHECK(point.right_hand_sides > counted / factor);
      CHECK(point.right_hand_sides < factor * counted);
      CHECK(point.order == 0);
    }
  }
}

TEST_CASE("boxes, degrees and nodes of a surrogate are as forecast", "[chart][plan][surrogate][slow]") {
  const auto compare = [](const std::string& text, const ChartRequest& request) {
    const Scene scene = scene_of(text);
    ChartRequest asked = request;
    asked.method = Method::surrogate;
    const auto plan = plan_chart(scene, asked);
    REQUIRE(plan.surrogate);
    const Surrogate built(scene, request.x, request.y, {.tolerance = request.tolerance});
    const auto& report = built.report();
    INFO(text << report.boxes << " boxes of degrees up to " << report.highest_degree << ", " << report.nodes
              << " nodes; forecast " << plan.surrogate->boxes << ", " << plan.surrogate->highest_degree
              << ", " << plan.surrogate->nodes);
    const auto close = [](double forecast, double done) {
      return forecast <= 1.5 * done && done <= 1.5 * forecast;
    };
    CHECK(close(static_cast<double>(plan.surrogate->boxes), static_cast<double>(report.boxes)));
    CHECK(close(plan.surrogate->nodes, static_cast<double>(report.nodes)));
    CHECK(close(plan.surrogate->highest_degree, report.highest_degree));
    CHECK(close(plan.surrogate->right_hand_sides * plan.surrogate->nodes,
                static_cast<double>(report.right_hand_sides)));
  };
  compare(kMathieu, near(300, 1e-6));
  compare(kMathieu, near(300, 1e-10));
  compare(kMathieu, request_of({"mathieu.delta", -50.0, 200.0}, {"mathieu.epsilon", 0.0, 200.0}, 2000, 1e-9));
  compare(kRod, request_of({"support.frequency", 2.0, 40.0}, {"support.amplitude", 0.0, 0.3}, 500, 1e-9));
  compare(kRod, request_of({"support.frequency", 1.0, 40.0, 2, AxisScale::logarithmic},
                           {"pendulum.damping", 0.0, 3.0}, 500, 1e-7));
  compare(kCoupled, pair(300, 1e-8));
}

TEST_CASE("auto takes the surrogate where it is cheaper, and says why where it is not",
          "[chart][plan][surrogate]") {
  const auto plan = [](const std::string& text, const ChartRequest& request) {
    return plan_chart(scene_of(text), request);
  };
  const auto big = plan(kMathieu, near(1000, 1e-9));
  CHECK(big.method == Method::surrogate);
  CHECK(big.refusal.empty());
  ChartRequest points = near(1000, 1e-9);
  points.method = Method::propagator;
  CHECK(big.expected_seconds < 0.5 * plan(kMathieu, points).expected_seconds);
  CHECK(plan(kCoupled, pair(300, 1e-8)).method == Method::surrogate);

  const auto small = plan(kMathieu, near(40, 1e-9));
  CHECK(small.method == Method::propagator);
  CHECK(small.refusal == "the chart is small");
  const auto exact =
      plan(kMeissner, request_of({"hill.mean", 0.0, 1.0}, {"hill.amplitude", 0.0, 1.0}, 1000, 1e-9));
  CHECK(exact.method == Method::exact);
  CHECK_THAT(exact.refusal, Catch::Matchers::Contains("not smooth"));
  const auto tight = plan(kMathieu, near(1000, 1e-13));  // rounding alone is more
  CHECK(tight.method == Method::propagator);
  CHECK_THAT(tight.refusal, Catch::Matchers::Contains("no box"));
  // a steep corner of a chart with few cells: hardly any box is worth its nodes
  const auto few = plan(
      kMathieu, request_of({"mathieu.delta", -5000.0, 5000.0}, {"mathieu.epsilon", 0.0, 5000.0}, 150, 1e-10));
  CHECK(few.method == Method::propagator);
  CHECK_FALSE(few.refusal.empty());
  CHECK(plan(kMathieu, points).refusal.empty());
}

TEST_CASE("a plan is the same every time and for any number of threads", "[chart][plan][threads]") {
  ChartRequest request = near(700, 1e-10);
  request.threads = 1;
  const auto one = plan_chart(scene_of(kMathieu), request);
  request.threads = 4;
  const auto four = plan_chart(scene_of(kMathieu), request);
  CHECK(one.method == four.method);
  CHECK(one.surrogate->nodes == four.surrogate->nodes);
  CHECK(one.surrogate->multiply_adds == four.surrogate->multiply_adds);
  CHECK(one.expected_seconds == 4.0 * four.expected_seconds);
  CHECK(one.working_bytes == four.working_bytes);
}

TEST_CASE("a chart by auto is the one by the method that its plan names", "[chart][plan][surrogate]") {
  ChartRequest request = near(200, 1e-8);
  const auto chart = [&](Method method) {
    request.method = method;
    std::vector<double> values;
    const auto summary = compute_chart(scene_of(kMathieu), request, [&](const ChartStrip& strip) {
      for (const auto& layer : strip.values) values.insert(values.end(), layer.begin(), layer.end());
    });
    return std::pair{values, summary.interpolated};
  };
  REQUIRE(plan_chart(scene_of(kMathieu), request).method == Method::surrogate);
  const auto automatic = chart(Method::automatic), surrogate = chart(Method::surrogate);
  CHECK(automatic.first == surrogate.first);
  CHECK(automatic.second == surrogate.second);
  CHECK(automatic.second > 39'000);
}

TEST_CASE("a forecast of a method that does not fit is refused", "[chart][plan]") {
  CHECK_THROWS_AS(forecast_point(linear_model(scene_of(kMathieu)), {.method = Method::exact}), InvalidInput);
  CHECK_THROWS_AS(forecast_point(linear_model(scene_of(kMathieu)), {.tolerance = 1.0}), InvalidInput);
}

}  // namespace strutt::test::forecast_test
