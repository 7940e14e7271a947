#include "strutt/integrate/integrator.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "integrate/methods.hpp"
#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::integrator_test {

using Eigen::VectorXd;

namespace {

/// x'' + 2 d x' + (1 + d^2) x = 0 from (1, 0): x = exp(-d t) (cos t + d sin t).
double damped_error(const Method& method, double tolerance) {
  constexpr double kDamping = 0.1;
  VectorXd y = vector({1.0, 0.0});
  const auto f = [](double, StateView v, StateOut dydt) {
    dydt[0] = v[1];
    dydt[1] = -2.0 * kDamping * v[1] - (1.0 + kDamping * kDamping) * v[0];
  };
  const double end = 10.0;
  const IntegrationResult result = integrate(f, 0.0, end, y, options_of(method, tolerance));
  CHECK(result.outcome == Outcome::converged);
  CHECK(result.t == end);
  const double decay = std::exp(-kDamping * end);
  const double x = decay * (std::cos(end) + kDamping * std::sin(end));
  const double v = -decay * (1.0 + kDamping * kDamping) * std::sin(end);
  return std::hypot(y[0] - x, y[1] - v);
}

}  // namespace

TEST_CASE("every method reaches a closed form with an error that follows the tolerance",
          "[integrate][accuracy][ratchet]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    const double smallest = method.order == 2 ? 1e-7 : method.order == 3 ? 1e-9 : 1e-13;
    double last = 1.0;
    for (double tolerance = 1e-3; tolerance >= 0.99 * smallest; tolerance *= 0.01) {
      INFO("tolerance " << tolerance);
      const double error = damped_error(method, tolerance);
      // The tolerance is one for each step; BDF takes by far the most of them.
      const bool bdf = method.backend == Backend::cvode_bdf;
      check_within(bdf ? "damped oscillation by BDF over the tolerance"
                       : "damped oscillation by ARKODE and Adams' method over the tolerance",
                   error / tolerance, bdf ? 2500.0 : 150.0);
      if (error > 1e-12) CHECK(error < 0.3 * last);
      last = error;
    }
  }
}

TEST_CASE("a Runge-Kutta method is exact on polynomials of its degree and not beyond",
          "[integrate][accuracy][ratchet]") {
  // y_k' = k y_(k-1), y_k = t^k, and the same with t in place of the state.
  constexpr int kDegrees = 10;
  const auto f = [](double t, StateView y, StateOut dydt) {
    for (int k = 1; k <= kDegrees; ++k) {
      dydt[k - 1] = k == 1 ? 1.0 : k * y[k - 2];
      dydt[kDegrees + k - 1] = k * std::pow(t, k - 1);
    }
  };
  for (const Method& method : kMethods) {
    if (method.backend != Backend::arkode_erk) continue;
    INFO(name(method));
    VectorXd y = VectorXd::Zero(2 * kDegrees);
    const auto result = integrate(f, 0.0, 1.5, y, options_of(method, 1e-3));
    REQUIRE(result.outcome == Outcome::converged);
    for (int k = 1; k <= method.order; ++k) {
      INFO("degree " << k);
      const double power = std::pow(1.5, k);
      for (const int i : {k - 1, kDegrees + k - 1})
        check_within("polynomials by a Runge-Kutta method of that order over t^k + 1/10",
                     std::abs(y[i] - power) / (power + 0.1), 8e-15);
    }
    CHECK(std::abs(y[method.order] - std::pow(1.5, method.order + 1)) > 1e-12);
  }
}

TEST_CASE("the number of steps shows the order of a method", "[integrate][accuracy]") {
  // Local errors fall with h^(p + 1), p being the order of the embedded method, one less than that of the
  // method. ERKStep of SUNDIALS 6.4 by itself loses orders with Heun's, Verner's and Dormand and Prince's
  // methods.
  for (const Method& method : kMethods) {
    if (method.backend != Backend::arkode_erk) continue;
    INFO(name(method));
    const double loose = method.order <= 3 ? 1e-5 : 1e-9;
    const double tight = method.order <= 3 ? 1e-8 : 1e-12;
    VectorXd y = vector({1, 0, 0, 1});
    const long few = integrate(mathieu, 0.0, 60.0, y, options_of(method, loose)).cost.steps;
    y = vector({1, 0, 0, 1});
    const long many = integrate(mathieu, 0.0, 60.0, y, options_of(method, tight)).cost.steps;
    const double order = std::log(1e3) / std::log(static_cast<double>(many) / static_cast<double>(few));
    CHECK(order > method.order - 0.5);
  }
}

TEST_CASE("halving the step cuts the error by two to the order, at a fixed price for each step",
          "[integrate][accuracy][cost][ratchet]") {
  // Kepler's ellipse of eccentricity 0.3, back at its start after 2 pi: nonlinear, so that every order
  // condition counts. The tolerance accepts every step, so that max_step decides.
  const auto f = [](double, StateView y, StateOut dydt) {
    const double cube = std::pow(y[0] * y[0] + y[1] * y[1], 1.5);
    dydt[0] = y[2], dydt[1] = y[3], dydt[2] = -y[0] / cube, dydt[3] = -y[1] / cube;
  };
  // It starts far out, where the first steps, which are shorter, matter least.
  const VectorXd start = vector({1.3, 0.0, 0.0, std::sqrt(0.7 / 1.3)});
  const auto run = [&](const Method& method, int steps) {
    IntegratorOptions options = options_of(method, 1e6);
    options.max_step = 2.0 * M_PI / steps;
    VectorXd y = start;
    const auto result = integrate(f, 0.0, 2.0 * M_PI, y, options);
    CHECK(result.outcome == Outcome::converged);
    CHECK(result.cost.steps >= steps);
    CHECK(result.cost.steps <= steps + 6);
    CHECK(result.cost.rejections == 0);
    return std::pair{(y - start).norm(), result.cost};
  };
  const std::map<int, long> stages{{2, 2}, {3, 3}, {4, 5}, {5, 6}, {6, 8}, {8, 13}};  // new ones in each step
  for (const Method& method : kMethods) {
    if (method.backend != Backend::arkode_erk) continue;
    INFO(name(method));
    const int steps = method.order <= 3 ? 2000 : method.order <= 5 ? 400 : method.order == 6 ? 150 : 36;
    const auto [coarse, coarse_cost] = run(method, steps);
    const auto [fine, fine_cost] = run(method, 2 * steps);
    check_within("order of a Runge-Kutta method: measured against expected",
                 std::abs(std::log2(coarse / fine) - method.order),
                 0.4);  // terms of the next order are still seen
    // three more: the slope at the start and two to guess the first step
    for (const auto& cost : {coarse_cost, fine_cost}) {
      CHECK(cost.right_hand_sides == stages.at(method.order) * cost.steps + 3);
    }
  }
}

TEST_CASE("an integral without feedback is controlled, too", "[integrate][accuracy][ratchet]") {
  // The error estimate of Fehlberg's pair 7(8) is zero here.
  const auto f = [](double t, StateView, StateOut dydt) { dydt[0] = std::pow(std::cos(5.0 * t), 2); };
  for (const Method& method : kMethods) {
    INFO(name(method));
    VectorXd y = VectorXd::Zero(1);
    integrate(f, 0.0, 10.0, y, options_of(method, 1e-6));
    check_within("integral without feedback at tolerance 1e-6", std::abs(y[0] - 5.0 - std::sin(100.0) / 20.0),
                 1e-4);
  }
}

TEST_CASE("the trace of Mathieu's equation", "[integrate][accuracy][ratchet]") {
  constexpr double kTrace = 2.021314397416841636;
  VectorXd y = vector({1, 0, 0, 1});
  const auto result = integrate(mathieu, 0.0, 2.0 * M_PI, y, options_of({Backend::arkode_erk, 8}, 1e-12));
  REQUIRE(result.outcome == Outcome::converged);
  check_within("trace of M by ARKODE at tolerance 1e-12", std::abs(y[0] + y[3] - kTrace), 6e-14);
  CHECK(result.cost.right_hand_sides <
        1200);  // twice that if the end of a step were not the start of the next
}

TEST_CASE("every component of a state of any size is integrated", "[integrate][accuracy][ratchet]") {
  const auto decay = [](double, StateView y, StateOut dydt) {
    for (Eigen::Index i = 0; i < y.size(); ++i) dydt[i] = -(1.0 + 0.25 * static_cast<double>(i)) * y[i];
  };
  for (const Method& method : {Method{Backend::arkode_erk, 8}, Method{Backend::cvode_adams, 8}}) {
    for (int size = 1; size <= 9; ++size) {
      INFO(name(method) << ", " << size << " components");
      VectorXd y = VectorXd::Ones(size);
      integrate(decay, 0.0, 1.0, y, options_of(method, 1e-10));
      for (int i = 0; i < size; ++i)
        check_within("component of a state of any size at tolerance 1e-10",
                     std::abs(y[i] - std::exp(-1.0 - 0.25 * i)), 8e-10);
    }
  }
}

TEST_CASE("the first step is tried as given, in both directions", "[integrate][cost][ratchet]") {
  for (const double end : {0.5, -0.5}) {
    INFO("to " << end);
    IntegratorOptions options = options_of({Backend::arkode_erk, 8}, 1e-6);
    VectorXd y = vector({1.0, 0.0});
    CHECK(integrate(oscillator, 0.0, end, y, options).cost.steps > 1);
    options.first_step = 0.5;
    y = vector({1.0, 0.0});
    CHECK(integrate(oscillator, 0.0, end, y, options).cost.steps == 1);
    check_within("oscillation in one step of 1/2", std::abs(y[0] - std::cos(end)), 1e-10);
  }
}

TEST_CASE("costs are what was spent", "[integrate][cost][ratchet]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    long calls = 0;
    const auto f = [&calls](double t, StateView y, StateOut dydt) {
      ++calls;
      // A sudden change: steps that stretched over the quiet beginning must fail.
      dydt[0] = t < 5.0 ? -0.01 * y[0] : 100.0 * std::cos(30.0 * t);
    };
    VectorXd y = vector({1.0});
    const auto result = integrate(f, 0.0, 6.0, y, options_of(method, 1e-5));
    REQUIRE(result.outcome == Outcome::converged);
    CHECK(result.cost.right_hand_sides == calls);
    CHECK(result.cost.rejections > 0);
    CHECK(result.cost.steps > 10);
    check_within("run with rejected steps at tolerance 1e-5",
                 std::abs(y[0] - std::exp(-0.05) - 100.0 / 30.0 * (std::sin(180.0) - std::sin(150.0))), 1e-2);
  }
}

TEST_CASE("BDF takes few steps on a stiff equation", "[integrate][stiff][ratchet]") {
  const auto f = [](double t, StateView y, StateOut dydt) { dydt[0] = -1e6 * (y[0] - std::cos(t)); };
  VectorXd y = vector({0.0});
  const auto result = integrate(f, 0.0, 10.0, y, options_of({Backend::cvode_bdf, 8}, 1e-6));
  CHECK(result.outcome == Outcome::converged);
  CHECK(result.cost.steps < 400);
  check_within("stiff equation by BDF at tolerance 1e-6", std::abs(y[0] - std::cos(10.0)), 2e-6);
}

TEST_CASE("integrating backward returns to the start", "[integrate][direction][ratchet]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    const double tolerance = method.order <= 3 ? 1e-6 : 1e-9;
    VectorXd y = vector({1, 0, 0, 1});
    Integrator integrator(4, options_of(method, tolerance));
    REQUIRE(integrator.advance(mathieu, 0.3, 7.1, y).t == 7.1);
    const auto result = integrator.advance(mathieu, 7.1, 0.3, y);
    CHECK(result.outcome == Outcome::converged);
    CHECK(result.t == 0.3);
    check_within("run there and back over the tolerance", (y - vector({1, 0, 0, 1})).norm() / tolerance,
                 120.0);
  }
}

TEST_CASE("a maximal step is kept to", "[integrate][step]") {
  for (const Method& method : kMethods) {
    IntegratorOptions options = options_of(method, 1e-3);
    options.max_step = 0.01;
    VectorXd y = vector({1.0, 0.0});
    CHECK(integrate(oscillator, 0.0, 1.0, y, options).cost.steps >= 100);
  }
}

}  // namespace strutt::test::integrator_test
