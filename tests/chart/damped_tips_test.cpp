// tongues() with damping just below that which closes them, and on lines that end there.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "chart/extended_edge.hpp"
#include "strutt/chart/closing_damping.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"
#include "support/scenes.hpp"
#include "support/tongue_edges.hpp"

namespace strutt::test::damped_tips_test {

TEST_CASE("narrow damped tongues across which damping and growth change", "[chart][tongues]") {
  // in frequency, length and gravity h/h0 changes along the line; the edges in 50 digits
  const Scene free = rod(Equilibrium::hanging, 0.015, 2.55);
  for (const TongueLine& line : {TongueLine{"support.frequency", 2.4, 2.7},
                                 {"pendulum.length", 0.9, 1.1},
                                 {"pendulum.gravity", 9.0, 10.5}}) {
    const auto tips = closing_damping(free, line);
    REQUIRE(tips.size() == 1);
    REQUIRE(tips[0].tongue == 3);
    for (const double share : {0.3, 0.9, 0.99}) {
      Scene scene = free;
      scene.pendulum->damping = share * tips[0].damping;
      const auto pair = of_order(tongues(scene, line), 3);
      REQUIRE(pair.size() == 2);
      ExtendedEdges exact(scene, line.parameter, nullptr);
      const auto low = exact.near(pair[0].position, 0.1 * pair[0].width),
                 high = exact.near(pair[1].position, 0.1 * pair[0].width);
      CAPTURE(line.parameter, share, pair[0].width, pair[0].width_relative_error);
      REQUIRE(low.has_value());
      REQUIRE(high.has_value());
      const double width = (high->position - low->position) + (high->remainder - low->remainder);
      CHECK(std::abs(pair[0].width / width - 1.0) <= pair[0].width_relative_error);
      CHECK(std::abs(low->position - pair[0].position) <= absolute_error(pair[0]));
      CHECK(std::abs(high->position - pair[1].position) <= absolute_error(pair[1]));
    }
  }
}

TEST_CASE("what is left just below closing is found wherever on the line its tip lies",
          "[chart][tongues][slow]") {
  struct Case {
    Scene scene;
    TongueLine whole;  // on which the tip is looked for
    std::string damping;
  };
  const std::vector<Case> cases{
      {mathieu_scene(1.89719, 1.0), {"mathieu.epsilon", 0.01, 12.0}, "mathieu.damping"},
      {mathieu_scene(5.2, 1.0), {"mathieu.epsilon", 0.01, 12.0}, "mathieu.damping"},
      {rod(Equilibrium::hanging, 0.17, 4.5), {"support.frequency", 2.6, 30.0}, "pendulum.damping"},
      {rod(Equilibrium::hanging, 0.46, 8.7), {"pendulum.length", 0.27, 3.0}, "pendulum.damping"},
      {rod(Equilibrium::hanging, 0.88, 1.57), {"pendulum.gravity", 0.5, 6.0}, "pendulum.damping"},
  };
  int found = 0;
  for (const auto& [free, whole, damping] : cases)
    for (const ClosingDamping& tip : closing_damping(free, whole)) {
      if (tip.tongue > 2) continue;
      const double reach = std::min(tip.position - whole.from, whole.to - tip.position);
      if (reach < 1e-3 * tip.position) continue;  // closes at an end of the line
      for (const double below : {1e-4, 1e-7, 1e-10})
        for (const double place : {0.003, 0.02, 0.5, 0.98, 0.997}) {
          Scene scene = free;
          parameter(scene, damping) = tip.damping * (1.0 - below);
          const TongueLine line{whole.parameter, tip.position - place * reach,
                                tip.position + (1.0 - place) * reach};
          const auto at = [&](double p) { return stability_at(scene, line.parameter, p); };
          REQUIRE(at(tip.position).verdict == Verdict::unstable);
          if (at(line.from).verdict != Verdict::stable || at(line.to).verdict != Verdict::stable) continue;
          CAPTURE(line.parameter, tip.tongue, tip.position, below, place);
          const auto pair = of_order(tongues(scene, line), tip.tongue);
          REQUIRE(pair.size() == 2);
          CHECK(pair[0].position < tip.position);
          CHECK(pair[1].position > tip.position);
          for (const TongueEdge& edge : pair) {
            CHECK(edge.outcome == Outcome::converged);
            const double side = edge.upper ? 1.0 : -1.0, step = 0.02 * edge.width;
            CHECK(at(edge.position + side * step).margin > 0.0);
            CHECK(at(edge.position - side * step).margin < 0.0);
          }
          ++found;
        }
    }
  CHECK(found >= 50);
}

TEST_CASE("next to no damping leaves next to all of a thin tongue", "[chart][tongues]") {
  // 2.1e-6 in the mean: by the margin, which beside the undamped edges is as uncertain as it is small
  const TongueLine line{"pendulum.length", 0.356, 15.18};
  const auto free = of_order(tongues(rod(Equilibrium::hanging, 0.537447, 1.15408), line), 5);
  REQUIRE(free.size() == 2);
  for (const double damping : {1e-7, 1e-9, 1e-11, 1e-13, 1e-20}) {
    CAPTURE(damping);
    const auto pair = of_order(tongues(rod(Equilibrium::hanging, 0.537447, 1.15408, damping), line), 5);
    REQUIRE(pair.size() == 2);
    CHECK(pair[0].width < free[0].width * (1.0 + free[0].width_relative_error));
    CHECK(pair[0].width == Approx(free[0].width).epsilon(0.03 * std::min(1.0, damping / 1e-7) + 1e-9));
  }
}

TEST_CASE("damping that shifts the mean into a tongue opens and closes it on a line in the damping",
          "[chart][tongues]") {
  const auto free = tongues(mathieu_scene(1.0, 3.0), {"mathieu.delta", -6.0, 10.0}, {.count = 2});
  const double upper = free.back().position;
  REQUIRE(free.back().upper);
  for (const double above : {1e-4, 1e-2}) {
    const Scene scene = mathieu_scene(upper + above, 3.0);
    const auto pair = of_order(tongues(scene, {"mathieu.damping", 0.0, 3.0}), 1);
    REQUIRE(pair.size() == 2);
    // it opens at about c^2/4 = above, a little later by the damping itself
    CHECK(pair[0].position > 2.0 * std::sqrt(above));
    CHECK(pair[0].position < 2.6 * std::sqrt(above));
    for (const TongueEdge& edge : pair) {
      const double step = 1.01 * absolute_error(edge) + 1e-13, side = edge.upper ? 1.0 : -1.0;
      CHECK(stability_at(scene, "mathieu.damping", edge.position + 10.0 * side * step).margin > 0.0);
      CHECK(stability_at(scene, "mathieu.damping", edge.position - 10.0 * side * step).margin < 0.0);
    }
  }
}

TEST_CASE("beside a tip the edges are as good as elsewhere", "[chart][tongues][ratchet]") {
  // about the tip |D| is a parabola: the width goes with the square root of what is left of the damping
  const TongueLine line{"mathieu.delta", -0.2, 3.0};
  for (const ClosingDamping& tip : closing_damping(mathieu_scene(1.0, 0.5), line)) {
    if (tip.tongue > 3) continue;
    double before = 0.0;
    for (const double below : {1e-6, 1e-7, 1e-8}) {
      CAPTURE(tip.tongue, below);
      const auto pair =
          of_order(tongues(mathieu_scene(1.0, 0.5, tip.damping * (1.0 - below)), line), tip.tongue);
      REQUIRE(pair.size() == 2);
      for (const TongueEdge& edge : pair) {
        CHECK(edge.outcome == Outcome::converged);
        check_within("bound of an edge next to a damped tip", edge.error, 8e-16);
        check_within("bound of a width next to a damped tip (relative)", edge.width_relative_error, 3e-15);
      }
      check_within("width next to a damped tip against the distance of its edges",
                   std::abs(pair[1].position - pair[0].position - pair[0].width), 1e-15);
      if (before > 0.0)
        CHECK(before / pair[0].width == Approx(std::sqrt(10.0)).epsilon(1e-5 + 4.0 * tip.error / below));
      before = pair[0].width;
    }
  }
}

TEST_CASE("lines of any length may end on an edge or a tip", "[chart][tongues][slow]") {
  const auto check = [](const Scene& scene, const std::string& path, double place) {
    for (const double length : {1e-2, 1e-6, 1e-9, 1e-11, 1e-13})
      for (const auto& [left, right] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}) {
        const TongueLine line{path, place - left * length, place + right * length};
        if (path == "mathieu.damping" && line.from < 0.0) continue;
        CAPTURE(path, place, length, left, right);
        std::vector<TongueEdge> edges;
        REQUIRE_NOTHROW(edges = tongues(scene, line));
        for (const TongueEdge& edge : edges) {
          CHECK(edge.position >= line.from);
          CHECK(edge.position <= line.to);
          if (length >= 1e-9) CHECK(edge.outcome == Outcome::converged);
        }
        // an edge well within the line is there
        if (left == 1.0 && right == 1.0 && length >= 1e-11) CHECK(!edges.empty());
      }
  };
  for (const double damping : {0.0, 0.02})
    for (const TongueEdge& edge : tongues(mathieu_scene(1.0, 0.5, damping), {"mathieu.delta", -0.2, 2.0})) {
      const Scene scene = mathieu_scene(edge.position, 0.5, damping);
      check(scene, "mathieu.delta", edge.position);
      check(scene, "mathieu.epsilon", 0.5);
      if (damping > 0.0) check(scene, "mathieu.damping", damping);
    }
  for (const ClosingDamping& tip : closing_damping(mathieu_scene(1.0, 0.5), {"mathieu.delta", -0.2, 3.0})) {
    const Scene scene = mathieu_scene(tip.position, 0.5, tip.damping);
    for (const double length : {1e-2, 1e-6, 1e-9, 1e-11, 1e-13}) {
      CHECK_NOTHROW(tongues(scene, {"mathieu.delta", tip.position - length, tip.position}));
      CHECK_NOTHROW(tongues(scene, {"mathieu.delta", tip.position, tip.position + length}));
      CHECK_NOTHROW(tongues(scene, {"mathieu.damping", tip.damping, tip.damping + length}));
      CHECK_NOTHROW(tongues(scene, {"mathieu.epsilon", 0.5 - length, 0.5}));
    }
  }
}

}  // namespace strutt::test::damped_tips_test
