// Verdicts of a whole chart against the index of the tongue by Sturm counts.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "strutt/chart/stability_chart.hpp"
#include "support/hill_edges.hpp"

namespace strutt::test::chart_verdict_test {

TEST_CASE("no wrong verdict among a million cells of a chart by surrogate",
          "[chart][surrogate][stability_chart][extreme][N04]") {
  Scene scene;
  scene.mathieu = MathieuTable{};
  const ChartRequest request{.x = {"mathieu.delta", -1.0, 5.0, 1000},
                             .y = {"mathieu.epsilon", 0.0, 6.0, 1001},
                             .layers = {Layer::verdict},
                             .method = Method::surrogate,
                             .threads = 1};
  std::size_t decided = 0, wrong = 0, cells = 0;
  const auto summary = compute_chart(scene, request, [&](const ChartStrip& strip) {
    for (std::size_t row = 0; row < strip.rows; ++row) {
      const HillEdges edges(request.y.value(strip.first_row + row), 10);
      for (std::size_t column = 0; column < strip.columns; ++column) {
        const auto found =
            static_cast<Verdict>(static_cast<int>(strip.values[0][row * strip.columns + column]));
        const Verdict truth = edges.at(request.x.value(column));
        ++cells;
        if (truth == Verdict::unresolved || found == Verdict::unresolved) continue;
        ++decided;
        wrong += found != truth;
      }
    }
  });
  CHECK(wrong == 0);
  CHECK(cells == 1'001'000);
  CHECK(summary.interpolated >= cells * 99 / 100);
  CHECK(decided >= cells - 10);
}

TEST_CASE("cells beside an edge are decided at a coarse tolerance, by surrogate and point by point",
          "[chart][stability_chart][surrogate][extreme][N18]") {
  const auto method = GENERATE(Method::surrogate, Method::propagator);
  const HillEdges edges(0.5, 3);
  Scene scene;
  scene.mathieu = MathieuTable{};
  ChartRequest request{.x = {"mathieu.delta", edges[2].value - 1e-10, edges[2].value + 1e-10, 200},
                       .y = {"mathieu.epsilon", 0.5, 0.75, 251},
                       .layers = {Layer::verdict},
                       .tolerance = 1e-5,
                       .method = method,
                       .threads = 2};
  std::vector<double> first_row;
  const auto summary = compute_chart(scene, request, [&](const ChartStrip& strip) {
    if (strip.first_row == 0) first_row.assign(strip.values[0].begin(), strip.values[0].begin() + 200);
  });
  CHECK(summary.unresolved == 0);
  CHECK(summary.outcomes[static_cast<std::size_t>(Outcome::converged)] == 50'200);
  if (method == Method::surrogate) CHECK(summary.interpolated == 50'000);  // the first row is open
  for (std::size_t i = 0; i < 200; ++i)
    CHECK(first_row[i] == static_cast<double>(edges.at(request.x.value(i))));
  if (method == Method::surrogate) return;
  // a chart without verdicts costs less: the first row is computed once, not twice
  request.layers = {Layer::margin};
  const auto margins = compute_chart(scene, request, [](const ChartStrip&) {});
  request.y = {"mathieu.epsilon", 0.501, 0.75, 250};
  const auto others = compute_chart(scene, request, [](const ChartStrip&) {});
  request.layers = {Layer::verdict};
  CHECK(compute_chart(scene, request, [](const ChartStrip&) {}).right_hand_sides == others.right_hand_sides);
  CHECK(margins.right_hand_sides < summary.right_hand_sides);
  CHECK(summary.right_hand_sides < 2 * margins.right_hand_sides);
}

}  // namespace strutt::test::chart_verdict_test
