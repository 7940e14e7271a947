#include "strutt/floquet/sensitivity.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "strutt/floquet/tongue_edges.hpp"
#include "strutt/model/model_derivative.hpp"
#include "support/ratchet.hpp"
#include "support/scenes.hpp"

namespace strutt::test::sensitivity_test {
namespace {

struct SceneCase {
  std::string name;
  Scene scene;
};

Scene hill_scene(double mean, double damping) {
  Scene scene;
  scene.hill =
      HillTable{.period = 5.0, .mean = mean, .harmonics = {{1, 0.4, 0.0}, {3, 0.1, 0.2}}, .damping = damping};
  return scene;
}

Scene square_scene(double mean, double amplitude, double damping) {
  Scene scene;
  scene.hill = HillTable{
      .waveform = Waveform::square, .period = 6.0, .mean = mean, .amplitude = amplitude, .damping = damping};
  return scene;
}

Scene pendulum_scene(Waveform waveform, Equilibrium about, double frequency, double damping = 0.0) {
  Scene scene;
  scene.pendulum = PendulumTable{.mass = 2.0, .length = 1.3, .damping = damping, .about = about};
  scene.support = SupportTable{.waveform = waveform, .amplitude = 0.1, .frequency = frequency, .phase = 0.3};
  if (waveform == Waveform::harmonics) scene.support->harmonics = {{1, 0.02, 0.05}, {2, 0.0, 0.01}};
  return scene;
}

Scene body_scene() {
  Scene scene = pendulum_scene(Waveform::sine, Equilibrium::hanging, 9.0, 0.1);
  scene.pendulum->shape = PendulumTable::Shape::body;
  scene.pendulum->inertia = 1.5;
  scene.pendulum->centroid = 0.6;
  return scene;
}

Scene linear_scene(bool one) {
  Scene scene;
  LinearPeriodicSystem system;
  const int d = one ? 1 : 2;
  Eigen::MatrixXd mass(2, 2), mean(2, 2), cosine(2, 2), sine(2, 2), damping(2, 2), swing(2, 2);
  mass << 1.2, 0.1, 0.1, 0.9;
  mean << 1.0, 0.2, 0.1, 2.3;
  cosine << 0.5, 0.3, 0.2, 0.4;
  sine << 0.0, 0.1, -0.3, 0.2;
  damping << 0.2, 0.05, 0.0, 0.1;
  swing << 0.02, 0.0, 0.03, 0.01;
  system.period = 5.5;
  system.mass = mass.topLeftCorner(d, d);
  system.stiffness.mean = mean.topLeftCorner(d, d);
  system.stiffness.harmonics = {{1, cosine.topLeftCorner(d, d), sine.topLeftCorner(d, d)}};
  system.damping.mean = damping.topLeftCorner(d, d);
  if (!one) system.damping.harmonics = {{2, swing, Eigen::MatrixXd()}};
  scene.linear = system;
  return scene;
}

std::vector<SceneCase> every_scene() {
  return {{"Mathieu, stable", mathieu_scene(0.6, 0.4, 0.0)},
          {"Mathieu, second stable region", mathieu_scene(1.5, 0.4, 0.05)},
          {"Mathieu, tongue 1", mathieu_scene(0.27, 0.4, 0.1)},
          {"Mathieu, tongue 2", mathieu_scene(1.05, 0.9, 0.0)},
          {"Mathieu, falling", mathieu_scene(-3.0, 0.5, 0.2)},
          {"Mathieu (a, q)", mathieu_scene(5.1, 3.0, 0.1, true)},
          {"Hill, stable", hill_scene(0.9, 0.1)},
          {"Hill, tongue 1", hill_scene(0.41, 0.0)},
          {"Meissner, stable", square_scene(0.7, 0.3, 0.05)},
          {"Meissner, tongue", square_scene(0.3, 0.2, 0.0)},
          {"Meissner, one sign change", square_scene(0.2, 0.2, 0.01)},
          {"hanging", pendulum_scene(Waveform::sine, Equilibrium::hanging, 5.0)},
          {"hanging, tongue 1", pendulum_scene(Waveform::sine, Equilibrium::hanging, 6.6, 0.05)},
          {"inverted", pendulum_scene(Waveform::sine, Equilibrium::inverted, 60.0, 0.2)},
          {"square acceleration", pendulum_scene(Waveform::square, Equilibrium::hanging, 6.5, 0.02)},
          {"support harmonics", pendulum_scene(Waveform::harmonics, Equilibrium::hanging, 6.6)},
          {"body", body_scene()},
          {"system, one degree of freedom", linear_scene(true)},
          {"system", linear_scene(false)}};
}

Stability stability_of(Scene scene, const std::string& path, double value) {
  parameter(scene, path) = value;
  static MonodromyEngine engine;
  return analyse(engine, linear_model(scene), {.tolerance = 1e-13});
}

/// The difference quotient of sixth order, and what rounding leaves of it.
template <typename Quantity>
Derivative difference(const Scene& scene, const std::string& path, const Quantity& quantity) {
  const double p = parameter(scene, path), step = 2e-3 * std::max(0.1, std::abs(p));
  const auto central = [&](double h) {
    return quantity(stability_of(scene, path, p + h)) - quantity(stability_of(scene, path, p - h));
  };
  const double value = (45.0 * central(step) - 9.0 * central(2 * step) + central(3 * step)) / (60.0 * step);
  const double half = (45.0 * central(step / 2) - 9.0 * central(step) + central(1.5 * step)) / (30.0 * step);
  return {half, std::abs(value - half) / 16.0 +
                    1e-12 * (1.0 + std::abs(quantity(stability_of(scene, path, p)))) / step};
}

/// Values on one side of the parameter only do not exist.
bool has_neighbours(const Scene& scene, const std::string& path) {
  Scene changed = scene;
  const double p = parameter(scene, path);
  try {
    for (const double side : {-1.0, 1.0}) {
      parameter(changed, path) = p + side * 7e-3 * std::max(0.1, std::abs(p));
      validate(changed);
    }
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace

TEST_CASE("sensitivities are the limits of difference quotients, for every model and parameter",
          "[floquet][sensitivity][ratchet]") {
  MonodromyEngine engine;
  for (const auto& [name, scene] : every_scene()) {
    for (const std::string& path : parameter_paths(scene)) {
      if (!has_neighbours(scene, path)) continue;
      CAPTURE(name, path);
      const Sensitivity s = sensitivity(engine, scene, path);
      CHECK(s.outcome == Outcome::converged);
      const auto check = [&](const char* what, const Derivative& found, auto quantity) {
        CAPTURE(what);
        const Derivative expected = difference(scene, path, quantity);
        check_within("bound of a sensitivity over max(1; |value|)",
                     found.error / std::max(1.0, std::abs(found.value)), 4e-10);
        CHECK(expected.error <= 1e-6 * std::max(1.0, std::abs(found.value)));
        CHECK(std::abs(found.value - expected.value) <= found.error + 4.0 * expected.error);
      };
      check("growth", s.growth, [](const Stability& x) { return x.growth; });
      check("growth_per_time", s.growth_per_time, [](const Stability& x) { return x.growth_per_time; });
      if (linear_model(scene).index() == 1 && name == "system") continue;
      check("winding", s.winding, [](const Stability& x) { return x.winding; });
      check("margin", s.margin, [](const Stability& x) { return x.margin; });
    }
  }
}

TEST_CASE("in the thinnest tongues edges move as the eigenvalues of Hill's equation do",
          "[floquet][sensitivity][ratchet]") {
  // tongue 6 at epsilon = 0.01 is 2e-18 wide; both edges have the slope of their series, d(delta)/d(epsilon)
  MonodromyEngine engine;
  for (const int n : {1, 2, 3, 6}) {
    const auto edge_at = [n](double epsilon) {
      return tongue_edges(PeriodicFunction::fourier(0.0, {{1, epsilon, 0.0}}), n, n).front();
    };
    for (const bool upper : {true, false}) {
      const auto position = [&](double epsilon) {
        const TongueEdges e = edge_at(epsilon);
        return upper ? e.upper.value : e.lower->value;
      };
      const double epsilon = 0.5, step = 0.01;
      const double expected = (8.0 * (position(epsilon + step) - position(epsilon - step)) -
                               (position(epsilon + 2 * step) - position(epsilon - 2 * step))) /
                              (12.0 * step);
      const Scene scene = mathieu_scene(position(epsilon), epsilon, 0.0);
      const Sensitivity by_delta = sensitivity(engine, scene, "mathieu.delta"),
                        by_epsilon = sensitivity(engine, scene, "mathieu.epsilon");
      CAPTURE(n, upper);
      const Derivative shift = edge_shift(engine, scene, "mathieu.delta", "mathieu.epsilon");
      check_within("slope of an edge against its difference quotient over max(1/100; |slope|)",
                   std::abs(shift.value - expected) / std::max(0.01, std::abs(expected)), 2e-8);
      check_within("bound of the slope of an edge in a thin tongue", shift.error, 5e-12);
      CHECK(shift.value == -by_epsilon.edge.value / by_delta.edge.value);
      check_within("bound of dM/d(delta) on an edge in a thin tongue (relative)",
                   by_delta.edge.error / by_delta.edge.value, 5e-12);
    }
  }
}

TEST_CASE("a phase and the moment have no effect, and the largest multiplier of a free system no slope",
          "[floquet][sensitivity][ratchet]") {
  MonodromyEngine engine;
  const Scene scene = pendulum_scene(Waveform::sine, Equilibrium::hanging, 6.6);
  CHECK_FALSE(moves_stability(scene, "support.phase"));
  CHECK_FALSE(moves_stability(scene, "pendulum.mass"));
  CHECK(moves_stability(scene, "support.amplitude"));
  CHECK(moves_stability(body_scene(), "pendulum.mass"));
  CHECK(sensitivity(engine, scene, "support.phase").growth.value == 0.0);
  // undamped: damping of one coordinate leaves the other multipliers, all of modulus 1, where they are or not
  Scene system = linear_scene(false);
  system.linear->damping = {};
  system.linear->stiffness.mean = Eigen::Vector2d(1.0, 2.3).asDiagonal();
  system.linear->stiffness.harmonics.clear();
  system.linear->mass = Eigen::Matrix2d::Identity();
  const Derivative kept = sensitivity(engine, system, "linear.stiffness.mean.0.0").growth;
  CHECK(std::abs(kept.value) <= kept.error);
  check_within("bound of the sensitivity of the growth of a free system", kept.error, 5e-11);
  CHECK_THROWS_AS(sensitivity(engine, scene, "support.frequncy"), InvalidInput);
  CHECK_THROWS_AS(sensitivity(engine, scene, "support.phase", {.tolerance = 1.0}), InvalidInput);
}

}  // namespace strutt::test::sensitivity_test
