#include "strutt/chart/worst_growth.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "strutt/base/error.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"
#include "support/scenes.hpp"

namespace strutt::test::worst_growth_test {
namespace {

Scene square_scene() {
  Scene scene;
  scene.hill = HillTable{.waveform = Waveform::square, .period = 6.0, .mean = 0.8, .amplitude = 0.3};
  return scene;
}

double growth_at(Scene scene, const std::vector<ParameterRange>& box, const std::vector<double>& values) {
  static MonodromyEngine engine;
  for (std::size_t i = 0; i < box.size(); ++i) parameter(scene, box[i].parameter) = values[i];
  return analyse(engine, linear_model(scene), {.tolerance = 1e-12}).growth;
}

}  // namespace

TEST_CASE("no point of a box grows faster than the bound, and one grows as fast as is said", "[chart][box]") {
  struct Case {
    Scene scene;
    std::vector<ParameterRange> box;
  };
  const std::vector<Case> cases{
      {mathieu_scene(0.3, 0.2), {{"mathieu.delta", 0.0, 0.6}}},
      {mathieu_scene(0.3, 0.2, 0.05), {{"mathieu.delta", 0.2, 0.3}, {"mathieu.epsilon", 0.1, 0.25}}},
      {mathieu_scene(1.0, 0.2), {{"mathieu.delta", 0.6, 0.7}, {"mathieu.epsilon", 0.0, 0.1}}},  // stable
      {rod(Equilibrium::hanging, 0.1, 8.0, 0.1),
       {{"support.frequency", 7.0, 9.0}, {"pendulum.damping", 0.05, 0.3}, {"support.amplitude", 0.05, 0.1}}},
      {rod(Equilibrium::inverted, 0.05, 80.0),
       {{"support.frequency", 60.0, 100.0}, {"pendulum.length", 0.8, 1.2}}},
      {square_scene(), {{"hill.period", 5.0, 7.0}, {"hill.amplitude", -0.2, 0.4}}}};
  std::mt19937_64 random(11);
  for (const auto& [scene, box] : cases) {
    CAPTURE(describe(scene), box.front().parameter);
    const WorstGrowth worst = worst_growth(scene, box);
    CHECK(worst.proved);
    CHECK(worst.error <= 0.05);
    CHECK(worst.growth == growth_at(scene, box, worst.at));
    CHECK((worst.outcome == Outcome::converged) == (worst.error <= 1e-3));
    double most = -HUGE_VAL;
    for (int k = 0; k < 2000; ++k) {
      std::vector<double> values;
      for (const auto& range : box)
        values.push_back(std::uniform_real_distribution(range.from, range.to)(random));
      most = std::max(most, growth_at(scene, box, values));
    }
    CHECK(most <= worst.growth + 1e-9);  // the search itself misses nothing here
    CHECK(most <= worst.growth + worst.error);
    for (std::size_t i = 0; i < box.size(); ++i) {
      CHECK(worst.at[i] >= box[i].from);
      CHECK(worst.at[i] <= box[i].to);
    }
  }
}

TEST_CASE("over one tongue the worst growth is the largest growth of the tongue", "[chart][box][ratchet]") {
  const Scene scene = mathieu_scene(0.3, 0.2);
  const WorstGrowth worst = worst_growth(scene, {{"mathieu.delta", 0.0, 0.6}}, {.tolerance = 1e-6});
  const auto edges = tongues(scene, {"mathieu.delta", 0.05, 0.6}, {.growth = true});
  REQUIRE(edges.size() == 2);
  CHECK(worst.outcome == Outcome::converged);
  CHECK(worst.error <= 1e-6);
  check_close("worst growth over one tongue against its largest (relative)", worst.growth,
              edges.front().growth, 2.5e-15);
  check_close("place of the worst growth over one tongue (relative)", worst.at.front(),
              edges.front().growth_position, 3e-8);
}

TEST_CASE("a box of systems is searched from two sets of points", "[chart][box]") {
  Scene scene;
  LinearPeriodicSystem system;
  system.period = 3.0;
  system.mass = Eigen::Matrix2d::Identity();
  system.stiffness.mean = Eigen::Matrix2d{{1.3, -0.3}, {-0.3, 2.3}};
  system.stiffness.harmonics = {{1, Eigen::Matrix2d{{0.4, 0.0}, {0.0, 0.0}}, Eigen::MatrixXd()}};
  scene.linear = system;
  const std::vector<ParameterRange> box{{"linear.period", 2.5, 3.2}, {"linear.stiffness.mean.0.0", 1.2, 1.4}};
  const WorstGrowth worst = worst_growth(scene, box);
  CHECK_FALSE(worst.proved);
  CHECK(worst.error < 1e-3);
  CHECK(worst.growth > 0.1);
  CHECK(worst.growth == growth_at(scene, box, worst.at));
}

TEST_CASE("a point is its own box", "[chart][box][ratchet]") {
  const WorstGrowth worst = worst_growth(mathieu_scene(0.3, 0.2), {{"mathieu.delta", 0.25, 0.25}});
  CHECK(worst.growth == growth_at(mathieu_scene(0.25, 0.2), {}, {}));
  check_within("bound of the growth at a point", worst.error, 6e-12);
}

TEST_CASE("worst growth refuses what it cannot answer", "[chart][box]") {
  const Scene scene = rod(Equilibrium::hanging, 0.1, 8.0);
  CHECK_THROWS_AS(worst_growth(scene, {}), InvalidInput);
  CHECK_THROWS_AS(worst_growth(scene, {{"support.phase", 0.0, 1.0}}), InvalidInput);
  CHECK_THROWS_AS(worst_growth(scene, {{"support.frequency", 0.0, 1.0}}), InvalidInput);
  CHECK_THROWS_AS(worst_growth(scene, {{"support.frequency", 2.0, 1.0}}), InvalidInput);
  CHECK_THROWS_AS(worst_growth(scene, {{"support.frequency", 2.0, NAN}}), InvalidInput);
  CHECK_THROWS_AS(worst_growth(scene, {{"support.frequncy", 2.0, 3.0}}), InvalidInput);
  CHECK_THROWS_AS(worst_growth(scene, {{"support.frequency", 2.0, 3.0}, {"support.frequency", 2.0, 3.0}}),
                  InvalidInput);
  CHECK_THROWS_AS(worst_growth(scene, {{"support.frequency", 2.0, 3.0}}, {.tolerance = 1.0}), InvalidInput);
  CHECK_THROWS_AS(worst_growth(scene, {{"support.frequency", 2.0, 3.0}}, {.evaluations = 1}), InvalidInput);
}

}  // namespace strutt::test::worst_growth_test
