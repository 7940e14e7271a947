#include "strutt/chart/surrogate.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "strutt/io/scene_file.hpp"
#include "support/ratchet.hpp"
#include "support/reference.hpp"
#include "support/scenes.hpp"

namespace strutt::test::surrogate_test {

using test::check_within;
namespace {

Scene scene_of(const std::string& text) { return parse_scene(text, "scene").scene; }
Scene mathieu() { return scene_of("[mathieu]\ndelta = 1\nepsilon = 0.5\n"); }

Axis axis(const std::string& parameter, double from, double to, std::size_t points = 1024,
          AxisScale scale = AxisScale::linear) {
  return {parameter, from, to, points, scale};
}

/// What surrogate and engine say at a point.
struct Point {
  double x, y;
  Stability reference, surrogate;
  double size;  ///< max(1, |M|) about the even phase
};

struct Comparison {
  std::vector<Point> points;
  std::size_t missing = 0;
};

/// The surrogate and arkode at pseudo-random points.
Comparison compare(const Scene& scene, const Axis& x, const Axis& y, const Surrogate& surrogate, int count,
                   double reference_tolerance) {
  Comparison result;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  MonodromyEngine engine;
  Scene point = scene;
  const auto value = [&](const Axis& a) {
    const double v =
        std::lerp(Surrogate::coordinate(a, a.from), Surrogate::coordinate(a, a.to), share(random));
    return a.scale == AxisScale::linear ? v : std::exp(v);
  };
  for (int i = 0; i < count; ++i) {
    const double px = value(x), py = value(y);
    const auto found = surrogate.hill_monodromy(px, py);
    if (!found) {
      ++result.missing;
      continue;
    }
    parameter(point, x.parameter) = px;
    parameter(point, y.parameter) = py;
    const auto equation = std::get<HillEquation>(linear_model(point));
    const auto exact = engine.compute(equation, {.tolerance = reference_tolerance, .method = Method::arkode});
    const auto& own = found->matrix.value;  // about the even phase; that of `exact` is from 0
    const double size = std::max(
        1.0, std::ldexp(own.mantissa.cwiseAbs().maxCoeff(), static_cast<int>(std::min(own.exponent, 2000L))));
    result.points.push_back({px, py, assess(equation, exact), assess(equation, *found), size});
  }
  return result;
}

/// Every bound holds, every verdict is right, and nothing is above the tolerance.
void check_points(const Comparison& comparison, double tolerance) {
  for (const auto& [x, y, exact, found, size] : comparison.points) {
    INFO("x = " << x << ", y = " << y);
    const double scale = std::exp(found.log_scale - exact.log_scale);
    const double difference =
        std::abs(found.discriminant * scale - exact.discriminant) / (size * std::exp(-exact.log_scale));
    check_within("difference of a surrogate from the engine over both bounds",
                 difference / (found.error + 2.0 * exact.error), 1.0);
    check_within("bound of a surrogate over the tolerance", found.error / tolerance, 1.0);
    CHECK(found.method == Method::surrogate);
    CHECK(std::abs(found.margin - exact.margin) <= found.margin_error + exact.margin_error);
    const bool decided = found.verdict != Verdict::unresolved && exact.verdict != Verdict::unresolved;
    if (decided) CHECK(found.verdict == exact.verdict);
    check_within("winding by a surrogate", std::abs(found.winding - exact.winding), 8e-8);
  }
}

/// Builds, compares and checks; all points must be interpolated.
SurrogateReport build_and_check(const Scene& scene, const Axis& x, const Axis& y, double tolerance,
                                int count) {
  const Surrogate surrogate(scene, x, y, {.tolerance = tolerance, .threads = 2});
  const auto& report = surrogate.report();
  CHECK(report.boxes_left_out + report.failed_checks == 0);
  CHECK(report.largest_check <= 1.0);
  CHECK(report.checks == 16 * report.boxes);
  const auto comparison = compare(scene, x, y, surrogate, count, std::max(1e-2 * tolerance, 1e-12));
  CHECK(comparison.missing == 0);
  check_points(comparison, tolerance);
  return report;
}

}  // namespace

TEST_CASE("the surrogate of Mathieu's equation keeps its error at random points",
          "[chart][surrogate][ratchet]") {
  const Axis x = axis("mathieu.delta", -1.0, 5.0), y = axis("mathieu.epsilon", 0.0, 6.0);
  const auto coarse = build_and_check(mathieu(), x, y, 1e-6, 400);
  CHECK(coarse.boxes == 1);
  CHECK(coarse.nodes == 17 * 17);  // entire functions: degree 16 is enough
  const auto fine = build_and_check(mathieu(), x, y, 1e-10, 400);
  CHECK(fine.boxes == 1);
  CHECK(fine.nodes <= 33 * 33);
}

TEST_CASE("damping comes after the surrogate", "[chart][surrogate][ratchet]") {
  Scene scene = mathieu();
  parameter(scene, "mathieu.damping") = 0.7;
  build_and_check(scene, axis("mathieu.delta", -1.0, 3.0), axis("mathieu.epsilon", 2.0, 0.1), 1e-8, 100);
  build_and_check(scene, axis("mathieu.delta", -1.0, 3.0), axis("mathieu.damping", 0.0, 6.0), 1e-8, 100);
}

TEST_CASE("a pendulum with a sine has a surrogate, also on logarithmic axes", "[chart][surrogate][ratchet]") {
  const auto equilibrium = GENERATE(Equilibrium::hanging, Equilibrium::inverted);
  Scene scene = test::rod_scene(equilibrium);
  scene.support->phase = 0.4;
  const Axis amplitude = axis("support.amplitude", 0.0, 0.5);
  build_and_check(scene, axis("support.frequency", 40.0, 4.0), amplitude, 1e-9, 100);
  const auto log = build_and_check(scene, axis("support.frequency", 1.0, 40.0, 1024, AxisScale::logarithmic),
                                   amplitude, 1e-9, 100);
  CHECK(log.boxes <= 4);
  build_and_check(scene, axis("pendulum.length", 0.3, 3.0), axis("pendulum.gravity", 1.0, 20.0), 1e-9, 100);
}

TEST_CASE("several harmonics even about one phase have a surrogate", "[chart][surrogate][ratchet]") {
  const Scene scene = scene_of(
      "[hill]\nperiod = 2\nmean = 3\ndamping = 0.1\n"
      "harmonics = [{ order = 1, cos = 0.5 }, { order = 3, cos = 1.5 }]\n");
  build_and_check(scene, axis("hill.harmonics.3.cos", -4.0, 6.0), axis("hill.period", 0.5, 5.0), 1e-8, 100);
  build_and_check(scene, axis("hill.mean", -4.0, 6.0), axis("hill.harmonics.1.cos", 0.0, 5.0), 1e-8, 100);
}

TEST_CASE("a coefficient that is even about no phase is interpolated over the whole period",
          "[chart][surrogate][ratchet]") {
  const Scene skew = scene_of(
      "[hill]\nperiod = 1\nmean = 30\ndamping = 0.2\n"
      "harmonics = [{ order = 1, cos = 5 }, { order = 2, sin = 15 }]\n");
  const Axis x = axis("hill.mean", -20.0, 100.0), y = axis("hill.harmonics.1.cos", 0.0, 40.0);
  CHECK(Surrogate(skew, x, y, {.tolerance = 1e-6}).kind() == SurrogateKind::period);
  build_and_check(skew, x, y, 1e-8, 100);
  // even about a phase that turns with the parameter
  const Scene turning = scene_of("[hill]\nperiod = 1\nharmonics = [{ order = 1, cos = 0.5, sin = 0.5 }]\n");
  build_and_check(turning, x, axis("hill.harmonics.1.sin", 0.0, 1.0), 1e-8, 100);
}

TEST_CASE("a box in which small values drown in large ones is split", "[chart][surrogate][slow][ratchet]") {
  const Axis x = axis("mathieu.delta", -50.0, 200.0, 4096), y = axis("mathieu.epsilon", 0.0, 200.0, 4096);
  const Surrogate surrogate(mathieu(), x, y, {.tolerance = 1e-9, .threads = 2});
  CHECK(surrogate.report().boxes >= 8);
  CHECK(surrogate.report().boxes_left_out + surrogate.report().failed_checks == 0);
  const auto comparison = compare(mathieu(), x, y, surrogate, 200, 1e-11);
  CHECK(comparison.missing == 0);
  check_points(comparison, 1e-9);
}

TEST_CASE("the error of a surrogate is above the true one on the reference tables",
          "[chart][surrogate][reference]") {
  std::size_t interpolated = 0, rows = 0;
  for (const auto& row : reference::read("mathieu")) {
    Scene scene = mathieu();
    parameter(scene, "mathieu.damping") = row.input("damping");
    const double delta = row.input("delta"), epsilon = row.input("epsilon");
    const double tolerance = rows++ % 2 == 0 ? 1e-9 : 1e-6;
    const Surrogate surrogate(scene, axis("mathieu.delta", delta - 0.5, delta + 0.7, 256),
                              axis("mathieu.epsilon", epsilon - 0.3, epsilon + 0.9, 256),
                              {.tolerance = tolerance});
    const auto found = surrogate.hill_monodromy(delta, epsilon);
    if (!found) continue;
    ++interpolated;
    const auto model = reference::model("mathieu", row);
    const auto result = assess(std::get<HillEquation>(model), *found);
    INFO("delta = " << delta << ", epsilon = " << epsilon << ", tolerance " << tolerance);
    CHECK(reference::true_error(model, result, row) <= result.error);
    const auto margin = row.result("margin");
    if (result.margin > kLowestMargin)
      CHECK(static_cast<double>(reference::Real(abs(margin - result.margin))) <= result.margin_error);
    if (result.verdict != Verdict::unresolved)
      CHECK(result.verdict == (margin > 0   ? Verdict::stable
                               : margin < 0 ? Verdict::unstable
                                            : Verdict::boundary));
  }
  CHECK(interpolated >= 9 * rows / 10);
}

TEST_CASE("gradients of the discriminant are those of the equation", "[chart][surrogate][ratchet]") {
  const Axis x = axis("mathieu.delta", 0.2, 5.0, 1024, AxisScale::logarithmic),
             y = axis("mathieu.epsilon", 0.0, 6.0);
  const Surrogate surrogate(mathieu(), x, y, {.tolerance = 1e-10});
  MonodromyEngine engine;
  const auto trace = [&](double delta, double epsilon) {
    const auto equation = mathieu_delta_epsilon(delta, epsilon);
    return assess(equation, engine.compute(equation, {.tolerance = 1e-13, .method = Method::arkode}))
        .discriminant;
  };
  for (const auto& [delta, epsilon] : {std::pair{0.3, 0.5}, {1.7, 3.0}, {4.9, 5.5}, {2.0, 0.1}}) {
    const auto g = surrogate.gradient(delta, epsilon);
    REQUIRE(g);
    const double square = std::ldexp(1.0, static_cast<int>(2 * g->exponent));
    const auto slope = [&](const Eigen::MatrixXd& d) {
      const auto& u = g->value;
      return 2.0 * square * (d(0, 0) * u(1, 1) + u(0, 0) * d(1, 1) + d(1, 0) * u(0, 1) + u(1, 0) * d(0, 1));
    };
    constexpr double h = 1e-4;  // differences are good to h^2
    const double by_delta = (trace(delta + h, epsilon) - trace(delta - h, epsilon)) / (2.0 * h);
    const double by_epsilon = (trace(delta, epsilon + h) - trace(delta, epsilon - h)) / (2.0 * h);
    INFO("delta = " << delta << ", epsilon = " << epsilon);
    check_within("gradient of D by a surrogate over max(1; |gradient|)",
                 std::abs(slope(g->by_x) - by_delta) / std::max(1.0, std::abs(by_delta)), 2e-7);
    check_within("gradient of D by a surrogate over max(1; |gradient|)",
                 std::abs(slope(g->by_y) - by_epsilon) / std::max(1.0, std::abs(by_epsilon)), 2e-7);
  }
  CHECK_FALSE(surrogate.gradient(7.0, 1.0));
}

TEST_CASE("the matrix of a surrogate is in the units of the scene", "[chart][surrogate][ratchet]") {
  Scene scene = test::rod_scene();  // a cosine: even about the phase 0
  const Axis x = axis("support.frequency", 4.0, 40.0), y = axis("support.amplitude", 0.0, 0.3);
  const Surrogate surrogate(scene, x, y, {.tolerance = 1e-9});
  REQUIRE(surrogate.even_phase() == 0.0);
  parameter(scene, x.parameter) = 9.0;
  parameter(scene, y.parameter) = 0.2;
  const auto equation = std::get<HillEquation>(linear_model(scene));
  MonodromyEngine engine;
  const auto exact =
      assess(equation, engine.compute(equation, {.tolerance = 1e-11, .method = Method::arkode}));
  const auto found = assess(equation, *surrogate.hill_monodromy(9.0, 0.2));
  const double size = std::max(1.0, exact.matrix.cwiseAbs().maxCoeff());
  check_within("M by a surrogate at tolerance 1e-9 (scaled)",
               (found.matrix - exact.matrix).cwiseAbs().maxCoeff() / size, 1.2e-10);
}

TEST_CASE("a surrogate has the same bits for any number of threads", "[chart][surrogate][threads]") {
  const Axis x = axis("mathieu.delta", -1.0, 9.0), y = axis("mathieu.epsilon", 0.0, 12.0);
  const auto build = [&](int threads) {
    return Surrogate(mathieu(), x, y, {.tolerance = 1e-10, .threads = threads});
  };
  const Surrogate one = build(1);
  for (const int threads : {2, 5}) {
    const Surrogate many = build(threads);
    REQUIRE(many.boxes().size() == one.boxes().size());
    for (std::size_t b = 0; b < one.boxes().size(); ++b) {
      CHECK(many.boxes()[b].coefficients == one.boxes()[b].coefficients);
      CHECK(many.boxes()[b].error == one.boxes()[b].error);
    }
    CHECK(many.report().largest_check == one.report().largest_check);
  }
}

TEST_CASE("what has no surrogate is refused with the reason", "[chart][surrogate]") {
  const Axis delta = axis("mathieu.delta", -1.0, 5.0);
  CHECK(Surrogate::refusal(mathieu(), delta, axis("mathieu.epsilon", 0.0, 6.0)).empty());
  CHECK_THAT(Surrogate::refusal(mathieu(), delta, axis("mathieu.epsilon", 1.0, 1.0, 1)),
             Catch::Matchers::Contains("one point"));
  const Scene square = scene_of("[hill]\nperiod = 1\nwaveform = \"square\"\namplitude = 0.5\n");
  const Axis mean = axis("hill.mean", 0.0, 1.0);
  CHECK_THAT(Surrogate::refusal(square, mean, axis("hill.amplitude", 0.0, 1.0)),
             Catch::Matchers::Contains("not smooth"));
  const Scene two = scene_of(
      "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\nstiffness = { mean = [[1, 0], [0, 2]] }\n"
      "damping = { mean = [[1, 0], [0, 1]] }\n");
  CHECK_THAT(Surrogate::refusal(two, axis("linear.period", 1.0, 2.0), axis("linear.mass.0.0", 1.0, 2.0)),
             Catch::Matchers::Contains("at some points only"));
  CHECK_THROWS_AS(Surrogate(square, mean, axis("hill.amplitude", 0.0, 1.0)), InvalidInput);
  CHECK_THROWS_AS(Surrogate(mathieu(), delta, axis("mathieu.epsilon", 0.0, 6.0), {.tolerance = 1.0}),
                  InvalidInput);
}

TEST_CASE("boxes that cost more than the cells in them are left out", "[chart][surrogate]") {
  const Surrogate surrogate(mathieu(), axis("mathieu.delta", -1.0, 5.0, 8),
                            axis("mathieu.epsilon", 0.0, 6.0, 8));
  CHECK(surrogate.report().boxes == 0);
  CHECK(surrogate.report().nodes == 0);
  CHECK_FALSE(surrogate.monodromy(1.0, 0.5));
}

TEST_CASE("a cancelled surrogate says so", "[chart][surrogate][threads]") {
  const std::atomic<bool> cancel{true};
  const Surrogate surrogate(mathieu(), axis("mathieu.delta", -1.0, 5.0), axis("mathieu.epsilon", 0.0, 6.0),
                            {.threads = 2, .cancel = &cancel});
  CHECK(surrogate.cancelled());
}

}  // namespace strutt::test::surrogate_test
