#include "strutt/chart/stability_margin.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/base/error.hpp"
#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/floquet/sensitivity.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"
#include "support/scenes.hpp"

namespace strutt::test::stability_margin_test {
namespace {

Scene square_scene(double mean, double amplitude) {
  Scene scene;
  scene.hill = HillTable{.waveform = Waveform::square, .period = 6.0, .mean = mean, .amplitude = amplitude};
  return scene;
}

Scene coupled_scene(double period, double coupling = -0.3) {
  Scene scene;
  LinearPeriodicSystem system;
  system.period = period;
  system.mass = Eigen::Matrix2d::Identity();
  system.stiffness.mean = Eigen::Matrix2d{{1.3, coupling}, {coupling, 2.3}};
  system.stiffness.harmonics = {{1, Eigen::Matrix2d{{0.4, 0.0}, {0.0, 0.0}}, Eigen::MatrixXd()}};
  scene.linear = system;
  return scene;
}

Verdict verdict_at(Scene scene, const std::vector<std::string>& paths, const std::vector<double>& values) {
  for (std::size_t i = 0; i < paths.size(); ++i) parameter(scene, paths[i]) = values[i];
  static MonodromyEngine engine;
  return analyse(engine, linear_model(scene), {.tolerance = 1e-13}).verdict;
}

Verdict other(Verdict verdict) { return verdict == Verdict::stable ? Verdict::unstable : Verdict::stable; }

/// The designs of the general tests: stable and unstable, damped and not, of every kind.
std::vector<Scene> designs() {
  return {mathieu_scene(0.6, 0.4),
          mathieu_scene(1.4, 0.7, 0.05),
          mathieu_scene(0.27, 0.2, 0.1),
          mathieu_scene(-0.2, 0.5),
          rod(Equilibrium::hanging, 0.05, 12.0),
          rod(Equilibrium::hanging, 0.05, 12.0, 0.1),
          rod(Equilibrium::hanging, 0.05, 7.5),
          rod(Equilibrium::inverted, 0.05, 120.0),
          rod(Equilibrium::inverted, 0.05, 60.0, 0.5),
          square_scene(0.8, 0.3),
          square_scene(0.25, 0.2),
          coupled_scene(2.2),
          coupled_scene(3.0)};
}

}  // namespace

TEST_CASE("the edges of Mathieu's equation along delta are characteristic values",
          "[chart][margin][ratchet]") {
  const auto known = characteristic_values(0, 2, 0.8);
  const auto margin = stability_margin(mathieu_scene(0.6, 0.4), {"mathieu.delta"});
  CHECK(margin.verdict == Verdict::stable);
  const ParameterMargin& row = margin.parameters.front();
  check_close("edges about a design against characteristic values (relative)", *row.lower_edge,
              known[1].a.value / 4.0, 8e-16);
  check_close("edges about a design against characteristic values (relative)", *row.upper_edge,
              known[2].b->value / 4.0, 8e-16);
  check_close("distance of a design to an edge (relative)", row.distance, 0.6 - known[1].a.value / 4.0,
              8e-16);
  CHECK(row.relative_distance == row.distance / 0.6);
  CHECK(row.tongue == 1);
  CHECK(row.method == Method::fourier);
  CHECK(row.outcome == Outcome::converged);
}

TEST_CASE("an unstable design has a negative distance to stability", "[chart][margin][ratchet]") {
  const auto known = characteristic_values(1, 1, 0.8);
  const auto margin = stability_margin(mathieu_scene(0.3, 0.4), {"mathieu.delta", "mathieu.damping"});
  CHECK(margin.verdict == Verdict::unstable);
  const auto& delta = margin.parameters[0];
  check_close("edges about a design against characteristic values (relative)", *delta.lower_edge,
              known[0].b->value / 4.0, 8e-16);
  check_close("edges about a design against characteristic values (relative)", *delta.upper_edge,
              known[0].a.value / 4.0, 8e-16);
  CHECK(delta.distance < 0.0);
  CHECK(delta.tongue == 1);
  const auto& damping = margin.parameters[1];
  CHECK_FALSE(damping.lower_edge);
  CHECK(damping.distance == -*damping.upper_edge);  // that much damping stabilises it
  CHECK(std::isnan(damping.relative_distance));
  CHECK(verdict_at(mathieu_scene(0.3, 0.4), {"mathieu.damping"}, {*damping.upper_edge * (1 + 1e-9)}) ==
        Verdict::stable);
  CHECK(margin.joint.distance < 0.0);
}

TEST_CASE("each edge parts verdicts, and none is between it and the design", "[chart][margin][slow]") {
  for (const Scene& scene : designs()) {
    const auto margin = stability_margin(scene, stability_parameters(scene),
                                         {.tolerance = scene.linear ? 1e-10 : 1e-12, .reach = 10.0});
    for (const ParameterMargin& row : margin.parameters) {
      CAPTURE(describe(scene), row.parameter, row.value);
      CHECK(row.outcome == Outcome::converged);
      for (const auto& edge : {row.lower_edge, row.upper_edge}) {
        if (!edge) continue;
        const double off =
            2.0 * row.error * std::max(1.0, std::abs(*edge)) + 1e-9 * std::abs(*edge - row.value);
        const double side = std::copysign(off, row.value - *edge);
        CHECK(verdict_at(scene, {row.parameter}, {*edge + side}) == margin.verdict);
        CHECK(verdict_at(scene, {row.parameter}, {*edge - side}) == other(margin.verdict));
        for (int i = 1; i < 20; ++i) {
          const double between = std::lerp(row.value, *edge, i / 20.0);
          CHECK(verdict_at(scene, {row.parameter}, {between}) == margin.verdict);
        }
      }
    }
  }
}

TEST_CASE("the joint margin is an edge, not further than any single one, and no random change is nearer",
          "[chart][margin][ratchet][slow]") {
  std::srand(7);
  for (const Scene& scene : designs()) {
    const auto margin = stability_margin(scene, stability_parameters(scene),
                                         {.tolerance = scene.linear ? 1e-10 : 1e-12, .reach = 10.0});
    const JointMargin& joint = margin.joint;
    CAPTURE(describe(scene), joint.distance);
    REQUIRE(!joint.edge.empty());
    const double r = std::abs(joint.distance);
    for (const auto& row : margin.parameters)
      if (row.value != 0.0) CHECK(r <= std::abs(row.relative_distance) * (1.0 + 1e-12));
    const auto moved = [&](double share) {
      std::vector<double> values;
      double square = 0.0;
      for (std::size_t i = 0; i < joint.parameters.size(); ++i) {
        const double p = parameter(scene, joint.parameters[i]);
        values.push_back(std::lerp(p, joint.edge[i], share));
        square += std::pow((joint.edge[i] - p) / p, 2);
      }
      check_close("joint distance against its edge (relative)", std::sqrt(square), r, 2e-14);
      return values;
    };
    CHECK(verdict_at(scene, joint.parameters, moved(1.0 - 1e-7)) == margin.verdict);
    CHECK(verdict_at(scene, joint.parameters, moved(1.0 + 1e-7)) == other(margin.verdict));
    for (int trial = 0; trial < 100; ++trial) {
      std::vector<double> direction;
      double square = 0.0;
      for (std::size_t i = 0; i < joint.parameters.size(); ++i) {
        direction.push_back(std::rand() / (0.5 * RAND_MAX) - 1.0);
        square += direction.back() * direction.back();
      }
      for (std::size_t i = 0; i < direction.size(); ++i)
        direction[i] =
            parameter(scene, joint.parameters[i]) * (1.0 + 0.999 * r * direction[i] / std::sqrt(square));
      CHECK(verdict_at(scene, joint.parameters, direction) == margin.verdict);
    }
  }
}

TEST_CASE("edges move as their sensitivities say, for every model",
          "[chart][margin][sensitivity][ratchet][slow]") {
  Scene damped = coupled_scene(3.0);
  damped.linear->damping.mean = Eigen::Matrix2d{{0.05, 0.01}, {0.0, 0.1}};
  Scene hill;
  hill.hill = HillTable{.period = 5.0, .mean = 0.9, .harmonics = {{1, 0.4, 0.0}, {3, 0.1, 0.2}}};
  const std::vector<std::pair<Scene, std::string>> cases{
      {mathieu_scene(0.6, 0.4), "mathieu.delta"},
      {mathieu_scene(1.4, 0.7, 0.05), "mathieu.epsilon"},
      {rod(Equilibrium::hanging, 0.05, 12.0, 0.1), "support.frequency"},
      {rod(Equilibrium::inverted, 0.05, 120.0), "support.amplitude"},
      {hill, "hill.mean"},
      {square_scene(0.8, 0.3), "hill.mean"},
      {damped, "linear.period"}};
  MonodromyEngine engine;
  for (const auto& [scene, along] : cases) {
    const auto first = stability_margin(scene, {along}, {.tolerance = 1e-10}).parameters.front();
    const bool lower = first.lower_edge && (!first.upper_edge || first.value - *first.lower_edge <=
                                                                     *first.upper_edge - first.value);
    const double position = lower ? *first.lower_edge : *first.upper_edge;
    Scene on_edge = scene;
    parameter(on_edge, along) = position;
    for (const std::string& by : stability_parameters(scene)) {
      const double value = parameter(scene, by), step = 1e-3 * std::max(0.1, std::abs(value));
      if (by == along || value == 0.0) continue;
      CAPTURE(describe(scene), along, by);
      const auto edge_at = [&, way = along](double p) {
        Scene moved = scene;
        parameter(moved, by) = p;
        const auto row = stability_margin(moved, {way}, {.tolerance = 1e-10}).parameters.front();
        return lower ? *row.lower_edge : *row.upper_edge;
      };
      const double expected = (8.0 * (edge_at(value + step) - edge_at(value - step)) -
                               (edge_at(value + 2 * step) - edge_at(value - 2 * step))) /
                              (12.0 * step);
      const Derivative found = edge_shift(engine, on_edge, along, by);
      check_within("bound of the shift of an edge over max(1; |shift|)",
                   found.error / std::max(1.0, std::abs(found.value)), 3e-10);
      CHECK(std::abs(found.value - expected) <= found.error + 1e-7 * std::max(1.0, std::abs(expected)));
    }
    CHECK(edge_shift(engine, on_edge, along, along).value == 0.0);
  }
}

TEST_CASE("a thin tongue beside the design is not overlooked", "[chart][margin]") {
  // tongue 6 at epsilon = 0.01 is 2e-18 wide
  const auto row = stability_margin(mathieu_scene(9.1, 0.01), {"mathieu.delta"}).parameters.front();
  CHECK(row.tongue == 6);
  CHECK(*row.lower_edge == Approx(9.000001428571).epsilon(1e-12));
}

TEST_CASE("beyond a thousand tongues the distance is not known, and said to be so", "[chart][margin]") {
  const auto margin = stability_margin(mathieu_scene(1e6, 10.0), {"mathieu.delta"});
  CHECK(std::isnan(margin.parameters.front().distance));
  CHECK(std::isnan(margin.joint.distance));
  CHECK(margin.parameters.front().outcome == Outcome::tolerance_not_reached);
  CHECK(margin.joint.outcome == Outcome::tolerance_not_reached);
}

TEST_CASE("closed tongues bound nothing", "[chart][margin][ratchet]") {
  const auto margin = stability_margin(mathieu_scene(0.6, 0.0), {"mathieu.delta", "mathieu.epsilon"});
  CHECK(*margin.parameters[0].lower_edge == 0.0);
  CHECK_FALSE(margin.parameters[0].upper_edge);
  CHECK(margin.parameters[0].tongue == 0);
  CHECK(std::isnan(margin.parameters[1].relative_distance));
  CHECK(margin.joint.parameters == std::vector<std::string>{"mathieu.delta"});
  check_close("joint distance of a single parameter (relative)", margin.joint.distance, 1.0, 1e-15);
}

TEST_CASE("a design on the edge has no distance to it", "[chart][margin][ratchet]") {
  const auto boundary = stability_margin(mathieu_scene(0.0, 0.0), {"mathieu.delta"});
  CHECK(boundary.verdict == Verdict::boundary);
  CHECK(boundary.parameters.front().distance == 0.0);
  CHECK(boundary.parameters.front().outcome == Outcome::converged);
  const double edge = characteristic_values(1, 1, 0.8).front().a.value / 4.0;
  const auto unresolved = stability_margin(mathieu_scene(edge, 0.4), {"mathieu.delta"});
  CHECK(unresolved.verdict == Verdict::unresolved);
  CHECK(unresolved.parameters.front().distance == 0.0);
  check_within("bound of the distance of a design on an edge", unresolved.parameters.front().error, 1.5e-14);
  CHECK(unresolved.parameters.front().outcome == Outcome::tolerance_not_reached);
}

TEST_CASE("parameters without influence have no edges", "[chart][margin][ratchet]") {
  const Scene scene = rod(Equilibrium::hanging, 0.05, 12.0);
  const auto margin = stability_margin(scene, {"support.phase", "pendulum.mass", "support.frequency"});
  for (const std::size_t i : {0, 1}) {
    CHECK(std::isinf(margin.parameters[i].distance));
    CHECK_FALSE(margin.parameters[i].lower_edge);
  }
  CHECK(margin.joint.parameters == std::vector<std::string>{"support.frequency"});
  check_close("joint distance of a single parameter (relative)", margin.joint.distance,
              margin.parameters[2].relative_distance, 1e-15);
  const auto all = stability_parameters(scene);
  CHECK(all == std::vector<std::string>{"pendulum.length", "pendulum.gravity", "pendulum.damping",
                                        "support.amplitude", "support.frequency"});
  CHECK(stability_parameters(coupled_scene(2.2)).size() == 7);  // what breaks the symmetry is left out
}

TEST_CASE("the margin does not depend on the number of threads", "[chart][margin]") {
  const Scene scene = rod(Equilibrium::inverted, 0.05, 120.0);
  const auto one = stability_margin(scene, stability_parameters(scene), {.threads = 1}),
             two = stability_margin(scene, stability_parameters(scene), {.threads = 2});
  CHECK(one.joint.distance == two.joint.distance);
  for (std::size_t i = 0; i < one.parameters.size(); ++i)
    CHECK(one.parameters[i].distance == two.parameters[i].distance);
}

TEST_CASE("margin refuses what it cannot answer", "[chart][margin]") {
  const Scene scene = mathieu_scene(0.6, 0.4);
  CHECK_THROWS_AS(stability_margin(scene, {"mathieu.detla"}), InvalidInput);
  CHECK_THROWS_AS(stability_margin(scene, {}, {.tolerance = 1e-14}), InvalidInput);
  CHECK_THROWS_AS(stability_margin(scene, {}, {.reach = 1.0}), InvalidInput);
  CHECK_THROWS_AS(stability_margin(scene, {}, {.reach = NAN}), InvalidInput);
  CHECK_THROWS_AS(stability_margin(mathieu_scene(NAN, 0.4), {"mathieu.delta"}), InvalidInput);
}

}  // namespace strutt::test::stability_margin_test
