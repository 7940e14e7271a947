// Results of an integrator depend neither on what it did before nor on other threads.
#include <catch2/catch.hpp>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "integrate/methods.hpp"
#include "strutt/integrate/integrator.hpp"

namespace strutt::test::integrator_reuse_test {

using Eigen::VectorXd;

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

}  // namespace strutt::test::integrator_reuse_test
