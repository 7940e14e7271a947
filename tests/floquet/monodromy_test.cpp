// Routes to the monodromy matrix against each other and against closed forms, and the cost of the
// computation.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/hill_series.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::monodromy_test {

using strutt::test::check_within;

namespace {

constexpr double kTolerance = 1e-10;

/// Equations of every kind: even, odd, no symmetry, damped, growing, fast, jumping.
std::vector<HillEquation> zoo() {
  std::vector<HillEquation> result = {mathieu_delta_epsilon(1.0, 0.5), mathieu_delta_epsilon(0.3, 0.0),
                                      mathieu_delta_epsilon(-0.4, 2.0), mathieu_a_q(3.0, 1.5, 0.1),
                                      mathieu_delta_epsilon(40.0, 15.0, 0.02)};
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 1.0, 9.81, 0.1);
  const auto sine = sinusoidal_support(0.1, 7.0, 0.4), square = square_acceleration_support(0.05, 20.0, 1.0);
  result.push_back(linearise(rod, Equilibrium::hanging, &sine).equation);
  result.push_back(linearise(rod, Equilibrium::inverted, &square).equation);
  result.push_back(hill_equation(1.7, PeriodicFunction::fourier(2.0, {{1, 0.7, 0.2}, {2, -0.3, 0.9}}), 0.3));
  result.push_back(hill_equation(3.0, PeriodicFunction::square(1.0, 3.0, 0.0)));
  return result;
}

template <typename Matrix>
Eigen::Matrix2d plain(const BasicMonodromy<Matrix>& m) {
  return m.matrix.value.mantissa * std::ldexp(1.0, static_cast<int>(m.matrix.value.exponent));
}

/// Tolerance of a comparison: the bounds of both sides, in absolute terms.
template <typename Matrix>
double allowance(const BasicMonodromy<Matrix>& m) {
  return m.error * std::max(1.0, plain(m).cwiseAbs().maxCoeff());
}

HillEquation shifted(HillEquation equation, double phase) {
  equation.coefficient = equation.coefficient.shifted(phase);
  return equation;
}

}  // namespace

TEST_CASE("A shift of the phase is a change of basis by the propagator", "[floquet][law][ratchet]") {
  // constant coefficient on [0, phase]: the propagator is known in closed form
  MonodromyEngine engine;
  const auto equation = hill_equation(2.0, PeriodicFunction::square(3.0, 2.0, 0.0));
  const double s = std::sqrt(equation.coefficient(0.0)), kappa = equation.canonical_kappa(), phase = 1.0;
  const Eigen::Matrix2d p{{std::cos(s * phase), kappa / s * std::sin(s * phase)},
                          {-s / kappa * std::sin(s * phase), std::cos(s * phase)}};
  const auto from_zero = plain(engine.compute(equation));
  const auto from_phase = plain(engine.compute(shifted(equation, phase)));
  check_within("M of a square wave from another phase (scaled)",
               (p * from_zero * p.inverse() - from_phase).cwiseAbs().maxCoeff(), 3e-15);
}

TEST_CASE("Half-period and whole-period routes agree", "[floquet][law]") {
  // the same equation, once recognised as even and once with a disturbance of 1e-13 that breaks the symmetry
  MonodromyEngine engine;
  for (const double epsilon : {0.5, 3.0}) {
    const auto even = mathieu_delta_epsilon(1.3, epsilon);
    auto broken = even;
    broken.coefficient =
        PeriodicFunction::fourier(1.3, {{1, epsilon, 0.0}, {2, 0.0, 1e-13}, {3, 1e-13, 0.0}});
    const auto a = engine.compute(even, {.tolerance = kTolerance}),
               b = engine.compute(broken, {.tolerance = kTolerance});
    CHECK(a.half.has_value());
    CHECK_FALSE(b.half.has_value());
    CHECK((plain(a) - plain(b)).cwiseAbs().maxCoeff() <= allowance(a) + allowance(b) + 1e-11);
  }
}

TEST_CASE("Constant coefficients have the closed form, whatever the method", "[floquet][known]") {
  MonodromyEngine engine;
  const double delta = GENERATE(0.3, 1.7, 0.0, -0.2, 6.25);
  const double s = std::sqrt(std::abs(delta)), T = 2.0 * std::numbers::pi;
  const double expected = delta >= 0.0 ? 2.0 * std::cos(s * T) : 2.0 * std::cosh(s * T);
  for (const auto method : {Method::automatic, Method::arkode, Method::cvode}) {
    const auto m =
        engine.compute(mathieu_delta_epsilon(delta, 0.0), {.tolerance = kTolerance, .method = method});
    CHECK(std::abs(plain(m).trace() - expected) <= allowance(m));
    CHECK(m.method == (method == Method::automatic ? Method::exact : method));
  }
}

TEST_CASE("The error falls with the tolerance and the cost rises", "[floquet][order]") {
  MonodromyEngine engine;
  double error = 1.0;
  long cost = 0;
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    const auto m = engine.compute(mathieu_delta_epsilon(3.0, 2.0), {.tolerance = tolerance});
    CHECK(m.outcome == Outcome::converged);
    CHECK(m.error < error);
    CHECK(m.cost.right_hand_sides > cost);
    error = m.error;
    cost = m.cost.right_hand_sides;
  }
}

TEST_CASE("Cost: the error estimate is a separate run, half a period is half the work", "[floquet][cost]") {
  MonodromyEngine engine;
  const auto equation = mathieu_delta_epsilon(1.0, 0.5);
  const auto with = engine.compute(equation), without = engine.compute(equation, {.estimate_error = false});
  CHECK(plain(with) == plain(without));
  CHECK(without.estimate_cost.right_hand_sides == 0);
  CHECK(with.cost.right_hand_sides == without.cost.right_hand_sides);
  CHECK(with.estimate_cost.right_hand_sides <= 2 * with.cost.right_hand_sides);
  auto uneven = equation;
  uneven.coefficient = PeriodicFunction::fourier(1.0, {{1, 0.5, 0.0}, {2, 0.0, 1e-9}, {3, 1e-9, 0.0}});
  CHECK(engine.compute(uneven).cost.right_hand_sides >= 3 * with.cost.right_hand_sides / 2);
}

TEST_CASE("Results do not depend on what was computed before", "[floquet][law]") {
  MonodromyEngine used, fresh;
  for (const auto& equation : zoo()) (void)used.compute(equation, {.tolerance = 1e-5});
  for (const auto& equation : zoo()) {
    const auto a = used.compute(equation), b = fresh.compute(equation);
    CHECK(a.matrix.value.mantissa == b.matrix.value.mantissa);
    CHECK(a.error == b.error);
  }
}

TEST_CASE("Misuse is refused, trouble is an outcome", "[floquet][error][extreme][N17][N36]") {
  MonodromyEngine engine;
  CHECK_THROWS_AS(engine.compute(mathieu_delta_epsilon(1, 1), {.tolerance = 1e-14}), InvalidInput);
  CHECK_THROWS_AS(engine.compute(mathieu_delta_epsilon(1, 1), {.tolerance = std::nan("")}), InvalidInput);
  CHECK_THROWS_AS(engine.compute(mathieu_delta_epsilon(1, 1), {.method = Method::exact}), InvalidInput);
  CHECK_THROWS_AS(engine.compute(mathieu_delta_epsilon(1, 1), {.method = Method::fourier}), InvalidInput);
  CHECK_THROWS_AS(engine.compute(mathieu_delta_epsilon(std::nan(""), 1)), InvalidInput);
  CHECK_THROWS_AS(engine.compute(mathieu_delta_epsilon(1, INFINITY)), InvalidInput);
  CHECK_THROWS_AS(engine.compute(mathieu_delta_epsilon(1, 1, -0.1)), InvalidInput);
  const std::atomic<bool> cancel = true;
  const auto cancelled = engine.compute(mathieu_delta_epsilon(1, 1), {.cancel = &cancel});
  CHECK(cancelled.outcome == Outcome::cancelled);
  CHECK(std::isinf(cancelled.error));
}

TEST_CASE("What would take too many steps ends at once, as an outcome", "[floquet][error][extreme][N13]") {
  MonodromyEngine engine;
  const auto far = [](double delta, double epsilon) { return mathieu_delta_epsilon(delta, epsilon, 0.1); };
  for (const auto method : {Method::automatic, Method::arkode, Method::cvode}) {
    for (const auto& equation : {far(1e20, 0.5), far(-1e20, 0.5), far(1e308, 1.0), far(1.0, 1e300)}) {
      const auto result = engine.compute(equation, {.method = method});
      CHECK(result.outcome == Outcome::step_limit);
      CHECK(std::isinf(result.error));
      CHECK(result.cost.right_hand_sides == 0);
    }
  }
  LinearPeriodicSystem system;
  system.period = 2.0 * std::numbers::pi;
  system.mass = Eigen::Matrix2d::Identity();
  system.stiffness.mean = 1e300 * Eigen::Matrix2d::Identity();
  for (const auto method : {Method::automatic, Method::propagator, Method::arkode}) {
    const auto result = engine.compute(system, {.method = method});
    CHECK(result.outcome == Outcome::step_limit);
    CHECK(std::isinf(result.error));
  }
}

TEST_CASE("The bound holds where the coefficient turns faster than the solution", "[floquet][monodromy]") {
  // A first step of the solution's size would pass over the coefficient, in the run for the error as well.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> size(-0.01, 0.01);
  MonodromyEngine engine;
  for (int k = 0; k < 1000; ++k) {
    const auto w = PeriodicFunction::fourier(
        size(random), {{1, size(random), 0.0}, {2, size(random), 0.0}, {3, size(random), size(random)}});
    const auto monodromy = engine.compute(hill_equation(2.0 * std::numbers::pi, w), {.tolerance = 1e-6});
    const auto truth = reference::hill_matrix(w);
    const Eigen::Matrix2d m = plain(monodromy);  // kappa = 1
    long double error = 0.0L;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) error = std::max(error, std::abs(m(i, j) - truth[i][j]));
    }
    CHECK(error <= allowance(monodromy));
  }
}

namespace {

/// The largest error of an entry of M for the state (y, y'/kappa), relative to the largest entry.
long double true_error(const HillMonodromy& m, const std::array<std::array<long double, 2>, 2>& truth) {
  const long double scale[2][2] = {{1.0L, m.kappa}, {1.0L / m.kappa, 1.0L}};
  const Eigen::Matrix2d found = plain(m);
  long double error = 0.0L, size = 1.0L;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      error = std::max(error, std::abs(found(i, j) - scale[i][j] * truth[i][j]));
      size = std::max(size, std::abs(scale[i][j] * truth[i][j]));
    }
  }
  return error / size;
}

}  // namespace

TEST_CASE("Where solutions grow det M says nothing and the determinants of the pieces do",
          "[floquet][monodromy][extreme][N03][ratchet]") {
  MonodromyEngine engine;
  double largest = 0.0, defect = 0.0;
  for (const auto& [delta, epsilon] : {std::pair{-10.0, 3.0}, {-20.0, 10.0}, {-30.0, 5.0}}) {
    const auto equation = mathieu_delta_epsilon(delta, epsilon);
    const auto m = engine.compute(equation, {.tolerance = 1e-12});
    CAPTURE(delta, epsilon);
    CHECK(std::abs(plain(m).determinant() - 1.0) > 0.1);
    defect = std::max(defect, m.determinant_defect);
    largest =
        std::max(largest, static_cast<double>(true_error(m, reference::hill_matrix(equation.coefficient))));
  }
  check_within("N03 |det - 1| of the integrated pieces over their squared norm", defect, 4e-16);
  check_within("N03 error of M where |M| is up to 1e15 relative to |M|", largest, 1e-14);
}

TEST_CASE("A stiffness of 1e4 and more: both components of the state keep their digits",
          "[floquet][monodromy][extreme][N14][ratchet]") {
  MonodromyEngine engine;
  double largest = 0.0;
  for (const auto& [delta, epsilon] : {std::pair{1e4, 50.0}, {1.3e4, 0.1}, {9e4, 3e3}}) {
    const auto equation = mathieu_delta_epsilon(delta, epsilon);
    const auto m = engine.compute(equation, {.tolerance = 1e-11, .method = Method::propagator});
    CHECK(m.kappa == std::sqrt(delta));
    const auto steps = static_cast<int>(6.0 * std::sqrt(delta + epsilon));
    const auto error =
        static_cast<double>(true_error(m, reference::hill_matrix(equation.coefficient, steps)));
    CAPTURE(delta, epsilon, m.error);
    CHECK(error <= m.error);
    largest = std::max(largest, error);
  }
  check_within("N14 error of M in the scaled state at delta up to 9e4", largest, 1e-12);
}

}  // namespace strutt::test::monodromy_test
