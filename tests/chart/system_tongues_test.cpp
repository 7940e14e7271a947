// tongues() of systems, and of [linear] scenes that are an equation of second order.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::system_tongues_test {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using std::numbers::pi;

Scene system_scene(const MatrixXd& mean, const MatrixXd& cosine, double damping = 0.0) {
  Scene scene;
  LinearPeriodicSystem system{
      .mass = MatrixXd::Identity(mean.rows(), mean.rows()), .damping = {}, .stiffness = {}};
  system.stiffness.mean = mean;
  system.stiffness.harmonics = {{1, cosine, MatrixXd::Zero(mean.rows(), mean.rows())}};
  if (damping != 0.0) system.damping.mean = damping * system.mass;
  scene.linear = system;
  return scene;
}

Verdict verdict_at(Scene scene, const std::string& path, double value) {
  parameter(scene, path) = value;
  MonodromyEngine engine;
  return analyse(engine, linear_model(scene), {.tolerance = 1e-13}).verdict;
}

}  // namespace

TEST_CASE("two oscillators that are not coupled have the tongues of both", "[chart][tongues][ratchet]") {
  Matrix2d mean, cosine;
  mean << 1.0, 0.0, 0.0, 100.3;  // the other one is far from its tongues
  cosine << 0.5, 0.0, 0.0, 0.0;
  const auto edges =
      tongues(system_scene(mean, cosine), {"linear.stiffness.mean.0.0", -0.1, 3.0}, {.tolerance = 1e-9});
  const auto known = characteristic_values(0, 3, 1.0);
  REQUIRE(edges.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& pair = known[i / 2 + 1];
    const double expected = 0.25 * (edges[i].upper ? pair.a.value : pair.b->value);
    CAPTURE(i, edges[i].position, expected);
    CHECK(edges[i].upper == (i % 2 == 1));
    CHECK(edges[i].order == kNoOrder);
    CHECK(edges[i].crossing == static_cast<int>(i / 2));
    CHECK(std::abs(edges[i].position - expected) <= edges[i].error * std::max(1.0, expected) + 1e-14);
    check_within("bound of an edge of a system along a stiffness", edges[i].error, 5e-11);
    CHECK(edges[i].mechanism == (i / 2 % 2 == 0 ? Mechanism::minus_one : Mechanism::plus_one));
  }
}

TEST_CASE("a combination resonance lies at the sum of the frequencies", "[chart][tongues][ratchet]") {
  // q'' + diag(w1^2, w2^2) q + epsilon B q cos Omega t = 0: unstable for |Omega - w1 - w2| < epsilon sqrt(b12
  // b21/(w1 w2))/2 to first order (Nayfeh, Mook, Nonlinear Oscillations, section 5.3)
  const double w1 = 1.0, w2 = std::sqrt(2.0), epsilon = 1e-3;
  Matrix2d mean, cosine;
  mean << 1.0, 0.0, 0.0, 2.0;
  cosine << 0.0, epsilon, epsilon, 0.0;
  const double at = 2.0 * pi / (w1 + w2);
  const Scene scene = system_scene(mean, cosine);
  const auto edges = tongues(scene, {"linear.period", at - 0.4, at + 0.4}, {.tolerance = 1e-9});
  REQUIRE(edges.size() == 2);
  const double low = 2.0 * pi / edges[1].position, high = 2.0 * pi / edges[0].position;
  check_close("width of a combination resonance against first order (relative)", high - low,
              epsilon / std::sqrt(w1 * w2), 4e-8);
  check_close("place of a combination resonance against first order (relative)", 0.5 * (high + low), w1 + w2,
              2.5e-8);
  for (const TongueEdge& edge : edges) {
    CHECK(edge.mechanism == Mechanism::complex_pair);
    check_within("bound of an edge of a combination resonance", edge.error, 1e-13);
    const double inwards = edge.upper ? -1.0 : 1.0;
    CHECK(verdict_at(scene, "linear.period", edge.position + inwards * 1e-9) == Verdict::unstable);
    CHECK(verdict_at(scene, "linear.period", edge.position - inwards * 1e-9) == Verdict::stable);
  }
  // the difference of the frequencies is no resonance of a symmetric system
  const double difference = 2.0 * pi / (w2 - w1);
  CHECK(tongues(scene, {"linear.period", difference - 0.05, difference + 0.05}).empty());
}

TEST_CASE("tongues narrower than a step show in the gap between multipliers", "[chart][tongues][ratchet]") {
  Matrix2d mean, cosine;
  mean << 1.0, 0.0, 0.0, 2.0;
  cosine << 0.0, 1e-6, 1e-6, 0.0;
  const double at = 2.0 * pi / (1.0 + std::sqrt(2.0));
  const auto edges =
      tongues(system_scene(mean, cosine), {"linear.period", at - 0.5, at + 0.5}, {.tolerance = 1e-6});
  REQUIRE(edges.size() == 2);
  const double width = 1e-6 / std::pow(2.0, 0.25) * at * at / (2.0 * pi);
  check_close("width of a combination resonance of 1e-6 against first order (relative)", edges[0].width,
              width, 2e-7);
}

TEST_CASE("a combination resonance is found wherever the steps fall", "[chart][tongues]") {
  Matrix2d mean, cosine;
  mean << 1.0, 0.0, 0.0, 2.0;
  cosine << 0.0, 1e-3, 1e-3, 0.0;
  const Scene scene = system_scene(mean, cosine);
  const double at = 2.0 * pi / (1.0 + std::sqrt(2.0));
  for (int i = 0; i < 20; ++i) {
    const double shift = 1e-2 * i / 20.0;  // a step is 1e-2, the tongue 1e-3 wide
    CAPTURE(shift);
    CHECK(tongues(scene, {"linear.period", at - 0.4 + shift, at + 0.4 + shift},
                  {.tolerance = 1e-9, .system_steps = 80})
              .size() == 2);
  }
}

TEST_CASE("simple resonances of the coupled pendulums meet the default tolerance",
          "[chart][tongues][ratchet]") {
  // docs/examples/coupled_pendulums.toml; the tongue at 6.11 is 1.5e-3 wide, where the margin is flat
  Matrix2d mean, cosine;
  mean << 1.3, -0.3, -0.3, 2.3;
  cosine << 0.4, 0.0, 0.0, 0.0;
  const auto edges = tongues(system_scene(mean, cosine), {"linear.period", 1.2, 8.0});
  REQUIRE(edges.size() == 16);
  for (const TongueEdge& edge : edges) {
    CAPTURE(edge.position);
    CHECK(edge.outcome == Outcome::converged);
    check_within("bound of an edge of coupled pendulums", edge.error, 8e-13);
  }
}

TEST_CASE("sharpened edges of a thin tongue are those of its equation", "[chart][tongues][ratchet]") {
  // Uncoupled in rotated coordinates: tongue 2 of Mathieu's equation is 5e-5 wide at epsilon = 0.01.
  Matrix2d rotation;
  rotation << 0.6, -0.8, 0.8, 0.6;
  const auto rotated = [&](double first, double second) {
    const Matrix2d m = rotation * Eigen::Vector2d(first, second).asDiagonal() * rotation.transpose();
    return MatrixXd(0.5 * (m + m.transpose()));  // symmetric to the last bit
  };
  const Scene scene = system_scene(rotated(1.0, 100.3), rotated(0.01, 0.0));
  const auto edges = tongues(scene, {"linear.period", 2.0 * pi - 1e-2, 2.0 * pi + 1e-2});
  REQUIRE(edges.size() == 2);
  Scene one;
  one.linear = LinearPeriodicSystem{
      .period = 2.0 * pi, .mass = MatrixXd::Identity(1, 1), .damping = {}, .stiffness = {}};
  one.linear->stiffness.mean = MatrixXd::Identity(1, 1);
  one.linear->stiffness.harmonics = {{1, 0.01 * MatrixXd::Identity(1, 1), MatrixXd::Zero(1, 1)}};
  const auto expected = tongues(one, {"linear.period", 2.0 * pi - 1e-2, 2.0 * pi + 1e-2});
  REQUIRE(expected.size() == 2);  // by eigenvalues of Fourier matrices
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(std::abs(edges[i].position - expected[i].position) <
          (edges[i].error + expected[i].error) * edges[i].position + 1e-13);
    check_within("bound of a sharpened edge of a system", edges[i].error, 1e-12);
    CHECK(edges[i].mechanism == Mechanism::plus_one);
  }
}

TEST_CASE("damping narrows a simple resonance of a system as it does a tongue", "[chart][tongues][ratchet]") {
  Matrix2d mean, cosine;
  mean << 1.0, 0.0, 0.0, 100.3;
  cosine << 0.5, 0.0, 0.0, 0.0;
  Scene one;
  one.mathieu = MathieuTable{.delta = 1.0, .epsilon = 0.5, .damping = 0.1};
  const auto expected = tongues(one, {"mathieu.delta", 0.05, 0.8});
  const auto edges =
      tongues(system_scene(mean, cosine, 0.1), {"linear.stiffness.mean.0.0", 0.05, 0.8}, {.tolerance = 1e-9});
  REQUIRE(expected.size() == 1);
  REQUIRE(edges.size() == 1);
  CHECK(edges[0].upper);
  check_close("edge of a damped resonance of a system against its equation (relative)", edges[0].position,
              expected[0].position, 8e-16);
}

TEST_CASE("[linear] with one degree of freedom has the tongues of its equation",
          "[chart][tongues][ratchet]") {
  MatrixXd mean(1, 1), cosine(1, 1);
  mean << 1.0;
  cosine << 0.5;
  for (const double damping : {0.0, 0.02}) {
    Scene one;
    one.mathieu = MathieuTable{.delta = 1.0, .epsilon = 0.5, .damping = damping};
    const auto expected = tongues(one, {"mathieu.delta", -1.0, 5.0});
    const auto edges = tongues(system_scene(mean, cosine, damping), {"linear.stiffness.mean.0.0", -1.0, 5.0});
    REQUIRE(edges.size() == expected.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      CHECK(edges[i].order == expected[i].order);
      check_close("edge of a system of one degree of freedom against its equation (relative)",
                  edges[i].position, expected[i].position, 8e-16);
      CHECK(edges[i].mechanism == (edges[i].order % 2 == 0 ? Mechanism::plus_one : Mechanism::minus_one));
    }
  }
}

TEST_CASE("edges of a gyroscopic system are found, and not claimed to be proved",
          "[chart][tongues][ratchet]") {
  Matrix2d mean, cosine, gyroscopic;
  mean << 1.0, 0.0, 0.0, 2.0;
  cosine << 0.1, 0.2, 0.2, 0.1;
  gyroscopic << 0.0, 0.4, -0.4, 0.0;
  Scene scene = system_scene(mean, cosine);
  scene.linear->damping.mean = gyroscopic;
  const auto edges = tongues(scene, {"linear.period", 2.4, 2.8}, {.tolerance = 1e-9});
  REQUIRE(edges.size() == 2);
  for (const TongueEdge& edge : edges) {
    CHECK(edge.outcome == Outcome::tolerance_not_reached);
    CHECK(edge.mechanism == Mechanism::complex_pair);
    check_within("bound of an edge of a gyroscopic system", edge.error, 0.0005);
    const double inwards = edge.upper ? -1.0 : 1.0;
    CHECK(verdict_at(scene, "linear.period", edge.position + inwards * 1e-6) == Verdict::unstable);
    CHECK(verdict_at(scene, "linear.period", edge.position - inwards * 1e-6) == Verdict::unresolved);
  }
}

TEST_CASE("systems have no index", "[chart][tongues]") {
  Matrix2d mean, cosine;
  mean << 1.0, 0.1, 0.1, 2.0;
  cosine << 0.1, 0.0, 0.0, 0.1;
  const Scene scene = system_scene(mean, cosine);
  const TongueLine line{"linear.period", 2.0, 3.0};
  CHECK_FALSE(has_tongue_index(scene, line));
  CHECK_THROWS_AS(tongue_count(scene, line), InvalidInput);
  CHECK_THROWS_AS(tongues(scene, line, {.count = 2}), InvalidInput);
  CHECK(tongue_method(scene, line) == Method::propagator);
}

}  // namespace strutt::test::system_tongues_test
