// What the host program does to the floating-point unit changes no result.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/floquet/stability.hpp"
#include "strutt/floquet/tongue_width.hpp"
#include "support/any_environment.hpp"
#include "support/models.hpp"

namespace strutt::test::environment_test {

namespace {

void add(Numbers& numbers, const Stability& s) {
  numbers.insert(numbers.end(), {static_cast<double>(s.verdict), s.margin, s.margin_error, s.growth,
                                 s.winding, s.discriminant, s.error});
}

/// Points whose numbers are subnormal, and those of the law suite.
Numbers of_points() {
  Numbers numbers;
  MonodromyEngine engine;
  for (const double delta : {-1e-310, 1e-310, 0.0, 0.25, 1.0})
    add(numbers, analyse(engine, mathieu_delta_epsilon(delta, 0.0)));
  add(numbers, analyse(engine, hill_equation(1e-10, PeriodicFunction::constant(1e-310))));
  add(numbers, analyse(engine, mathieu_delta_epsilon(-2e5, 1e-310)));
  static const auto models = every_model();  // made before anything is changed
  for (const auto& entry : models) add(numbers, analyse(engine, entry.model, {.method = Method::propagator}));
  return numbers;
}

Numbers of_edges() {
  Numbers numbers;
  for (const double q : {1e-310, 1e-160, 0.3, 1e5}) {
    for (const auto& [order, a, b] : characteristic_values(0, 12, q)) {
      numbers.insert(numbers.end(), {a.value, a.error});
      if (b) numbers.insert(numbers.end(), {b->value, b->error});
    }
  }
  const auto v = PeriodicFunction::fourier(0.0, {{1, 0.01, 0.003}, {2, 0.0, 0.002}});
  for (const auto& edges : tongue_edges(v, 1, 6)) {
    const auto width = tongue_width(v, edges);
    numbers.insert(numbers.end(), {edges.lower->value, edges.lower->error, edges.upper.value, width.value,
                                   width.relative_error, narrow_tongue_growth(v, edges, width)});
  }
  return numbers;
}

Numbers of_chart(Method method) {
  Scene scene;
  scene.mathieu = MathieuTable{.delta = 1.0, .epsilon = 0.5};
  const ChartRequest request{.x = {"mathieu.delta", -1.0, 5.0, 40},
                             .y = {"mathieu.epsilon", 0.0, 6.0, 30},
                             .layers = {Layer::verdict, Layer::growth, Layer::margin},
                             .method = method,
                             .threads = 2};
  Numbers numbers;
  compute_chart(scene, request, [&](const ChartStrip& strip) {
    for (const auto& layer : strip.values) numbers.insert(numbers.end(), layer.begin(), layer.end());
  });
  return numbers;
}

}  // namespace

TEST_CASE("points do not depend on the environment of the host", "[floquet][extreme][N35][N49]") {
  check_same(of_points);
}

TEST_CASE("edges and widths do not depend on the environment of the host", "[floquet][extreme][N35][N49]") {
  check_same(of_edges);
}

TEST_CASE("charts do not depend on the environment of the host, nor do their threads",
          "[chart][extreme][N35][N49]") {
  const auto method = GENERATE(Method::surrogate, Method::propagator);
  check_same([method] { return of_chart(method); });
}

}  // namespace strutt::test::environment_test
