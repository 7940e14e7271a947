#include "strutt/integrate/integrator.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <thread>
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
          "[integrate][accuracy]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    const double smallest = method.order == 2 ? 1e-7 : method.order == 3 ? 1e-9 : 1e-13;
    double last = 1.0;
    for (double tolerance = 1e-3; tolerance >= 0.99 * smallest; tolerance *= 0.01) {
      INFO("tolerance " << tolerance);
      const double error = damped_error(method, tolerance);
      // The tolerance is one for each step; BDF takes by far the most of them.
      CHECK(error < (method.backend == Backend::cvode_bdf ? 5000.0 : 300.0) * tolerance);
      if (error > 1e-12) CHECK(error < 0.3 * last);
      last = error;
    }
  }
}

TEST_CASE("a Runge-Kutta method is exact on polynomials of its degree and not beyond",
          "[integrate][accuracy]") {
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
      CHECK(std::abs(y[k - 1] - std::pow(1.5, k)) < 1e-13 * std::pow(1.5, k) + 1e-14);
      CHECK(std::abs(y[kDegrees + k - 1] - std::pow(1.5, k)) < 1e-13 * std::pow(1.5, k) + 1e-14);
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
          "[integrate][accuracy][cost]") {
  // Kepler's ellipse of eccentricity 0.3, back at its start after 2 pi: nonlinear, so that every order condition
  // counts. The tolerance accepts every step, so that max_step decides.
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
    CHECK(std::log2(coarse / fine) == Approx(method.order).margin(0.4));  // terms of the next order are still seen
    // three more: the slope at the start and two to guess the first step
    for (const auto& cost : {coarse_cost, fine_cost}) {
      CHECK(cost.right_hand_sides == stages.at(method.order) * cost.steps + 3);
    }
  }
}

TEST_CASE("an integral without feedback is controlled, too", "[integrate][accuracy]") {
  // The error estimate of Fehlberg's pair 7(8) is zero here.
  const auto f = [](double t, StateView, StateOut dydt) { dydt[0] = std::pow(std::cos(5.0 * t), 2); };
  for (const Method& method : kMethods) {
    INFO(name(method));
    VectorXd y = VectorXd::Zero(1);
    integrate(f, 0.0, 10.0, y, options_of(method, 1e-6));
    CHECK(std::abs(y[0] - 5.0 - std::sin(100.0) / 20.0) < 1e-4);
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

TEST_CASE("every component of a state of any size is integrated", "[integrate][accuracy]") {
  const auto decay = [](double, StateView y, StateOut dydt) {
    for (Eigen::Index i = 0; i < y.size(); ++i) dydt[i] = -(1.0 + 0.25 * static_cast<double>(i)) * y[i];
  };
  for (const Method& method : {Method{Backend::arkode_erk, 8}, Method{Backend::cvode_adams, 8}}) {
    for (int size = 1; size <= 9; ++size) {
      INFO(name(method) << ", " << size << " components");
      VectorXd y = VectorXd::Ones(size);
      integrate(decay, 0.0, 1.0, y, options_of(method, 1e-10));
      for (int i = 0; i < size; ++i) CHECK(std::abs(y[i] - std::exp(-1.0 - 0.25 * i)) < 1e-8);
    }
  }
}

TEST_CASE("the first step is tried as given, in both directions", "[integrate][cost]") {
  for (const double end : {0.5, -0.5}) {
    INFO("to " << end);
    IntegratorOptions options = options_of({Backend::arkode_erk, 8}, 1e-6);
    VectorXd y = vector({1.0, 0.0});
    CHECK(integrate(oscillator, 0.0, end, y, options).cost.steps > 1);
    options.first_step = 0.5;
    y = vector({1.0, 0.0});
    CHECK(integrate(oscillator, 0.0, end, y, options).cost.steps == 1);
    CHECK(std::abs(y[0] - std::cos(end)) < 1e-6);
  }
}

TEST_CASE("costs are what was spent", "[integrate][cost]") {
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
    CHECK(std::abs(y[0] - std::exp(-0.05) - 100.0 / 30.0 * (std::sin(180.0) - std::sin(150.0))) < 1e-2);
  }
}

TEST_CASE("BDF takes few steps on a stiff equation", "[integrate][stiff]") {
  const auto f = [](double t, StateView y, StateOut dydt) { dydt[0] = -1e6 * (y[0] - std::cos(t)); };
  VectorXd y = vector({0.0});
  const auto result = integrate(f, 0.0, 10.0, y, options_of({Backend::cvode_bdf, 8}, 1e-6));
  CHECK(result.outcome == Outcome::converged);
  CHECK(result.cost.steps < 400);
  CHECK(std::abs(y[0] - std::cos(10.0)) < 1e-5);
}

TEST_CASE("integrating backward returns to the start", "[integrate][direction]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    const double tolerance = method.order <= 3 ? 1e-6 : 1e-9;
    VectorXd y = vector({1, 0, 0, 1});
    Integrator integrator(4, options_of(method, tolerance));
    REQUIRE(integrator.advance(mathieu, 0.3, 7.1, y).t == 7.1);
    const auto result = integrator.advance(mathieu, 7.1, 0.3, y);
    CHECK(result.outcome == Outcome::converged);
    CHECK(result.t == 0.3);
    CHECK((y - vector({1, 0, 0, 1})).norm() < 2000.0 * tolerance);
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

TEST_CASE("results do not depend on what was integrated before", "[integrate][reproducible]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    const double tolerance = method.order <= 3 ? 1e-5 : 1e-9;
    Integrator integrator(4, options_of(method, tolerance));
    const auto run = [](Integrator& with) {
      VectorXd y = vector({1, 0, 0, 1});
      const auto result = with.advance(mathieu, 0.0, 6.0, y);
      return std::pair{y, result.cost};
    };
    const auto [first, first_cost] = run(integrator);

    // Backward, with events, aborted, failed, by another tolerance: nothing of it may stay.
    VectorXd y = vector({0.0, 5.0, -2.0, 1e3});
    const EventRequest events{[](double, StateView v, StateOut g) { g[0] = v[0]; }, {Crossing::both}, false};
    integrator.advance(mathieu, 3.0, -40.0, y, &events);
    IntegratorOptions others = integrator.options();
    others.max_steps = 3;
    others.max_step = 0.01;
    others.relative_tolerance = 1e-4;
    integrator.set_options(others);
    CHECK(integrator.advance(mathieu, 0.0, 6.0, y).outcome == Outcome::step_limit);
    integrator.set_options(options_of(method, tolerance));
    const auto broken = [](double t, StateView v, StateOut dydt) { dydt = v * (t < 0.4 ? 1e3 : NAN); };
    CHECK(integrator.advance(broken, 0.0, 6.0, y).outcome == Outcome::non_finite);

    const auto [again, again_cost] = run(integrator);
    CHECK(same_bits(first, again));
    CHECK(first_cost.steps == again_cost.steps);
    CHECK(first_cost.right_hand_sides == again_cost.right_hand_sides);
    Integrator fresh(4, options_of(method, tolerance));
    CHECK(same_bits(first, run(fresh).first));
    Integrator moved = std::move(integrator);
    CHECK(same_bits(first, run(moved).first));
  }
}

TEST_CASE("one integrator per thread gives the bits of a serial run", "[integrate][threads]") {
  for (const Method& method : kMethods) {
    if (method.order < 5) continue;
    const auto work = [&method](double shift, std::vector<VectorXd>& results) {
      Integrator integrator(4, options_of(method, 1e-8));
      for (int i = 0; i < 50; ++i) {
        results.push_back(vector({1, 0, 0, 1}));
        integrator.advance(mathieu, shift, 6.0 + 0.1 * i, results.back());
      }
    };
    std::vector<VectorXd> serial[2];
    std::vector<VectorXd> parallel[2];
    for (int i = 0; i < 2; ++i) work(0.5 * i, serial[i]);
    std::thread first(work, 0.0, std::ref(parallel[0]));
    std::thread second(work, 0.5, std::ref(parallel[1]));
    first.join();
    second.join();
    for (int i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < serial[i].size(); ++j) CHECK(same_bits(serial[i][j], parallel[i][j]));
  }
}

}  // namespace strutt::test::integrator_test
