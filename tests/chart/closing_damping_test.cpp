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

Scene square_wave(double mean) {
  Scene scene;
  scene.hill = HillTable{
      .waveform = Waveform::square, .period = 2.0 * std::numbers::pi, .mean = mean, .amplitude = 1.0};
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

TEST_CASE(
    "a little less damping leaves the tongue open at its tip, a little more closes it all along the line",
    "[chart][damping]") {
  struct Case {
    Scene scene;
    TongueLine line;
    int count = 8;
  };
  const auto along = [](double delta, double to, int count) {
    Scene scene = mathieu_scene(1.0);
    scene.mathieu->delta = delta;
    return Case{scene, {"mathieu.epsilon", 0.001, to}, count};
  };
  const std::vector<Case> cases{
      {mathieu_scene(0.8), {"mathieu.delta", -1.0, 3.0}},
      {rod(0.1), {"support.frequency", 2.3, 30.0}},
      {rod(0.1), {"pendulum.length", 0.05, 30.0}},
      // damping lowers the mean, so that tongues may stay open longest where they are closed without
      along(0.3, 9.0, 2),
      along(1.2, 12.0, 3),
      along(0.5, 20.0, 4),
      along(2.0, 20.0, 4),  // tongue 3 still grows where the line ends
      {rod(0.1), {"support.amplitude", 0.01, 3.0}, 4},
      {square_wave(0.3), {"hill.amplitude", 0.01, 9.0}, 3},
      // and below a mean of 0 to where tongue 0 is
      {mathieu_scene(3.0), {"mathieu.delta", -4.0, 8.0}},
      {mathieu_scene(5.0), {"mathieu.delta", -10.0, 8.0}}};
  for (const auto& [scene, line, count] : cases) {
    CAPTURE(line.parameter, line.to);
    const std::string damping = scene.mathieu ? "mathieu.damping"
                                : scene.hill  ? "hill.damping"
                                              : "pendulum.damping";
    const auto rows = closing_damping(scene, line, {.count = count});
    REQUIRE(!rows.empty());
    for (const ClosingDamping& row : rows) {
      CAPTURE(row.tongue, row.damping, row.position);
      CHECK(row.outcome == Outcome::converged);
      const auto open_at = [&](double p, double factor) {
        const auto found = stability_at(scene, line.parameter, p, damping, row.damping * factor);
        // another tongue may be open there
        return found.verdict != Verdict::stable && 2.0 * found.winding == row.tongue;
      };
      CHECK(open_at(row.position, 1.0 - 1e-8));
      CHECK_FALSE(open_at(row.position, 1.0 + 1e-8));
      int open = 0;
      for (int i = 0; i <= 1000; ++i) open += open_at(std::lerp(line.from, line.to, i / 1000.0), 1.0 + 1e-8);
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
