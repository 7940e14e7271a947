#include "strutt/chart/surrogate.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "io/scratch.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "strutt/io/scene_file.hpp"
#include "support/scenes.hpp"

namespace strutt {
namespace {

Scene scene_of(const std::string& text) { return parse_scene(text, "scene").scene; }
Scene mathieu() { return scene_of("[mathieu]\ndelta = 1\nepsilon = 0.5\n"); }

Axis axis(const std::string& parameter, double from, double to, std::size_t points = 1024,
          AxisScale scale = AxisScale::linear) {
  return {parameter, from, to, points, scale};
}

/// Trace of M / exp(log_scale) and the rest of what the engine says at a point.
struct Point {
  double x, y;
  Stability reference, surrogate;
  double size;  ///< max(1, |M|) of the reference
};

struct Comparison {
  std::vector<Point> points;
  std::size_t missing = 0;
};

/// The surrogate and the engine with `reference_tolerance` at pseudo-random points.
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
    const auto found = surrogate.monodromy(px, py);
    if (!found) {
      ++result.missing;
      continue;
    }
    parameter(point, x.parameter) = px;
    parameter(point, y.parameter) = py;
    const auto equation = std::get<HillEquation>(linear_model(point));
    const auto exact = engine.compute(equation, {.tolerance = reference_tolerance});
    const double size = std::max(1.0, std::ldexp(exact.matrix.value.mantissa.cwiseAbs().maxCoeff(),
                                                 static_cast<int>(exact.matrix.value.exponent)));
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
    CHECK(difference <= found.error + exact.error);
    CHECK(found.error <= tolerance);
    CHECK(std::abs(found.margin - exact.margin) <= found.margin_error + exact.margin_error);
    const bool decided = found.verdict != Verdict::unresolved && exact.verdict != Verdict::unresolved;
    if (decided) CHECK(found.verdict == exact.verdict);
    CHECK(found.winding == Approx(exact.winding).margin(1e-4));
  }
}

}  // namespace

TEST_CASE("the surrogate of Mathieu's equation keeps its error at 2000 random points",
          "[chart][surrogate][reference]") {
  const Axis x = axis("mathieu.delta", -1.0, 5.0), y = axis("mathieu.epsilon", 0.0, 6.0);
  for (const double tolerance : {1e-6, 1e-10}) {
    const Surrogate surrogate(mathieu(), x, y, {.tolerance = tolerance});
    CHECK(surrogate.report().boxes == 1);
    CHECK(surrogate.report().boxes_left_out + surrogate.report().failed_checks == 0);
    CHECK(surrogate.report().largest_check <= 1.0);
    CHECK(surrogate.report().checks >= 16);
    const auto comparison = compare(mathieu(), x, y, surrogate, 2000, 1e-12);
    REQUIRE(comparison.missing == 0);
    check_points(comparison, tolerance);
    const auto unresolved =
        std::count_if(comparison.points.begin(), comparison.points.end(),
                      [](const Point& p) { return p.surrogate.verdict == Verdict::unresolved; });
    CHECK(unresolved <= 2);
  }
}

}  // namespace strutt
