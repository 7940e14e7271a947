// What a scene says must not depend on its units, nor on what the equation leaves out.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/floquet/stability.hpp"
#include "strutt/model/scene.hpp"
#include "support/ratchet.hpp"
#include "support/scenes.hpp"

namespace strutt::test::scale_test {

using strutt::test::check_close;
using test::mathieu_scene;
using test::rod_scene;

namespace {

Stability analysed(const Scene& scene) {
  MonodromyEngine engine;
  validate(scene);
  return analyse(engine, linear_model(scene), {.tolerance = 1e-12});
}

/// Half of |D| by growth and damping; what two scenes of one system must share.
double half_discriminant(const Stability& s, double half_damping) {
  return std::cosh(s.growth + half_damping);
}

}  // namespace

TEST_CASE("The moment changes neither equation nor verdict", "[model][scene][law]") {
  auto pushed = rod_scene();
  pushed.moment = MomentTable{0.1, {{2, 0.3, 0.0}}, 12.0};
  const auto with = analysed(pushed), without = analysed(rod_scene());
  CHECK(with.matrix == without.matrix);
  CHECK(with.margin == without.margin);
}

TEST_CASE("A pendulum in SI units and its canonical Mathieu scene agree", "[model][scene][law][ratchet]") {
  // r = r0 cos(omega t): W = +-(delta - epsilon cos tau); the same scene in (a, q) at twice the frequency
  const double frequency = GENERATE(2.0, 5.5, 8.62, 12.0, 200.0), amplitude = GENERATE(0.0, 0.02, 0.35);
  for (const auto about : {Equilibrium::hanging, Equilibrium::inverted}) {
    auto si = rod_scene(about);
    si.support->frequency = frequency;
    si.support->amplitude = amplitude;
    const double sign = about == Equilibrium::hanging ? 1.0 : -1.0;
    const double delta = sign * 3.0 * 9.81 / (2.0 * 0.8) / (frequency * frequency);
    const double epsilon = -sign * 3.0 * amplitude / (2.0 * 0.8), c = 0.25 / frequency;
    const auto physical = analysed(si);
    for (const auto& scene :
         {mathieu_scene(delta, epsilon, c), mathieu_scene(4.0 * delta, -2.0 * epsilon, 2.0 * c, true)}) {
      const auto canonical = analysed(scene);
      INFO("frequency " << frequency << " amplitude " << amplitude);
      REQUIRE(physical.outcome == Outcome::converged);
      CHECK(physical.verdict == canonical.verdict);
      CHECK(physical.verdict != Verdict::unresolved);
      CHECK(std::abs(physical.margin - canonical.margin) <= physical.margin_error + canonical.margin_error);
      const double size =
          std::max({1.0, physical.matrix.cwiseAbs().maxCoeff(), canonical.matrix.cwiseAbs().maxCoeff()});
      const double allowed = (physical.error + canonical.error) * size;
      CHECK(std::abs(physical.discriminant - canonical.discriminant) <= allowed);
      const double h = c * std::numbers::pi;
      CHECK(std::abs(half_discriminant(physical, h) - half_discriminant(canonical, h)) <=
            std::exp(h) * allowed);
      check_close("growth per time of a scene against growth per period (relative)", physical.growth_per_time,
                  physical.growth * frequency / (2.0 * std::numbers::pi), 8e-16);
    }
  }
}

TEST_CASE("Scenes that only differ in units of mass, length and time agree", "[model][scene][law][ratchet]") {
  auto unit = rod_scene(), other = rod_scene();
  // lengths in mm, time in ms, mass in g
  other.pendulum->mass = 1200.0;
  other.pendulum->length = 800.0;
  other.pendulum->gravity = 9.81e-3;
  other.pendulum->damping = 0.25e-3;
  other.support->amplitude = 60.0;
  other.support->frequency = 12.0e-3;
  const auto a = analysed(unit), b = analysed(other);
  CHECK(a.verdict == b.verdict);
  CHECK(std::abs(a.margin - b.margin) <= a.margin_error + b.margin_error);
  CHECK(std::abs(a.discriminant - b.discriminant) <= a.error + b.error);
  check_close("growth in other units of mass length and time (relative)", a.growth_per_time,
              1e3 * b.growth_per_time, 8e-16);
}

}  // namespace strutt::test::scale_test
