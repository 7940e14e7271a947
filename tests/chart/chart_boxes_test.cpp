// Wide charts by auto against random cells of them in 25 digits (tests/reference): every bound holds, no
// verdict is wrong.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/stability.hpp"
#include "strutt/io/scene_file.hpp"
#include "support/reference.hpp"

namespace strutt::test::chart_boxes_test {

namespace {

using reference::Real;

constexpr double kTolerance = 1e-9;
const double kAlpha = std::sqrt(1.5 * 9.81);  // of the rod of 1 m

/// What the chart says of the cells of a table, in its order.
struct Cells {
  ChartSummary summary;
  std::vector<double> verdict, discriminant, margin;
};

Cells cells_of(const Scene& scene, const ChartRequest& request, const std::vector<reference::Row>& rows) {
  Cells cells;
  cells.verdict.resize(rows.size());
  cells.discriminant.resize(rows.size());
  cells.margin.resize(rows.size());
  cells.summary = compute_chart(scene, request, [&](const ChartStrip& strip) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto column = static_cast<std::size_t>(rows[r].input("column")),
                 row = static_cast<std::size_t>(rows[r].input("row"));
      if (row < strip.first_row || row >= strip.first_row + strip.rows) continue;
      const std::size_t place = (row - strip.first_row) * strip.columns + column;
      cells.verdict[r] = strip.values[0][place];
      cells.discriminant[r] = strip.values[1][place];
      cells.margin[r] = strip.values[2][place];
    }
  });
  return cells;
}

/// The chart as a whole, and the bounds of the points one by one.
void check_box(const Scene& scene, const Axis& x, const Axis& y, const std::string& table) {
  const auto rows = reference::read(table);
  REQUIRE(rows.size() == 2000);
  const ChartRequest request{.x = x,
                             .y = y,
                             .layers = {Layer::verdict, Layer::discriminant, Layer::margin},
                             .tolerance = kTolerance,
                             .threads = 2};
  CHECK(plan_chart(scene, request).method == Method::surrogate);
  const auto cells = cells_of(scene, request, rows);
  CHECK(cells.summary.outcomes[static_cast<std::size_t>(Outcome::converged)] == x.points * y.points);
  CHECK(cells.summary.largest_error <= kTolerance);
  CHECK(cells.summary.interpolated > 99 * cells.summary.cells / 100);
  const Surrogate surrogate(scene, x, y, {.tolerance = kTolerance, .threads = 2});
  MonodromyEngine engine;
  Scene point = scene;
  std::size_t open = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double at_x = rows[r].input(table == "mathieu_box" ? "delta" : "frequency"),
                 at_y = rows[r].input(table == "mathieu_box" ? "epsilon" : "amplitude");
    INFO(table << ": " << at_x << ", " << at_y);
    REQUIRE(x.value(static_cast<std::size_t>(rows[r].input("column"))) == at_x);
    REQUIRE(y.value(static_cast<std::size_t>(rows[r].input("row"))) == at_y);
    parameter(point, x.parameter) = at_x;
    parameter(point, y.parameter) = at_y;
    const auto equation = std::get<HillEquation>(linear_model(point));
    const auto interpolated = surrogate.hill_monodromy(at_x, at_y);
    const auto monodromy = interpolated ? *interpolated : engine.compute(equation, {.tolerance = kTolerance});
    const auto found = assess(equation, monodromy);
    const Real trace = rows[r].result("trace"), margin = 1 - abs(trace) / 2;
    const double size = std::max(1.0, monodromy.matrix.value.mantissa.cwiseAbs().maxCoeff() *
                                          std::exp2(static_cast<double>(monodromy.matrix.value.exponent)));
    CHECK(found.error <= kTolerance);
    CHECK(static_cast<double>(Real(abs(trace - found.discriminant))) <= found.error * size);
    CHECK(static_cast<double>(Real(abs(margin - found.margin))) <= found.margin_error);
    CHECK(static_cast<double>(Real(abs(trace - cells.discriminant[r]))) <=
          cells.summary.largest_error * size);
    CHECK(static_cast<double>(Real(abs(margin - cells.margin[r]))) <= cells.summary.largest_error * size);
    const auto right = static_cast<double>(margin > 0 ? Verdict::stable : Verdict::unstable);
    if (cells.verdict[r] == static_cast<double>(Verdict::unresolved))
      ++open;
    else
      CHECK(cells.verdict[r] == right);
  }
  CHECK(open <= 2);
}

}  // namespace

TEST_CASE("a wide chart of Mathieu's equation keeps its bounds at 2000 random cells",
          "[chart][reference][slow]") {
  check_box(parse_scene("[mathieu]\n", "scene").scene, {"mathieu.delta", -50.0, 200.0, 2048},
            {"mathieu.epsilon", 0.0, 200.0, 2048}, "mathieu_box");
}

TEST_CASE("a wide chart of the pendulum keeps its bounds at 2000 random cells", "[chart][reference]") {
  const Scene scene =
      parse_scene("[pendulum]\nlength = 1\n[support]\namplitude = 0.1\nfrequency = 12\n", "scene").scene;
  check_box(scene, {"support.frequency", 0.1 * kAlpha, 50.0 * kAlpha, 2048},
            {"support.amplitude", 0.0, 0.5, 2048}, "pendulum_box");
}

}  // namespace strutt::test::chart_boxes_test
