#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::multipliers_test {

using strutt::test::check_close;
using strutt::test::check_within;

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

LinearPeriodicSystem oscillators(double k1, double k2, double coupling, double epsilon, double c = 0.0) {
  LinearPeriodicSystem system;
  system.mass = Eigen::Matrix2d::Identity();
  if (c != 0.0) system.damping.mean = c * system.mass;
  system.stiffness = {Eigen::MatrixXd{{k1, coupling}, {coupling, k2}},
                      {{1, Eigen::MatrixXd{{0.0, epsilon}, {epsilon, 0.0}}, {}}}};
  return system;
}

Stability at(const LinearModel& model, double tolerance = 1e-10) {
  MonodromyEngine engine;
  return analyse(engine, model, {.tolerance = tolerance});
}

}  // namespace

TEST_CASE("Multipliers of a 2 x 2 system: product, sum, order", "[floquet][multipliers][law][ratchet]") {
  for (const double delta : {-2.0, 0.3, 1.0, 3.7}) {
    for (const double c : {0.0, 0.1, 3.0}) {
      const auto result = at(mathieu_delta_epsilon(delta, 1.2, c));
      REQUIRE(result.multipliers.size() == 2);
      const auto product = result.multipliers[0] * result.multipliers[1];
      const auto sum = result.multipliers[0] + result.multipliers[1];
      check_within("product of two multipliers (relative)", std::abs(product * std::exp(kTwoPi * c) - 1.0),
                   8e-15);
      const double size = std::max(1.0, std::abs(result.discriminant));
      check_within("sum of two multipliers against the trace (scaled)",
                   std::abs(sum - result.discriminant) / size, 1e-14);
      CHECK(std::abs(result.multipliers[0]) >= std::abs(result.multipliers[1]) * (1.0 - 1e-15));
      check_within("logarithm of the largest of two multipliers against the growth",
                   std::abs(std::log(std::abs(result.multipliers[0])) - result.growth), 3e-15);
      if (result.multipliers[0].imag() != 0.0) CHECK(result.multipliers[0].imag() > 0.0);
    }
  }
}

TEST_CASE("The small multiplier survives beside a huge one",
          "[floquet][multipliers][extreme][N02][ratchet]") {
  const auto result = at(mathieu_delta_epsilon(-36.0, 0.5));
  const double product = (result.multipliers[0] * result.multipliers[1]).real();
  check_close("N02 product of multipliers up to exp(38) (relative)", product, 1.0, 8e-16);
  CHECK(std::abs(result.multipliers[0]) > 1e15);
}

TEST_CASE("Uncoupled oscillators have the multipliers of each", "[floquet][multipliers][ratchet]") {
  const auto result = at(oscillators(1.3, 2.9, 0.0, 0.0));
  CHECK(result.verdict == Verdict::stable);
  CHECK(result.growth == 0.0);
  CHECK(std::isnan(result.winding));
  const double expected = std::min(1.0 - std::abs(std::cos(kTwoPi * std::sqrt(1.3))),
                                   1.0 - std::abs(std::cos(kTwoPi * std::sqrt(2.9))));
  CHECK(std::abs(result.margin - expected) <= result.margin_error);
  check_within("bound of the margin of uncoupled oscillators", result.margin_error, 6e-13);
  for (const auto& multiplier : result.multipliers)
    check_close("modulus of the multipliers of uncoupled oscillators", std::abs(multiplier), 1.0, 2e-15);
}

TEST_CASE("Combination resonance: unstable at the sum of the frequencies only",
          "[floquet][multipliers][ratchet]") {
  // off-diagonal excitation at frequency 1 = w1 + w2, first order growth epsilon/(4 sqrt(w1 w2)) * T... for
  // w1 = 0.3, w2 = 0.7
  const auto resonant = at(oscillators(0.09, 0.49, 0.0, 0.02));
  CHECK(resonant.verdict == Verdict::unstable);
  check_close("growth at a combination resonance against first order (relative)", resonant.growth,
              0.02 / (4.0 * std::sqrt(0.21)) * kTwoPi, 0.0015);
  CHECK(resonant.margin == -resonant.growth);
  CHECK(at(oscillators(0.09, 0.60, 0.0, 0.02)).verdict == Verdict::stable);
}

TEST_CASE("Proportional damping shifts growth by cT/2 and closes the resonance",
          "[floquet][multipliers][ratchet]") {
  const double growth = at(oscillators(0.09, 0.49, 0.0, 0.02)).growth;
  const double c = 0.01;
  auto damped = oscillators(0.09 + c * c / 4.0, 0.49 + c * c / 4.0, 0.0, 0.02, c);
  check_close("growth of a damped system (relative)", at(damped).growth, growth - c * kTwoPi / 2.0, 8e-16);
  CHECK(at(oscillators(0.09, 0.49, 0.0, 0.02, 0.05)).verdict == Verdict::stable);
  CHECK(at(oscillators(0.09, 0.49, 0.0, 0.02, 0.05)).margin > 0.0);
}

TEST_CASE("General damping: margin is minus the growth", "[floquet][multipliers][ratchet]") {
  auto system = oscillators(1.3, 2.9, 0.1, 0.0);
  system.damping.mean = Eigen::MatrixXd{{0.2, 0.0}, {0.0, 0.05}};
  const auto result = at(system);
  CHECK(result.verdict == Verdict::stable);
  CHECK(result.margin == -result.growth);
  double trace = 0.0;  // det M = exp(-T trace C)
  for (const auto& multiplier : result.multipliers) trace += std::log(std::abs(multiplier));
  check_close("sum of the logarithms of all multipliers against the damping (relative)", trace,
              -kTwoPi * 0.25, 2e-15);
  system.damping.mean = Eigen::MatrixXd{{0.2, 0.0}, {0.0, -0.05}};
  CHECK(at(system).verdict == Verdict::unstable);
}

TEST_CASE("A gyroscopic system with spectral radius 1 is unresolved", "[floquet][multipliers][ratchet]") {
  auto system = oscillators(1.3, 2.9, 0.0, 0.0);
  system.damping.mean = Eigen::MatrixXd{{0.0, 0.4}, {-0.4, 0.0}};
  const auto result = at(system);
  CHECK(result.verdict == Verdict::unresolved);
  check_within("growth of a gyroscopic system with spectral radius 1", std::abs(result.growth), 4e-15);
}

TEST_CASE("Equal oscillators: colliding roots are unresolved unless another root decides",
          "[floquet][multipliers]") {
  CHECK(at(oscillators(1.3, 1.3, 0.0, 0.0)).verdict == Verdict::unresolved);
  CHECK(at(oscillators(-1.3, -1.3, 0.0, 0.0)).verdict == Verdict::unstable);
}

TEST_CASE("One degree of freedom as a system is the Hill equation it is",
          "[floquet][multipliers][law][ratchet]") {
  LinearPeriodicSystem system;
  system.mass = Eigen::MatrixXd{{2.0}};
  system.damping.mean = Eigen::MatrixXd{{0.2}};
  system.stiffness = {Eigen::MatrixXd{{2.6}}, {{1, Eigen::MatrixXd{{1.0}}, {}}}};
  const auto a = at(system), b = at(mathieu_delta_epsilon(1.3, 0.5, 0.1));
  check_close("margin of a system that is a Hill equation (relative)", a.margin, b.margin, 8e-16);
  check_close("growth of a system that is a Hill equation (relative)", a.growth, b.growth, 8e-16);
  check_within("M of a system that is a Hill equation", (a.matrix - b.matrix).cwiseAbs().maxCoeff(), 8e-16);
  // negative damping is no Hill scene: the general route answers
  system.damping.mean = Eigen::MatrixXd{{-0.2}};
  CHECK(at(system).verdict == Verdict::unstable);
}

TEST_CASE("Three degrees of freedom: block diagonal equals its parts", "[floquet][multipliers][law]") {
  LinearPeriodicSystem system;
  system.mass = Eigen::Matrix3d::Identity();
  system.stiffness = {Eigen::Vector3d(0.7, 1.9, 3.1).asDiagonal(),
                      {{1, Eigen::MatrixXd(Eigen::Vector3d(0.3, 0.1, 0.2).asDiagonal()), {}}}};
  const auto result = at(system);
  double least = 1.0;
  for (int j = 0; j < 3; ++j) {
    const auto part =
        at(mathieu_delta_epsilon(system.stiffness.mean(j, j), system.stiffness.harmonics[0].cosine(j, j)));
    least = std::min(least, part.margin);
  }
  CHECK(std::abs(result.margin - least) <= result.margin_error + 1e-9);
  CHECK(result.matrix.rows() == 6);
}

TEST_CASE("Scale: SI and canonical systems give the same verdict and growth", "[floquet][law][ratchet]") {
  const auto canonical = at(oscillators(0.9, 2.1, 0.2, 0.3));
  auto slow = oscillators(0.9e-6, 2.1e-6, 0.2e-6, 0.3e-6);  // time in milliseconds
  slow.period = kTwoPi * 1e3;
  slow.mass *= 1.0;
  const auto si = at(slow);
  check_within("growth of a system in other units of time", std::abs(si.growth - canonical.growth), 8e-16);
  check_within("margin of a system in other units of time", std::abs(si.margin - canonical.margin), 1.5e-15);
}

TEST_CASE("Of a system the small multipliers come with the digits they have, mostly none",
          "[floquet][multipliers][extreme][N02][ratchet]") {
  // two uncoupled ones, exp(+-2 pi 5) and exp(+-2 pi): the smallest is lost in rounding, and its error says
  // so
  LinearPeriodicSystem system;
  system.period = kTwoPi;
  system.mass = Eigen::MatrixXd::Identity(2, 2);
  system.stiffness.mean = Eigen::MatrixXd{{-25.0, 1e-3}, {-2e-3, -1.0}};  // not symmetric: LAPACK
  const Eigen::Vector2d squares = (-system.stiffness.mean).eigenvalues().real();
  std::vector<double> exact;
  for (const double square : squares)
    for (const double sign : {-1.0, 1.0}) exact.push_back(sign * kTwoPi * std::sqrt(square));
  std::sort(exact.rbegin(), exact.rend());
  MonodromyEngine engine;
  const auto found = system_multipliers(engine.compute(system, {.tolerance = 1e-10}).matrix);
  REQUIRE(found.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(k, exact[k], found[k].log_modulus, found[k].log_modulus_error);
    CHECK(std::abs(found[k].log_modulus - exact[k]) <= found[k].log_modulus_error);
  }
  check_within("N02 bound of the logarithm of the largest of four multipliers", found[0].log_modulus_error,
               8e-10);
  CHECK(found[3].log_modulus_error > 0.1);
}

TEST_CASE("Matrices that are not finite do not reach LAPACK", "[floquet][multipliers][extreme][N37]") {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    auto matrix = BoundedMatrix::identity(4);
    matrix.value.mantissa(2, 1) = bad;
    CHECK_THROWS_AS(system_multipliers(matrix), NumericalFailure);
  }
}

}  // namespace strutt::test::multipliers_test
