// What is done before a verdict is left open.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "strutt/floquet/stability.hpp"
#include "support/hill_edges.hpp"
#include "support/random_systems.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::open_verdict_test {
namespace {

using std::numbers::pi;

constexpr StabilityParts kNotAsked{.verdict = false, .winding = false, .matrix = false};
constexpr StabilityParts kAsked{.verdict = true, .winding = false, .matrix = false};

std::vector<LinearModel> mathieu_points(const std::vector<double>& delta, double epsilon,
                                        double damping = 0.0) {
  std::vector<LinearModel> models;
  for (const double d : delta) models.push_back(mathieu_delta_epsilon(d, epsilon, damping));
  return models;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same(const Stability& a, const Stability& b) {
  return a.verdict == b.verdict && same_bits(a.margin, b.margin) &&
         same_bits(a.margin_error, b.margin_error) && same_bits(a.growth, b.growth) &&
         same_bits(a.error, b.error) && a.method == b.method && a.outcome == b.outcome &&
         a.cost.right_hand_sides == b.cost.right_hand_sides && a.cost.steps == b.cost.steps;
}

/// Random points about the first tongues, two thirds of them 1e-12 to 1e-3 beside an edge.
std::vector<double> points_about(const HillEdges& edges, std::size_t count) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> delta;
  while (delta.size() < count) {
    const double edge = edges[random() % (edges.size() - 1)].value;
    const double distance = std::pow(10.0, -12.0 + 9.0 * unit(random));
    delta.push_back(unit(random) < 0.33 ? std::lerp(-0.5, 5.0, unit(random))
                                        : edge + (unit(random) < 0.5 ? -distance : distance));
  }
  return delta;
}

}  // namespace

TEST_CASE("beside an edge a coarse tolerance decides what a fine one does",
          "[floquet][verdict][extreme][N18]") {
  const auto [method, distance] = GENERATE(std::pair(Method::automatic, 1e-11),
                                           std::pair(Method::arkode, 1e-10), std::pair(Method::cvode, 3e-10));
  const double tolerance = GENERATE(1e-5, 1e-7), epsilon = 0.5;
  const HillEdges edges(epsilon, 4);
  std::vector<double> delta;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    for (const double side : {-distance, distance}) delta.push_back(edges[k].value + side);
  const auto models = mathieu_points(delta, epsilon);
  MonodromyEngine engine;
  const MonodromyOptions options{.tolerance = tolerance, .method = method};
  const auto before = analyse(engine, models, options, kNotAsked);
  const auto found = analyse(engine, models, options, kAsked);
  for (std::size_t k = 0; k < delta.size(); ++k) {
    CAPTURE(to_string(method), tolerance, delta[k], before[k].margin_error, found[k].margin_error);
    REQUIRE(before[k].verdict == Verdict::unresolved);
    CHECK(found[k].verdict == edges.at(delta[k]));
    CHECK(found[k].outcome == Outcome::converged);
    CHECK(found[k].error <= tolerance);
  }
}

TEST_CASE("damped equations and systems are looked at again, too", "[floquet][verdict][extreme][N18]") {
  MonodromyEngine engine;
  const auto check = [&](const LinearModel& model, double tolerance) {
    const auto before = analyse(engine, model, {.tolerance = tolerance}, kNotAsked);
    const auto found = analyse(engine, model, {.tolerance = tolerance}, kAsked);
    const auto fine = analyse(engine, model, {.tolerance = 1e-13}, kNotAsked);
    REQUIRE(before.verdict == Verdict::unresolved);
    REQUIRE((fine.verdict == Verdict::stable || fine.verdict == Verdict::unstable));
    CHECK(found.verdict == fine.verdict);
    CHECK(found.margin_error <= 4.0 * fine.margin_error + 1e-15);
  };
  const auto damped = [](double delta) { return mathieu_delta_epsilon(delta, 0.5, 0.1); };
  double unstable = 0.25, stable = 0.6;  // of tongue 1
  while (stable - unstable > 1e-12) {
    const double middle = std::midpoint(unstable, stable);
    (analyse(engine, damped(middle), {.tolerance = 1e-13}).margin > 0.0 ? stable : unstable) = middle;
  }
  // two oscillators whose uncoupled tongues are those of Mathieu
  const HillEdges edges(0.5, 3);
  const Eigen::Matrix2d turn{{0.8, -0.6}, {0.6, 0.8}};
  const auto system = [&](double delta) {
    LinearPeriodicSystem result{
        .period = 2.0 * pi, .mass = Eigen::Matrix2d::Identity(), .damping = {}, .stiffness = {}};
    result.stiffness.mean = turn * Eigen::Vector2d(delta, 0.6).asDiagonal() * turn.transpose();
    result.stiffness.harmonics = {
        {1, turn * Eigen::Vector2d(0.5, 0.0).asDiagonal() * turn.transpose(), Eigen::Matrix2d::Zero()}};
    return result;
  };
  for (const double side : {-1e-9, 1e-9}) {
    check(system(edges[2].value + 1e3 * side), 1e-3);
    check(damped(stable + side), 1e-6);
  }
}

TEST_CASE("a point on an edge stays open at every tolerance", "[floquet][verdict][extreme][N18][ratchet]") {
  const HillEdges edges(0.5, 3);
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 0.7);
  const auto resonant = sinusoidal_support(0.0, 2.0 * rod.alpha());  // 1/4 but for roundings of the model
  MonodromyEngine engine;
  for (const double tolerance : {1e-2, 1e-5, 1e-9, 1e-13}) {
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      CAPTURE(tolerance, k);
      const auto found =
          analyse(engine, mathieu_delta_epsilon(edges[k].value, 0.5), {.tolerance = tolerance});
      CHECK(found.verdict == Verdict::unresolved);
      check_within("N18 bound of the margin on an edge of Mathieu's equation", found.margin_error, 1e-13);
      CHECK(found.outcome == Outcome::converged);
    }
    const auto model = linearise(rod, Equilibrium::hanging, &resonant).equation;
    CHECK(analyse(engine, model, {.tolerance = tolerance}).verdict == Verdict::unresolved);
  }
}

TEST_CASE("only an open verdict costs more, and only where one is wanted",
          "[floquet][verdict][extreme][N18]") {
  const auto method = GENERATE(Method::automatic, Method::arkode);
  const double tolerance = 1e-6, epsilon = 0.5;
  const auto delta = points_about(HillEdges(epsilon, 4), method == Method::arkode ? 40 : 400);
  const auto models = mathieu_points(delta, epsilon);
  MonodromyEngine engine;
  const MonodromyOptions options{.tolerance = tolerance, .method = method};
  auto sharpest = options;
  sharpest.sharpest = true;
  const auto plain = analyse(engine, models, options, kNotAsked);
  const auto found = analyse(engine, models, options, kAsked);
  std::size_t open = 0;
  for (std::size_t k = 0; k < models.size(); ++k) {
    const auto& equation = std::get<HillEquation>(models[k]);
    const auto once = engine.compute(equation, options);
    CAPTURE(delta[k]);
    CHECK(plain[k].cost.right_hand_sides == once.cost.right_hand_sides);
    if (plain[k].verdict != Verdict::unresolved) {
      CHECK(same(found[k], plain[k]));
      continue;
    }
    ++open;
    const auto again = engine.compute(equation, sharpest);
    CHECK(found[k].cost.right_hand_sides == once.cost.right_hand_sides + again.cost.right_hand_sides);
    CHECK(found[k].cost.steps == once.cost.steps + again.cost.steps);
    CHECK(found[k].margin_error < 1e-2 * plain[k].margin_error);
  }
  CHECK(open > models.size() / 10);
  CHECK(open < models.size() * 9 / 10);
}

TEST_CASE("what is sharp already, or exact, is not computed again", "[floquet][verdict]") {
  MonodromyEngine engine;
  const auto square = hill_equation(2.0 * pi, PeriodicFunction::square(5.0, 4.0, 0.0));
  const auto once = engine.compute(square, {.tolerance = 1e-4});
  CHECK(once.sharpest);
  CHECK(analyse(engine, square, {.tolerance = 1e-4}).cost.right_hand_sides == once.cost.right_hand_sides);
  const auto equation = mathieu_delta_epsilon(1.0, 0.5);
  CHECK_FALSE(engine.compute(equation, {.tolerance = 1e-4}).sharpest);
  const auto sharp = engine.compute(equation, {.tolerance = 1e-4, .sharpest = true});
  CHECK(sharp.sharpest);
  CHECK(sharp.outcome == Outcome::converged);
  CHECK(sharp.error <= engine.compute(equation, {.tolerance = 1e-13}).error);
}

TEST_CASE("open verdicts of a batch are those of its points one by one", "[floquet][verdict][extreme][N48]") {
  const double epsilon = 0.5;
  const auto delta = points_about(HillEdges(epsilon, 4), 150);
  auto models = mathieu_points(delta, epsilon);
  models.insert(models.begin() + 40, RandomSystems(3).next());
  MonodromyEngine engine;
  const auto together = analyse(engine, models, {.tolerance = 1e-5});
  for (std::size_t k = 0; k < models.size(); ++k) {
    MonodromyEngine own;
    CAPTURE(k);
    CHECK(same(together[k], analyse(own, models[k], {.tolerance = 1e-5})));
  }
}

TEST_CASE("a coarse tolerance tells a stabilised inverted pendulum from one that falls",
          "[floquet][verdict][extreme][N12]") {
  // margins of 4e-7 to 2e-13, see "Far above its frequency an inverted pendulum has the margin of its mean
  // equation"
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 0.7);
  MonodromyEngine engine;
  for (const double tolerance : {1e-2, 1e-5, 1e-9})
    for (const double ratio : {1e3, 1e5, 1e6})
      for (const double s : {0.9, 1.1}) {
        const double amplitude = s * std::sqrt(2.0) / ratio / 1.5 * 0.7;
        const auto support = sinusoidal_support(amplitude, ratio * rod.alpha());
        const auto found = analyse(engine, linearise(rod, Equilibrium::inverted, &support).equation,
                                   {.tolerance = tolerance});
        CAPTURE(tolerance, ratio, s, found.margin, found.margin_error);
        CHECK(found.verdict == (s > 1.0 ? Verdict::stable : Verdict::unstable));
      }
}

}  // namespace strutt::test::open_verdict_test
