#include "strutt/free_pendulum/planar_system.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::planar_system_test {

namespace {

double value(const NonlinearTerms& f, double x, double y) {
  return f.c20 * x * x + f.c11 * x * y + f.c02 * y * y + f.c30 * x * x * x + f.c21 * x * x * y +
         f.c12 * x * y * y + f.c03 * y * y * y;
}

NonlinearTerms random_terms(std::mt19937_64& random) {
  std::uniform_real_distribution<double> draw(-2.0, 2.0);
  return {draw(random), draw(random), draw(random), draw(random), draw(random), draw(random), draw(random)};
}

JetPair pendulum(const Jet& x1, const Jet& x2) { return {x2, -9.0 * sin(x1)}; }

}  // namespace

TEST_CASE("the Jordan form of the pendulum is that of the paper", "[free_pendulum][paper]") {
  const PlanarSystem system = taylor_expansion(pendulum, {0.0, 0.0});
  CHECK(system.linear == Eigen::Matrix2d{{0.0, 1.0}, {-9.0, 0.0}});
  CHECK(system.f2.c30 == 1.5);
  const JordanForm form = jordan_form(system);
  CHECK(form.transformation == Eigen::Matrix2d{{1.0, 0.0}, {0.0, 3.0}});
  CHECK(form.system.alpha == 3.0);
  CHECK(form.system.f2.c30 == 0.5);  // alpha/6, eq. 13
  CHECK(form.system.f1.c30 == 0.0);
  CHECK(form.system.f2.c20 == 0.0);
  CHECK(form.system.f2.c12 == 0.0);
}

TEST_CASE("any centre becomes J y + f(y) with the same velocities", "[free_pendulum][property][ratchet]") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> draw(-2.0, 2.0);
  for (int i = 0; i < 50; ++i) {
    const double a11 = draw(random), a12 = (i % 2 ? 1 : -1) * (0.5 + std::abs(draw(random)));
    const double a21 = -(a11 * a11 + 0.25 + std::abs(draw(random))) / a12;
    const PlanarSystem system{Eigen::Matrix2d{{a11, a12}, {a21, -a11}}, random_terms(random),
                              random_terms(random)};
    const JordanForm form = jordan_form(system);
    const double alpha = form.system.alpha;
    const Eigen::Vector2d y{draw(random), draw(random)};
    const Eigen::Vector2d x = form.transformation * y;
    const Eigen::Vector2d velocity =
        form.transformation.inverse() *
        (system.linear * x + Eigen::Vector2d{value(system.f1, x(0), x(1)), value(system.f2, x(0), x(1))});
    const Eigen::Vector2d jordan{alpha * y(1) + value(form.system.f1, y(0), y(1)),
                                 -alpha * y(0) + value(form.system.f2, y(0), y(1))};
    check_within(
        "velocity in Jordan form over its scale",
        (velocity - jordan).norm() / ((1.0 + velocity.norm()) * (1.0 + form.transformation.inverse().norm()) *
                                      std::pow(1.0 + form.transformation.norm(), 3)),
        8e-17);
    CHECK(form.transformation(0, 0) == 1.0);
    CHECK(form.transformation(1, 0) == 0.0);
  }
}

TEST_CASE("differences of the right-hand side confirm its Taylor coefficients", "[free_pendulum][unit]") {
  const auto formula = [](auto x1, auto x2) {
    using std::cos, std::exp, std::sin;
    return std::array{x2 + sin(x1) * x2 - x1 * x1, -4.0 * x1 + x2 * exp(x1) - sin(x2) + x1 * cos(x2) * x2};
  };
  const PlanarSystem system =
      taylor_expansion([&](const Jet& x1, const Jet& x2) { return formula(x1, x2); }, {0.0, 0.0});
  for (const double h : {1e-3, 2e-3}) {
    for (const auto& [x1, x2] : {std::pair{h, 0.5 * h}, {-0.3 * h, h}, {h, -h}}) {
      const auto f = formula(x1, x2);
      const Eigen::Vector2d linear = system.linear * Eigen::Vector2d{x1, x2};
      CHECK(std::abs(linear(0) + value(system.f1, x1, x2) - f[0]) <= 2.0 * std::pow(h, 4));
      CHECK(std::abs(linear(1) + value(system.f2, x1, x2) - f[1]) <= 2.0 * std::pow(h, 4));
    }
  }
}

TEST_CASE("a rounded equilibrium is one", "[free_pendulum][extreme][ratchet]") {
  const PlanarSystem system = taylor_expansion(pendulum, {2.0 * std::numbers::pi, 0.0});
  check_close("Taylor coefficient of the pendulum at 2 pi (relative)", system.f2.c30, 1.5, 8e-16);
  check_close("eigenfrequency of the pendulum at 2 pi (relative)", jordan_form(system).system.alpha, 3.0,
              8e-16);
}

TEST_CASE("what is not a centre is refused", "[free_pendulum][misuse]") {
  CHECK_THROWS_AS(taylor_expansion(pendulum, {0.1, 0.0}), InvalidInput);
  CHECK_THROWS_AS(jordan_form(taylor_expansion(pendulum, {std::numbers::pi, 0.0})), InvalidInput);  // saddle
  CHECK_THROWS_AS(jordan_form({.linear = Eigen::Matrix2d{{0.01, 1.0}, {-1.0, 0.0}}}), InvalidInput);
  CHECK_THROWS_AS(jordan_form({.linear = Eigen::Matrix2d::Zero()}), InvalidInput);
  CHECK_THROWS_AS(jordan_form({.linear = Eigen::Matrix2d{{0.0, 1.0}, {-1.0, 0.0}}, .f1 = {.c20 = NAN}}),
                  InvalidInput);
  const auto root = [](const Jet& x1, const Jet& x2) { return JetPair{x2, -sqrt(x1)}; };
  CHECK_THROWS_AS(taylor_expansion(root, {0.0, 0.0}), InvalidInput);
}

}  // namespace strutt::test::planar_system_test
