#include "strutt/free_pendulum/normal_form.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"
#include "support/reference.hpp"

namespace strutt::test::normal_form_test {

namespace {

struct DeltaBeta {
  double delta, beta;
};

/// The closed forms (20), (21) of docs/normal-form.md: corrected and completed.
DeltaBeta closed_form(const PlanarCoefficients& s) {
  const auto& [a20, a11, a02, a30, a21, a12, a03] = s.f1;
  const auto& [b20, b11, b02, b30, b21, b12, b03] = s.f2;
  const double delta = (3 * a30 + b21 + a12 + 3 * b03) / 8 +
                       (b11 * (b20 + b02) - a11 * (a20 + a02) + 2 * (a20 * b20 - a02 * b02)) / (8 * s.alpha);
  const double beta = -(3 * b30 - a21 + b12 - 3 * a03) / 8 -
                      (4 * a20 * a20 + 10 * a20 * a02 + 10 * a02 * a02 + b11 * b11 - b11 * (5 * a20 + a02) +
                       10 * b20 * b20 + 10 * b20 * b02 + 4 * b02 * b02 + a11 * a11 - a11 * (b20 + 5 * b02)) /
                          (24 * s.alpha);
  return {delta, beta};
}

NonlinearTerms random_terms(std::mt19937_64& random, double size = 2.0) {
  std::uniform_real_distribution<double> draw(-size, size);
  return {draw(random), draw(random), draw(random), draw(random), draw(random), draw(random), draw(random)};
}

NonlinearTerms terms(const reference::Row& row, const std::string& f) {
  const auto c = [&](const char* name) { return row.input(f + "_" + name); };
  return {c("20"), c("11"), c("02"), c("30"), c("21"), c("12"), c("03")};
}

double value(const NonlinearTerms& f, const Eigen::Vector2d& z) {
  const double x = z(0), y = z(1);
  return f.c20 * x * x + f.c11 * x * y + f.c02 * y * y + f.c30 * x * x * x + f.c21 * x * x * y +
         f.c12 * x * y * y + f.c03 * y * y * y;
}

Eigen::Vector2d gradient(const NonlinearTerms& f, const Eigen::Vector2d& z) {
  const double x = z(0), y = z(1);
  return {2 * f.c20 * x + f.c11 * y + 3 * f.c30 * x * x + 2 * f.c21 * x * y + f.c12 * y * y,
          f.c11 * x + 2 * f.c02 * y + f.c21 * x * x + 2 * f.c12 * x * y + 3 * f.c03 * y * y};
}

/// Left minus right-hand side of (19) at z: what the truncated transformation leaves.
double residual(const PlanarCoefficients& s, const NormalForm& form, const Eigen::Vector2d& z) {
  const double r2 = z.squaredNorm();
  const Eigen::Vector2d z_velocity{s.alpha * z(1) + r2 * (form.delta * z(0) + form.beta * z(1)),
                                   -s.alpha * z(0) + r2 * (-form.beta * z(0) + form.delta * z(1))};
  Eigen::Matrix2d slope = Eigen::Matrix2d::Identity();
  slope.row(0) += gradient(form.g1, z);
  slope.row(1) += gradient(form.g2, z);
  const Eigen::Vector2d y = z + Eigen::Vector2d{value(form.g1, z), value(form.g2, z)};
  const Eigen::Vector2d y_velocity{s.alpha * y(1) + value(s.f1, y), -s.alpha * y(0) + value(s.f2, y)};
  return (slope * z_velocity - y_velocity).norm();
}

}  // namespace

TEST_CASE("delta and beta agree with orbits followed in 100 digits", "[free_pendulum][reference][ratchet]") {
  const auto rows = reference::read("normal_form");
  REQUIRE(rows.size() == 30);
  for (const auto& row : rows) {
    const NormalForm form = normal_form(
        PlanarCoefficients{.alpha = row.input("alpha"), .f1 = terms(row, "f1"), .f2 = terms(row, "f2")});
    REQUIRE(row.input("delta_error") < 1e-9);  // what the orbits give: far more than six digits
    REQUIRE(row.input("beta_error") < 1e-9);
    CAPTURE(form.delta, form.beta, form.delta_error);
    CHECK(abs(reference::Real(form.delta) - row.result("delta")) <=
          form.delta_error + row.input("delta_error"));
    CHECK(abs(reference::Real(form.beta) - row.result("beta")) <= form.beta_error + row.input("beta_error"));
    check_within("bound of delta of the normal form", form.delta_error, 1e-12);
  }
}

TEST_CASE("the program derives the closed formulas", "[free_pendulum][paper]") {
  std::mt19937_64 random(11);
  for (int i = 0; i < 1000; ++i) {
    const PlanarCoefficients system{.alpha = std::exp2(static_cast<double>(i % 7) - 3.0),
                                    .f1 = random_terms(random),
                                    .f2 = random_terms(random)};
    const NormalForm form = normal_form(system);
    const DeltaBeta expected = closed_form(system);
    CHECK(std::abs(form.delta - expected.delta) <= form.delta_error);
    CHECK(std::abs(form.beta - expected.beta) <= form.beta_error);
  }
}

TEST_CASE("the near-identity transformation leaves terms of fourth degree",
          "[free_pendulum][order][ratchet]") {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < 20; ++i) {
    const PlanarCoefficients system{.alpha = 1.5, .f1 = random_terms(random), .f2 = random_terms(random)};
    const NormalForm form = normal_form(system);
    const double th = angle(random);
    const Eigen::Vector2d z{std::cos(th), std::sin(th)};
    // A residual of third degree would be 1e-6 and fall by 8.
    const double coarse = residual(system, form, 2e-3 * z), fine = residual(system, form, 1e-3 * z);
    check_within("residual of a normal form at a distance of 1e-3", fine, 4e-11);
    check_close("residual of a normal form at twice the distance against 16 times (relative)", coarse / fine,
                16.0, 0.015);
  }
}

TEST_CASE("the pendulum has delta = 0 and beta = -alpha/16", "[free_pendulum][paper][ratchet]") {
  const double alpha = 3.0;
  const auto field = [&](const Jet& phi, const Jet& velocity) {
    return JetPair{velocity, -alpha * alpha * sin(phi)};
  };
  const NormalForm form = normal_form(taylor_expansion(field, {0.0, 0.0}));
  CHECK(form.delta == 0.0);
  CHECK(std::abs(form.beta + alpha / 16.0) <= form.beta_error);
  check_within("bound of beta of the pendulum", form.beta_error, 1.2e-14);
  check_close("period of a normal form (relative)", normal_form_period(form, 1.0),
              2.0 * std::numbers::pi / (alpha * 15.0 / 16.0), 8e-16);
  CHECK(normal_form_period(form, 4.0) == std::numeric_limits<double>::infinity());
}

TEST_CASE("van der Pol and a quadratic spring have the textbook values", "[free_pendulum][unit][ratchet]") {
  // x'' + x = mu (-x^2 x'): r' = -mu r^3/8. x'' + x + k x^2 = 0: omega = 1 - 5 k^2 r^2/12.
  const NormalForm damped = normal_form(PlanarCoefficients{.alpha = 1.0, .f2 = {.c21 = -0.5}});
  CHECK(damped.delta == -0.0625);
  CHECK(damped.beta == 0.0);
  const NormalForm spring = normal_form(PlanarCoefficients{.alpha = 1.0, .f2 = {.c20 = -3.0}});
  check_close("beta of a quadratic spring (relative)", spring.beta, -3.75, 8e-16);
  CHECK(std::abs(spring.delta) <= spring.delta_error);
}

TEST_CASE("a change of units changes nothing but the units", "[free_pendulum][extreme][ratchet]") {
  std::mt19937_64 random(17);
  const PlanarCoefficients system{.alpha = 1.25, .f1 = random_terms(random), .f2 = random_terms(random)};
  const NormalForm form = normal_form(system);
  // Lengths times 2^-k: quadratic terms times 2^k, cubic times 4^k, as delta and beta. Squares of 2^800
  // overflow.
  for (const int k : {-450, 450}) {
    PlanarCoefficients other = system;
    for (auto* f : {&other.f1, &other.f2}) {
      for (double* c : {&f->c20, &f->c11, &f->c02}) *c = std::ldexp(*c, k);
      for (double* c : {&f->c30, &f->c21, &f->c12, &f->c03}) *c = std::ldexp(*c, 2 * k);
    }
    const NormalForm scaled = normal_form(other);
    CHECK(scaled.delta == std::ldexp(form.delta, 2 * k));
    CHECK(scaled.beta == std::ldexp(form.beta, 2 * k));
    CHECK(scaled.g1.c30 == std::ldexp(form.g1.c30, 2 * k));
    CHECK(scaled.outcome == Outcome::converged);
  }
  // Quadratic terms whose square divided by alpha fits, though the square does not.
  const NormalForm large = normal_form(PlanarCoefficients{.alpha = 0x1p600, .f2 = {.c20 = 0x1p700}});
  check_close("beta of a quadratic spring (relative)", large.beta, -std::ldexp(5.0 / 12.0, 800), 8e-16);
}

TEST_CASE("a result beyond the doubles says so", "[free_pendulum][extreme]") {
  const NormalForm form = normal_form(PlanarCoefficients{.alpha = 1.0, .f2 = {.c20 = 1e200}});
  CHECK(form.outcome == Outcome::non_finite);
  const NormalForm linear = normal_form(PlanarCoefficients{.alpha = 1e-300});
  CHECK(linear.outcome == Outcome::converged);
  CHECK(linear.delta == 0.0);
  CHECK(linear.beta_error == 0.0);
}

TEST_CASE("a normal form wants a positive alpha and finite coefficients", "[free_pendulum][misuse]") {
  for (const double alpha : {0.0, -1.0, std::nan(""), HUGE_VAL})
    CHECK_THROWS_AS(normal_form(PlanarCoefficients{.alpha = alpha}), InvalidInput);
  CHECK_THROWS_AS(normal_form(PlanarCoefficients{.alpha = 1.0, .f2 = {.c03 = NAN}}), InvalidInput);
  CHECK_THROWS_AS(normal_form_period(NormalForm{.alpha = 1.0}, -1.0), InvalidInput);
}

}  // namespace strutt::test::normal_form_test
