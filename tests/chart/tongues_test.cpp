#include "strutt/chart/tongues.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"
#include "support/scenes.hpp"

namespace strutt::test::tongues_test {
namespace {

Verdict verdict_at(Scene scene, const std::string& path, double value) {
  parameter(scene, path) = value;
  static MonodromyEngine engine;  // it keeps its plans
  return analyse(engine, linear_model(scene), {.tolerance = 1e-12}).verdict;
}

/// How often the verdict changes between 1001 points of a line.
std::size_t changes_of_verdict(const Scene& scene, const TongueLine& line) {
  std::size_t changes = 0;
  Verdict before = verdict_at(scene, line.parameter, line.from);
  for (int i = 1; i <= 1000; ++i) {
    const Verdict now = verdict_at(scene, line.parameter, std::lerp(line.from, line.to, i / 1000.0));
    changes += now == before ? 0 : 1;
    before = now;
  }
  return changes;
}

/// A point mass with alpha = 1: epsilon = amplitude/9.81, delta = 1/frequency^2.
Scene pendulum_scene(double amplitude, double frequency, Equilibrium about = Equilibrium::hanging) {
  Scene scene;
  scene.pendulum = PendulumTable{.shape = PendulumTable::Shape::point_mass, .length = 9.81, .about = about};
  scene.support = SupportTable{.amplitude = amplitude, .frequency = frequency};
  return scene;
}

}  // namespace

TEST_CASE("along delta the tongues are those of Mathieu's equation", "[chart][tongues][ratchet]") {
  const double epsilon = 0.5;
  const auto edges = tongues(mathieu_scene(1.0, epsilon), {"mathieu.delta", -1.0, 40.0});
  const auto known = characteristic_values(0, 12, 2.0 * epsilon);
  REQUIRE(edges.size() == 25);
  CHECK(edges[0].upper);
  check_close("edge of a tongue along a line (relative)", edges[0].position, known[0].a.value / 4.0, 1e-15);
  CHECK(std::isnan(edges[0].width));
  for (std::size_t n = 1; n <= 12; ++n) {
    const TongueEdge &low = edges[2 * n - 1], &high = edges[2 * n];
    CHECK(low.order == static_cast<int>(n));
    CHECK_FALSE(low.upper);
    CHECK(high.upper);
    for (const auto& [edge, value] : {std::pair{low, known[n].b->value}, {high, known[n].a.value}})
      check_within("edge of a tongue along a line (relative)", std::abs(edge.position / (value / 4.0) - 1.0),
                   1e-15);
    CHECK(low.outcome == Outcome::converged);
    CHECK(low.width == high.width);
    check_within("bound of a width along a line (relative)", low.width_relative_error, 5e-12);
  }
}

TEST_CASE("the width in another parameter is that in delta over the slope",
          "[chart][tongues][extreme][N06][ratchet]") {
  // frequency = delta^(-1/2), so that the width is |d frequency/d delta| w where w is small
  const auto edges = tongues(pendulum_scene(0.0981, 1.0), {"support.frequency", 0.15, 3.0});
  const auto v = PeriodicFunction::fourier(0.0, {{1, 0.01, 0.0}});
  int narrow = 0;
  for (const TongueEdge& edge : edges) {
    if (edge.order < 5) continue;
    const TongueEdges mean = tongue_edges(v, edge.order, edge.order).front();
    const double expected = tongue_width(v, mean).value / (2.0 * std::pow(mean.upper.value, 1.5));
    CHECK(std::abs(edge.width / expected - 1.0) <= edge.width_relative_error + 1e-13);
    check_within("N06 bound of a width in another parameter (relative)", edge.width_relative_error, 2e-12);
    check_close("N06 edge in another parameter (relative)", edge.position, 1.0 / std::sqrt(mean.upper.value),
                3e-15);
    ++narrow;
  }
  CHECK(narrow == 18);  // both edges of n = 5 ... 13
}

TEST_CASE("the verdict changes at each edge and nowhere else", "[chart][tongues]") {
  const auto check = [](const Scene& scene, const TongueLine& line) {
    const auto edges = tongues(scene, line);
    CHECK(edges.size() == changes_of_verdict(scene, line));
    std::vector<double> places;
    for (const TongueEdge& edge : edges) places.push_back(edge.position);
    std::ranges::sort(places);
    Verdict before = verdict_at(scene, line.parameter, line.from);
    double from = line.from;
    for (std::size_t i = 0; i <= places.size(); ++i) {
      const double to = i < places.size() ? places[i] : line.to;
      for (const double share : {0.01, 0.3, 0.7, 0.99}) {
        CAPTURE(from, to, share);
        CHECK(verdict_at(scene, line.parameter, std::lerp(from, to, share)) == before);
      }
      before = before == Verdict::stable ? Verdict::unstable : Verdict::stable;
      from = to;
    }
  };
  check(mathieu_scene(1.3, 0.0), {"mathieu.epsilon", 0.05, 12.0});
  check(pendulum_scene(3.0, 1.0), {"support.frequency", 0.9, 5.0});
  check(pendulum_scene(0.5, 1.0, Equilibrium::inverted), {"support.frequency", 10.0, 60.0});
  check(pendulum_scene(0.5, 20.0, Equilibrium::inverted), {"support.amplitude", 0.2, 8.0});
}

TEST_CASE("the largest growth of a tongue is found, narrow or wide", "[chart][tongues][ratchet]") {
  // to lowest order pi w/n: at epsilon = 1e-4 and, n = 1, w = epsilon, up to terms of order epsilon^2
  const auto narrow = tongues(mathieu_scene(1.0, 1e-4), {"mathieu.delta", 0.1, 5.0}, {.growth = true});
  REQUIRE(narrow.size() == 8);
  for (const TongueEdge& edge : narrow) {
    check_close("largest growth of a thin tongue against first order (relative)", edge.growth,
                3.141592653589793 * edge.width / edge.order, 8e-9);
    check_close("place of the largest growth of a thin tongue against first order (relative)",
                edge.growth_position, 0.25 * edge.order * edge.order, 5e-8);
  }
  // just wide enough for the monodromy matrix
  for (const TongueEdge& edge :
       tongues(mathieu_scene(1.0, 3e-7), {"mathieu.delta", 0.1, 0.5}, {.growth = true}))
    check_close("largest growth of a tongue next to the narrow form against first order (relative)",
                edge.growth, 3.141592653589793 * edge.width, 2.5e-11);
  const Scene scene = mathieu_scene(1.0, 1.5);
  MonodromyEngine engine;
  for (const TongueEdge& edge : tongues(scene, {"mathieu.delta", -3.0, 3.0}, {.growth = true})) {
    if (edge.order == 0 || edge.upper) continue;
    double most = 0.0;
    for (int i = 1; i < 1000; ++i) {
      const double delta = edge.position + edge.width * i / 1000.0;
      most = std::max(most, analyse(engine, mathieu_delta_epsilon(delta, 1.5)).growth);
    }
    CHECK(edge.growth >= most * (1.0 - 1e-9));
    CHECK(edge.growth <= most * (1.0 + 1e-5));
  }
}

TEST_CASE("a line may meet a tongue more than once", "[chart][tongues][ratchet]") {
  const auto edges = tongues(mathieu_scene(0.35, 0.0), {"mathieu.epsilon", -1.0, 1.0}, {.count = 2});
  std::vector<TongueEdge> first;
  for (const TongueEdge& edge : edges)
    if (edge.order == 1) first.push_back(edge);
  REQUIRE(first.size() == 2);
  CHECK(first[0].crossing == 0);
  CHECK(first[0].upper);
  CHECK(first[1].crossing == 1);
  CHECK_FALSE(first[1].upper);
  check_close("edges on both sides of zero against each other (relative)", first[0].position,
              -first[1].position, 8e-16);
}

TEST_CASE("a tip on the end of the line is an edge there", "[chart][tongues][slow]") {
  const auto edges = tongues(mathieu_scene(1.0, 0.0), {"mathieu.epsilon", 0.0, 9.0});
  std::vector<TongueEdge> second;
  for (const TongueEdge& edge : edges)
    if (edge.order == 2) second.push_back(edge);
  REQUIRE(second.size() == 2);
  CHECK(second[0].position == 0.0);
  CHECK(second[0].error == 0.0);
  CHECK(second[1].width == second[1].position);
  for (const TongueEdge& edge : edges) CHECK(edge.outcome == Outcome::converged);
}

TEST_CASE("a line may pass the tip of a tongue", "[chart][tongues]") {
  const auto of_order = [](int order, double delta, const TongueLine& line) {
    auto edges = tongues(mathieu_scene(delta, 0.0), line);
    std::erase_if(edges, [order](const TongueEdge& edge) { return edge.order != order; });
    return edges;
  };
  const auto through = of_order(2, 1.0, {"mathieu.epsilon", -5.0, 5.0});  // inside on both sides
  REQUIRE(through.size() == 2);
  CHECK((through[0].upper && through[0].crossing == 0));
  CHECK((!through[1].upper && through[1].crossing == 1));
  for (const TongueEdge& edge : through) CHECK((edge.position == 0.0 && edge.error == 0.0));
  CHECK(of_order(2, 1.0, {"mathieu.epsilon", -5.0, 0.0}).size() == 1);
  const auto beside = of_order(4, 4.0, {"mathieu.epsilon", -5.0, 5.0});  // outside on both sides
  REQUIRE(beside.size() == 2);
  for (const TongueEdge& edge : beside) CHECK((edge.position == 0.0 && edge.width == 0.0));
  for (const TongueEdge& edge :
       of_order(4, 4.0, {"mathieu.epsilon", -3.0, 0.5}))  // no midpoint is at the tip
    CHECK(std::abs(edge.position) <= edge.error);
}

TEST_CASE("a closed tongue is a pair without width", "[chart][tongues][extreme][N08][ratchet]") {
  Scene scene;
  scene.hill = HillTable{.period = 2.0 * 3.141592653589793, .harmonics = {{1, 1.0, 0.0}, {2, 0.5, 0.0}}};
  const auto edges = tongues(scene, {"hill.mean", 0.5, 1.9});
  REQUIRE(edges.size() == 3);
  CHECK(edges[0].order == 1);
  CHECK(std::isnan(edges[0].width));
  CHECK(edges[1].order == 2);
  CHECK(edges[1].width_relative_error == 1.0);
  check_within("N08 bound of the width of a closed tongue along a line", edges[1].width,
               2.5e-15);  // the period is 2 pi but for a rounding, and it counts
  check_within("N08 distance of the edges of a closed tongue along a line",
               edges[2].position - edges[1].position, 3e-15);
  CHECK(edges[1].outcome == Outcome::converged);
}

TEST_CASE("a tongue that falls between the points of a grid is in the list",
          "[chart][tongues][extreme][N52][ratchet]") {
  // at epsilon = 0.1 tongues 4 and on are narrower than 1e-6: no cell of 1000 is inside one
  const Scene scene = mathieu_scene(1.0, 0.1);
  const TongueLine line{"mathieu.delta", 3.5, 13.0};
  std::vector<LinearModel> cells;
  for (int k = 0; k < 1000; ++k)
    cells.emplace_back(mathieu_delta_epsilon(std::lerp(line.from, line.to, (k + 0.5) / 1000.0), 0.1));
  MonodromyEngine engine;
  for (const auto& cell : analyse(engine, cells, {.tolerance = 1e-12}))
    CHECK(cell.verdict == Verdict::stable);
  const auto edges = tongues(scene, line);
  REQUIRE(edges.size() == 8);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    CHECK(edges[k].order == 4 + static_cast<int>(k) / 2);
    CHECK(edges[k].width > 0.0);
    CHECK(edges[k].width < 1e-6);
    check_within("N52 bound of a width between the points of a grid (relative)",
                 edges[k].width_relative_error, 6e-12);
  }
}

TEST_CASE("count takes the first tongues, and all are those that the line can meet", "[chart][tongues]") {
  const Scene scene = mathieu_scene(1.0, 0.01);
  const TongueLine line{"mathieu.delta", -1.0, 30.0};
  CHECK(tongue_count(scene, line) == 11);  // tongue 10 is near 25, tongue 11 near 30.25
  CHECK(tongues(scene, line).back().order == 10);
  CHECK(tongues(scene, line, {.count = 3}).back().order == 2);
  CHECK(tongues(scene, {"mathieu.delta", 0.3, 0.9}).empty());
}

TEST_CASE("a line on which nothing changes has no edges", "[chart][tongues]") {
  Scene free;  // time in units of the pendulum's own: X'' + X = 0 whatever the length
  free.pendulum = PendulumTable{.length = 1.0};
  CHECK(tongues(free, {"pendulum.length", 1.0, 2.0}).empty());
}

TEST_CASE("tongues refuses what it cannot answer", "[chart][tongues]") {
  const Scene scene = mathieu_scene(1.0, 0.01);
  CHECK_THROWS_AS(tongues(scene, {"mathieu.delta", 2.0, 1.0}), InvalidInput);
  CHECK_THROWS_AS(tongues(scene, {"mathieu.delta", 1.0, 1.0}), InvalidInput);
  CHECK_THROWS_AS(tongues(scene, {"mathieu.delta", 0.0, HUGE_VAL}), InvalidInput);
  CHECK_THROWS_AS(tongues(scene, {"mathieu.a", 0.0, 1.0}), InvalidInput);
  CHECK_THROWS_AS(tongues(scene, {"mathieu.delta", 0.0, 1.0}, {.tolerance = 1e-14}), InvalidInput);
  CHECK_THROWS_AS(tongues(scene, {"mathieu.delta", 0.0, 1e9}), InvalidInput);
  Scene strong;
  strong.hill = HillTable{.period = 1.0, .mean = 1.0, .harmonics = {{1, 1e9, 0.0}}};
  CHECK_THROWS_AS(tongues(strong, {"hill.mean", 0.0, 1.0}), InvalidInput);
}

}  // namespace strutt::test::tongues_test
