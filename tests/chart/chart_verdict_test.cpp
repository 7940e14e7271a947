// Verdicts of a whole chart against the index of the tongue by Sturm counts.
#include <catch2/catch.hpp>
#include <cmath>

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

}  // namespace strutt::test::chart_verdict_test
