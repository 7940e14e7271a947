// tongues() with damping.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"
#include "support/reference.hpp"
#include "support/scenes.hpp"
#include "support/tongue_edges.hpp"

namespace strutt::test::damped_tongues_test {

using std::numbers::pi;

TEST_CASE("damped edges of the first tongue against references of 40 digits",
          "[chart][tongues][reference][ratchet]") {
  // the last twelve rows of the family stand in pairs, 1e-9 above an edge and 1e-6 below it; the edge they
  // were made from is good to about 1e-12, their margins to 40 digits
  int checked = 0;
  for (const auto& row : reference::read("mathieu")) {
    if (row.text("family") != "damped" || row.input("damping") * row.input("epsilon") >= 1.21) continue;
    const double epsilon = row.input("epsilon"), damping = row.input("damping"), delta = row.input("delta");
    if (std::abs(delta) > 1.0 || damping < 0.03 || epsilon > 2.0 || epsilon < 0.1) continue;
    const auto edges =
        tongues(mathieu_scene(1.0, epsilon, damping), {"mathieu.delta", -2.0, 2.0}, {.count = 2});
    REQUIRE(edges.size() == 3);
    const bool unstable = row.result("margin") < 0;
    const bool inside = delta < edges[0].position || (delta > edges[1].position && delta < edges[2].position);
    CHECK(inside == unstable);
    double nearest = HUGE_VAL;
    for (const TongueEdge& edge : edges) {
      CHECK(edge.outcome == Outcome::converged);
      nearest = std::min(
          nearest, std::min(std::abs(delta - 1e-9 - edge.position), std::abs(delta + 1e-6 - edge.position)));
    }
    if (nearest > 1e-7) continue;
    check_within("edge of a damped tongue against the references", nearest, 1e-12);
    ++checked;
  }
  CHECK(checked == 12);
}

TEST_CASE("the verdict is certain beside each damped edge", "[chart][tongues][ratchet][slow]") {
  const auto check = [](const Scene& scene, const TongueLine& line, std::size_t least) {
    const auto edges = tongues(scene, line);
    CHECK(edges.size() >= least);
    for (const TongueEdge& edge : edges) {
      CAPTURE(line.parameter, edge.order, edge.upper, edge.position, edge.error);
      check_within("bound of an edge of a damped tongue", edge.error, 2e-13);
      const double step = 1.01 * absolute_error(edge) + 1e-15;
      const auto below = stability_at(scene, line.parameter, edge.position - step);
      const auto above = stability_at(scene, line.parameter, edge.position + step);
      CHECK(below.verdict == (edge.upper ? Verdict::unstable : Verdict::stable));
      CHECK(above.verdict == (edge.upper ? Verdict::stable : Verdict::unstable));
      const auto& inside = edge.upper ? below : above;
      CHECK(inside.winding == 0.5 * edge.order);
    }
    // nothing else changes on a grid of 2001 points
    std::size_t changes = 0;
    Verdict before = stability_at(scene, line.parameter, line.from).verdict;
    for (int i = 1; i <= 2000; ++i) {
      const auto now = stability_at(scene, line.parameter, std::lerp(line.from, line.to, i / 2000.0)).verdict;
      changes += now == before ? 0 : 1;
      before = now;
    }
    CHECK(changes == edges.size());
  };
  check(mathieu_scene(1.0, 0.8, 0.05), {"mathieu.delta", -1.0, 12.0}, 5);
  check(mathieu_scene(0.3, 0.0, 0.2), {"mathieu.epsilon", 0.01, 6.0}, 3);
  check(mathieu_scene(1.1, 0.9, 0.0), {"mathieu.damping", 0.0, 1.0}, 1);
  // the undamped tongue has no edge on the line
  check(mathieu_scene(0.27, 0.0, 0.1), {"mathieu.epsilon", 0.05, 2.0}, 1);
  check(mathieu_scene(0.27, 0.5, 0.0), {"mathieu.damping", 0.1, 1.0}, 1);
  Scene rod;
  rod.pendulum = PendulumTable{.length = 1.0, .damping = 0.02};
  rod.support = SupportTable{.amplitude = 0.2, .frequency = 8.0, .phase = 0.4};
  check(rod, {"support.frequency", 1.5, 30.0}, 4);
  rod.pendulum->damping = 0.3;
  check(rod, {"support.amplitude", 0.01, 1.5}, 1);
  rod.pendulum->about = Equilibrium::inverted;
  check(rod, {"support.frequency", 5.0, 80.0}, 1);
  rod.support->harmonics = {{1, 0.1, 0.0}, {2, 0.02, 0.05}, {3, 0.0, 0.03}};
  rod.support->waveform = Waveform::harmonics;
  rod.pendulum->about = Equilibrium::hanging;
  check(rod, {"support.frequency", 2.0, 20.0}, 6);
}

TEST_CASE("narrow damped tongues obey the perturbation formula", "[chart][tongues][extreme][N06][ratchet]") {
  // (delta - 1/4)^2 = (epsilon^2 - c^2)/4 to lowest order, relative corrections of order epsilon
  const double epsilon = 1e-9, c = 0.8e-9;
  const auto first = of_order(tongues(mathieu_scene(1.0, epsilon, c), {"mathieu.delta", 0.1, 0.5}), 1);
  REQUIRE(first.size() == 2);
  check_close("N06 width of a damped tongue of 6e-10 against perturbation theory (relative)", first[0].width,
              0.6e-9, 4e-14);
  check_within("N06 bound of the width of a damped tongue of 6e-10 (relative)", first[0].width_relative_error,
               4e-12);
  CHECK(first[0].outcome == Outcome::converged);
  check_close("N06 edge of a damped tongue of 6e-10 against perturbation theory (relative)",
              first[0].position, 0.25 - 0.3e-9, 8e-16);
  CHECK(of_order(tongues(mathieu_scene(1.0, epsilon, 1.0000001e-9), {"mathieu.delta", 0.1, 0.5}), 1).empty());
  // tongue n: growth pi w/n per period closes at c = growth/pi; half of it leaves sqrt(3)/2 of the width
  for (const int n : {2, 3, 5}) {
    const auto v = PeriodicFunction::fourier(0.0, {{1, 1e-3, 0.0}});
    const double width = tongue_width(v, tongue_edges(v, n, n).front()).value;
    const double middle = 0.25 * n * n;
    const TongueLine line{"mathieu.delta", middle - 0.1, middle + 0.1};
    const auto half = of_order(tongues(mathieu_scene(1.0, 1e-3, 0.5 * width / n), line), n);
    REQUIRE(half.size() == 2);
    check_close("N06 width of a tongue at half its closing damping against perturbation theory (relative)",
                half[0].width, std::sqrt(0.75) * width, 2.5e-7);
    CHECK(of_order(tongues(mathieu_scene(1.0, 1e-3, 1.001 * width / n), line), n).empty());
    CHECK(of_order(tongues(mathieu_scene(1.0, 1e-3, 0.999 * width / n), line), n).size() == 2);
  }
}

TEST_CASE("the narrow form and the zeros of the margin agree where both are good",
          "[chart][tongues][ratchet]") {
  // widths in the mean about the limit between them, 2e-6
  for (const double epsilon : {0.0017, 0.0020, 0.0023})
    for (const double share : {0.3, 0.9}) {
      const auto v = PeriodicFunction::fourier(0.0, {{1, epsilon, 0.0}});
      const double width = tongue_width(v, tongue_edges(v, 2, 2).front()).value;
      const auto edges =
          of_order(tongues(mathieu_scene(1.0, epsilon, share * width / 2.0), {"mathieu.delta", 0.9, 1.1}), 2);
      REQUIRE(edges.size() == 2);
      for (const TongueEdge& edge : edges) {
        const double side = edge.upper ? 1.0 : -1.0, step = 1e-2 * edge.width;
        CHECK(stability_at(mathieu_scene(1.0, epsilon, share * width / 2.0), "mathieu.delta",
                           edge.position + side * step)
                  .margin > 0.0);
        CHECK(stability_at(mathieu_scene(1.0, epsilon, share * width / 2.0), "mathieu.delta",
                           edge.position - side * step)
                  .margin < 0.0);
      }
      check_close("width of a damped tongue next to the narrow form against perturbation theory (relative)",
                  edges[0].width, std::sqrt(1.0 - share * share) * width, 2e-5);
    }
}

TEST_CASE("growth of a damped tongue is that of the undamped one less cT/2", "[chart][tongues][ratchet]") {
  const auto damped = tongues(mathieu_scene(1.0, 0.5, 0.02), {"mathieu.delta", -1.0, 2.0}, {.growth = true});
  const auto free = tongues(mathieu_scene(1.0, 0.5, 0.0), {"mathieu.delta", -1.0, 2.0}, {.growth = true});
  REQUIRE(damped.size() == 5);
  for (const int n : {1, 2}) {
    const auto with = of_order(damped, n), without = of_order(free, n);
    check_close("largest growth of a damped tongue against that of the free one (relative)", with[0].growth,
                without[0].growth - pi * 0.02, 1e-14);
  }
}

TEST_CASE("next to the tip the width says how uncertain it is", "[chart][tongues]") {
  const auto v = PeriodicFunction::fourier(0.0, {{1, 1e-3, 0.0}});
  const TongueEdges edges = tongue_edges(v, 3, 3).front();
  const TongueWidth width = tongue_width(v, edges);
  const double closing = narrow_tongue_growth(v, edges, width) / pi;
  double before = 0.0;
  for (const double below : {1e-1, 1e-4, 1e-8, 1e-12}) {
    const auto pair =
        of_order(tongues(mathieu_scene(1.0, 1e-3, closing * (1.0 - below)), {"mathieu.delta", 2.0, 2.5}), 3);
    REQUIRE(pair.size() == 2);
    CHECK(pair[0].width_relative_error > before);
    CHECK((pair[0].outcome == Outcome::converged) == (pair[0].width_relative_error <= 1e-10));
    before = pair[0].width_relative_error;
  }
}

}  // namespace strutt::test::damped_tongues_test
