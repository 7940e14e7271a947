// Cells of systems with four states in closed form against the matrices they come from.
#include "chart/reciprocal_cells.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "chart/surrogate_box.hpp"
#include "strutt/io/scene_file.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::reciprocal_cells_test {

namespace {

Scene scene_of(const std::string& damping, const std::string& coupling = "-0.3") {
  return parse_scene("[linear]\nperiod = 3\nmass = [[1, 0.2], [0.2, 1.5]]\n" + damping +
                         "stiffness = { mean = [[1.3, -0.3], [" + coupling +
                         ", 2.3]], harmonics = [{ order = 1, cos = [[0.4, 0], [0, 0]] }] }\n",
                     "scene")
      .scene;
}

ChartRequest request_of() {
  return {.x = {.parameter = "linear.period", .from = 1.8, .to = 3.4, .points = 90},
          .y = {.parameter = "linear.stiffness.harmonics.1.cos.0.0", .from = 0.0, .to = 1.2, .points = 70},
          .layers = {Layer::verdict, Layer::growth, Layer::discriminant},
          .tolerance = 1e-8,
          .method = Method::surrogate};
}

}  // namespace

TEST_CASE("cells in closed form are what their matrices say", "[chart][surrogate][ratchet]") {
  const Scene scene = scene_of(GENERATE("", "damping = { mean = [[0.125, 0.025], [0.025, 0.1875]] }\n"));
  const auto request = request_of();
  const auto cells = ReciprocalCells::of(scene, request);
  REQUIRE(cells);
  const Surrogate surrogate(scene, request.x, request.y, {.tolerance = request.tolerance});
  REQUIRE(surrogate.boxes().size() == 1);
  const SurrogateBox& box = surrogate.boxes()[0];
  for (std::size_t i = 0; i < request.x.points; i += 7) {
    for (std::size_t j = 0; j < request.y.points; j += 5) {
      const double x = request.x.value(i), y = request.y.value(j);
      const auto cell = cells->assess(i, j, box, evaluate(box, x, y));
      Scene point = scene;
      parameter(point, request.x.parameter) = x;
      parameter(point, request.y.parameter) = y;
      const auto system = std::get<LinearPeriodicSystem>(linear_model(point));
      const auto whole = assess(system, *surrogate.monodromy(x, y));
      INFO("column " << i << ", row " << j);
      CHECK(cell.outcome == Outcome::converged);
      CHECK(cell.verdict == whole.verdict);
      CHECK(std::abs(cell.margin - whole.margin) <= 1e-3 * (cell.margin_error + whole.margin_error));
      CHECK(cell.margin_error == Approx(whole.margin_error).epsilon(0.01).margin(1e-14));
      check_within("growth of a cell by reciprocal sums", std::abs(cell.growth - whole.growth), 2.5e-14);
      check_within("D of a cell by reciprocal sums",
                   std::abs(cell.discriminant * std::exp(cell.log_scale) - whole.discriminant), 3e-15);
      CHECK(cell.error == Approx(whole.error).epsilon(0.01).margin(1e-14));
    }
  }
}

TEST_CASE("what has no reciprocal multipliers everywhere is not served", "[chart][surrogate]") {
  CHECK_FALSE(ReciprocalCells::of(scene_of("", "-0.2"), request_of()));
  CHECK_FALSE(ReciprocalCells::of(scene_of("damping = { mean = [[0.1, 0], [0, 0]] }\n"), request_of()));
  auto request = request_of();
  request.x = {.parameter = "linear.mass.0.0", .from = 1.0, .to = 2.0, .points = 50};
  CHECK_FALSE(ReciprocalCells::of(scene_of(""), request));
}

TEST_CASE("a chart of two coupled pendulums leaves no open verdict that the engine can settle",
          "[chart][surrogate][stability_chart]") {
  const Scene scene = scene_of("");
  auto request = request_of();
  std::vector<double> verdicts, exact;
  const auto collect = [](std::vector<double>& to) {
    return [&to](const ChartStrip& strip) {
      to.insert(to.end(), strip.values[0].begin(), strip.values[0].end());
    };
  };
  request.tolerance = 1e-3;  // wide bounds: cells near the edges of tongues stay open
  const auto summary = compute_chart(scene, request, collect(verdicts));
  CHECK(summary.interpolated > 6000);
  CHECK(summary.interpolated < summary.cells);
  request.method = Method::automatic;
  compute_chart(scene, request, collect(exact));
  std::size_t open = 0;
  for (std::size_t cell = 0; cell < exact.size(); ++cell) {
    if (exact[cell] == static_cast<double>(Verdict::unresolved)) continue;
    open += verdicts[cell] == static_cast<double>(Verdict::unresolved) ? 1 : 0;
    CHECK(verdicts[cell] == exact[cell]);
  }
  CHECK(open == 0);
}

}  // namespace strutt::test::reciprocal_cells_test
