#include "strutt/chart/closing_damping.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::closing_damping_test {
namespace {

Scene mathieu_scene(double epsilon, double damping = 0.0) {
  Scene scene;
  scene.mathieu = MathieuTable{.delta = 1.0, .epsilon = epsilon, .damping = damping};
  return scene;
}

Scene rod(double amplitude) {
  Scene scene;
  scene.pendulum = PendulumTable{.length = 1.0};
  scene.support = SupportTable{.amplitude = amplitude, .frequency = 12.0};
  return scene;
}

Stability stability_at(Scene scene, const std::string& path, double value, const std::string& damping,
                       double c) {
  static MonodromyEngine engine;
  parameter(scene, path) = value;
  parameter(scene, damping) = c;
  return analyse(engine, linear_model(scene), {.tolerance = 1e-13});
}

}  // namespace

TEST_CASE("a little less damping leaves the tongue open at its tip, a little more closes it everywhere",
          "[chart][damping]") {
  struct Case {
    Scene scene;
    TongueLine line;
    std::string damping;
  };
  const std::vector<Case> cases{{mathieu_scene(0.8), {"mathieu.delta", -1.0, 3.0}, "mathieu.damping"},
                                {rod(0.1), {"support.frequency", 2.3, 30.0}, "pendulum.damping"},
                                {rod(0.1), {"pendulum.length", 0.05, 30.0}, "pendulum.damping"}};
  for (const auto& [scene, line, damping] : cases) {
    CAPTURE(line.parameter);
    const auto rows = closing_damping(scene, line);
    const auto edges = tongues(scene, line);
    REQUIRE(rows.size() >= 2);
    for (const ClosingDamping& row : rows) {
      CAPTURE(row.tongue, row.damping);
      CHECK(row.outcome == Outcome::converged);
      const auto at = [&](double p, double factor) {
        return stability_at(scene, line.parameter, p, damping, row.damping * factor);
      };
      CHECK(at(row.position, 1.0 - 1e-8).verdict == Verdict::unstable);
      CHECK(at(row.position, 1.0 + 1e-8).verdict == Verdict::stable);
      double low = 0.0, high = 0.0;
      for (const TongueEdge& edge : edges)
        if (edge.order == row.tongue) (edge.upper ? high : low) = edge.position;
      int open = 0;
      for (int i = 0; i <= 1000; ++i) {
        const auto found =
            at(std::lerp(low - 0.2 * (high - low), high + 0.2 * (high - low), i / 1000.0), 1.0 + 1e-8);
        // another tongue may still be open there
        if (found.verdict != Verdict::stable && 2.0 * found.winding == row.tongue) ++open;
      }
      CHECK(open == 0);
    }
  }
}

TEST_CASE("for weak excitation tongue 1 closes at epsilon and tongue n as its width does",
          "[chart][damping][ratchet]") {
  // x'' + c x' + (1/4 + d + epsilon cos t) x: open for c < epsilon to lowest order
  const auto rows = closing_damping(mathieu_scene(1e-3), {"mathieu.delta", 0.1, 10.0});
  REQUIRE(rows.size() == 6);
  CHECK(rows[0].tongue == 1);
  check_close("closing damping of tongue 1 against first order (relative)", rows[0].damping, 1e-3, 6e-7);
  const auto edges = tongues(mathieu_scene(1e-3), {"mathieu.delta", 0.1, 10.0});
  for (const ClosingDamping& row : rows) {
    const double width = edges[2 * static_cast<std::size_t>(row.tongue) - 1].width;
    check_close("closing damping of thin tongues against their widths (relative)", row.damping,
                width / row.tongue, 8e-7);  // growth = pi w/n = c T/2
  }
  CHECK(rows[5].method == Method::fourier);
  CHECK(rows[0].method == Method::propagator);
}

TEST_CASE("thin tongues close where their width says, to a relative error of 1e-8 on all widths",
          "[chart][damping][ratchet]") {
  // tongue 3 is epsilon^3/16 wide to lowest order, so that it closes at epsilon^3/48
  const auto third = [](double epsilon) {
    return closing_damping(mathieu_scene(epsilon), {"mathieu.delta", 2.0, 2.5}).front();
  };
  for (const double epsilon : {1e-3, 0.0034, 0.02, 0.05, 0.08, 0.1, 0.2}) {
    CAPTURE(epsilon);
    const ClosingDamping row = third(epsilon);
    CHECK(row.method == (epsilon < 0.06 ? Method::fourier : Method::propagator));
    CHECK(row.outcome == Outcome::converged);
    check_within("bound of a closing damping of thin and wide tongues (relative)", row.error, 1e-8);
    CHECK(std::abs(48.0 * row.damping / std::pow(epsilon, 3) - 1.0) <= row.error + 0.5 * epsilon * epsilon);
  }
}

TEST_CASE("thin tongues close as the propagator says", "[chart][damping][ratchet]") {
  struct Case {
    double epsilon, from, to;
  };
  for (const auto& [epsilon, from, to] : {Case{0.05, 2.0, 2.5}, Case{0.2, 3.9, 4.1}, Case{0.4, 6.2, 6.4}}) {
    CAPTURE(epsilon);
    const ClosingDamping row = closing_damping(mathieu_scene(epsilon), {"mathieu.delta", from, to}).front();
    REQUIRE(row.method == Method::fourier);
    const double growth =
        stability_at(mathieu_scene(epsilon), "mathieu.delta", row.position, "mathieu.damping", 0.0).growth;
    const double closing = 2.0 * growth / (2.0 * std::numbers::pi);
    check_close("closing damping by the width of a thin tongue against the propagator (relative)",
                row.damping, closing, 2e-9);
  }
}

TEST_CASE("where the width changes along the line, the bound knows", "[chart][damping]") {
  const auto along_delta = [](double epsilon) {
    return closing_damping(mathieu_scene(epsilon), {"mathieu.delta", 3.9, 4.1}).front();
  };
  Scene scene = mathieu_scene(0.3);
  const double c = along_delta(0.3).damping;
  scene.mathieu->delta = along_delta(0.3).position;
  const auto rows = closing_damping(scene, {"mathieu.epsilon", 0.2, 0.4});
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].tongue == 4);
  CHECK(std::abs(rows[0].damping / c - 1.0) < 1e-2);  // another point of the same tongue, next to it
  CHECK(rows[0].outcome == Outcome::converged);
  const auto at = [&](double factor) {
    return stability_at(scene, "mathieu.epsilon", rows[0].position, "mathieu.damping",
                        rows[0].damping * factor);
  };
  CHECK(at(1.0 - 1e-6).margin < 0.0);
  CHECK(at(1.0 + 1e-6).margin > 0.0);
}

TEST_CASE("a tip beyond the undamped tongue is not passed off as found", "[chart][damping]") {
  // along epsilon at delta = 0.3 tongue 1 stays open up to c = 1.720386, beyond its undamped upper edge
  Scene scene = mathieu_scene(1.0);
  scene.mathieu->delta = 0.3;
  const auto rows = closing_damping(scene, {"mathieu.epsilon", 0.001, 9.0}, {.count = 2});
  REQUIRE(!rows.empty());
  CHECK(rows[0].tongue == 1);
  CHECK(rows[0].outcome == Outcome::tolerance_not_reached);
  CHECK(rows[0].damping <= 1.720387);
  CHECK(rows[0].damping * (1.0 + rows[0].error) >= 1.720386);
}

TEST_CASE("the damping of the scene does not count, and what has none is refused", "[chart][damping]") {
  const TongueLine line{"mathieu.delta", 0.0, 2.0};
  const auto free = closing_damping(mathieu_scene(0.5), line),
             damped = closing_damping(mathieu_scene(0.5, 0.3), line);
  REQUIRE(free.size() == damped.size());
  CHECK(free[0].damping == damped[0].damping);
  CHECK_THROWS_AS(closing_damping(mathieu_scene(0.5), {"mathieu.damping", 0.0, 1.0}), InvalidInput);
  CHECK_THROWS_AS(closing_damping(mathieu_scene(0.5), {"mathieu.delta", 1.0, 0.0}), InvalidInput);
  Scene linear;
  linear.linear = LinearPeriodicSystem{};
  CHECK_THROWS_AS(closing_damping(linear, {"linear.period", 1.0, 2.0}), InvalidInput);
}

}  // namespace strutt::test::closing_damping_test
