#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include "integrate/methods.hpp"
#include "strutt/base/error.hpp"
#include "strutt/integrate/integrator.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::failure_test {

using Eigen::VectorXd;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a call prints to the standard error, by file descriptor: C code prints past std::cerr.
template <typename Call>
std::string printed_by(const Call& call) {
  std::fflush(stderr);
  const int saved = dup(STDERR_FILENO);
  std::FILE* file = std::tmpfile();
  dup2(fileno(file), STDERR_FILENO);
  call();
  std::fflush(stderr);
  dup2(saved, STDERR_FILENO);
  close(saved);
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  std::fclose(file);
  return text;
}

double seconds_of(const std::function<void()>& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

TEST_CASE("nothing to do is done", "[integrate][limits]") {
  for (const Method& method : kMethods) {
    VectorXd y = vector({1.0, 2.0});
    const auto result = integrate(oscillator, 3.0, 3.0, y, options_of(method, 1e-6));
    CHECK(result.outcome == Outcome::converged);
    CHECK(result.t == 3.0);
    CHECK(result.cost.right_hand_sides == 0);
    CHECK(same_bits(y, vector({1.0, 2.0})));
  }
}

TEST_CASE("the smallest of intervals", "[integrate][limits][ratchet]") {
  for (const Method& method : kMethods) {
    for (const double t1 : {std::nextafter(3.0, 4.0), 3.0 + 1e-15, 3.0 - 1e-14, 3.0 + 1e-13}) {
      VectorXd y = vector({1.0, 2.0});
      const auto result = integrate(oscillator, 3.0, t1, y, options_of(method, 1e-6));
      CHECK(result.outcome == Outcome::converged);
      CHECK(result.t == t1);
      check_within("state after the smallest of intervals", std::abs(y[0] - (1.0 + 2.0 * (t1 - 3.0))), 1e-14);
    }
  }
}

TEST_CASE("input that is not finite", "[integrate][failure][extreme][N36]") {
  for (const Method& method : kMethods) {
    const IntegratorOptions options = options_of(method, 1e-6);
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      VectorXd y = vector({1.0, 2.0});
      CHECK(integrate(oscillator, bad, 1.0, y, options).outcome == Outcome::non_finite);
      CHECK(integrate(oscillator, 0.0, bad, y, options).outcome == Outcome::non_finite);
      CHECK(same_bits(y, vector({1.0, 2.0})));
      y[1] = bad;
      CHECK(integrate(oscillator, 0.0, 1.0, y, options).outcome == Outcome::non_finite);
    }
  }
}

TEST_CASE("a right-hand side that is not finite ends the run where it was",
          "[integrate][failure][extreme][N37][ratchet]") {
  for (const Method& method : kMethods) {
    for (const double bad : {kNan, kInfinity}) {
      for (const double when : {-1.0, 0.7}) {
        INFO(name(method) << " " << bad << " " << when);
        long calls_after = 0;
        const auto f = [&](double t, StateView y, StateOut dydt) {
          oscillator(t, y, dydt);
          if (t > when) dydt[0] = bad, ++calls_after;
        };
        VectorXd y = vector({1.0, 0.0});
        const auto result = integrate(f, 0.0, 2.0, y, options_of(method, 1e-6));
        CHECK(result.outcome == Outcome::non_finite);
        CHECK(result.t <= std::max(when, 0.0));
        check_within("state where a run ended early at tolerance 1e-6", std::abs(y[0] - std::cos(result.t)),
                     3e-6);
        CHECK(calls_after == 1);
      }
    }
  }
}

TEST_CASE("tolerances nobody can reach", "[integrate][failure][extreme][N17]") {
  for (const Method& method : kMethods) {
    IntegratorOptions options = options_of(method, 1e-6);
    options.relative_tolerance = 0.9e-15;
    long calls = 0;
    const auto counted = [&calls](double t, StateView y, StateOut dydt) {
      ++calls;
      oscillator(t, y, dydt);
    };
    VectorXd y = vector({1.0, 0.5});
    const auto result = integrate(counted, 0.0, 1.0, y, options);
    CHECK(result.outcome == Outcome::tolerance_not_reached);
    CHECK(result.t == 0.0);
    CHECK(calls == 0);
    CHECK(same_bits(y, vector({1.0, 0.5})));

    // A relative error of zero, at the start and on the way.
    options = options_of(method, 1e-6);
    options.absolute_tolerance = 0.0;
    y = vector({1.0, 0.0});
    CHECK(integrate(oscillator, 0.0, 1.0, y, options).outcome == Outcome::tolerance_not_reached);
  }
}

TEST_CASE("a run past a singularity ends, quickly and silently", "[integrate][failure][extreme][N16]") {
  const auto blow_up = [](double, StateView y, StateOut dydt) { dydt[0] = y[0] * y[0]; };
  const auto pole = [](double t, StateView, StateOut dydt) { dydt[0] = -1.0 / (t - 1.0); };
  for (const Method& method : kMethods) {
    INFO(name(method));
    IntegratorOptions options = options_of(method, method.order <= 3 ? 1e-4 : 1e-9);
    for (const RightHandSide& f : {RightHandSide(blow_up), RightHandSide(pole)}) {
      VectorXd y = vector({1.0});
      IntegrationResult result;
      double seconds = 0.0;
      const std::string text =
          printed_by([&] { seconds = seconds_of([&] { result = integrate(f, 0.0, 2.0, y, options); }); });
      CHECK(text.empty());
      CHECK(result.outcome != Outcome::converged);
      CHECK(result.t < 1.01);
      CHECK(seconds < 2.0);
    }
  }
}

TEST_CASE("a step that no longer changes the time", "[integrate][failure][extreme][N16]") {
  // At t = 1e10 doubles are 2e-6 apart; the solution turns within 1e-9.
  const auto fast = [](double, StateView y, StateOut dydt) {
    dydt[0] = 1e9 * y[1];
    dydt[1] = -1e9 * y[0];
  };
  for (const Method& method : kMethods) {
    if (method.backend == Backend::cvode_bdf) continue;  // takes it as stiff, see the next line
    INFO(name(method));
    VectorXd y = vector({1.0, 0.0});
    IntegrationResult result;
    CHECK(
        printed_by([&] { result = integrate(fast, 1e10, 1e10 + 1.0, y, options_of(method, 1e-8)); }).empty());
    CHECK(result.outcome == Outcome::step_underflow);
    CHECK(result.t < 1e10 + 1.0);
  }
}

TEST_CASE("budgets and cancelling", "[integrate][limits][ratchet]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    IntegratorOptions options = options_of(method, 1e-6);
    options.max_steps = 5;
    VectorXd y = vector({1.0, 0.0});
    auto result = integrate(oscillator, 0.0, 1e6, y, options);
    CHECK(result.outcome == Outcome::step_limit);
    CHECK(result.cost.steps == 5);
    CHECK(result.t > 0.0);
    check_within("state where a run ran out of steps at tolerance 1e-6", std::abs(y[0] - std::cos(result.t)),
                 8e-6);

    options = options_of(method, 1e-6);
    options.max_seconds = 0.05;
    CHECK(seconds_of([&] { result = integrate(oscillator, 0.0, 1e9, y, options); }) < 0.5);
    CHECK(result.outcome == Outcome::time_limit);
    options.max_seconds = 0.0;
    CHECK(integrate(oscillator, 0.0, 1.0, y, options).outcome == Outcome::time_limit);

    std::atomic<bool> cancel = false;
    options = options_of(method, 1e-6);
    options.cancel = &cancel;
    long calls_after = 0;
    const auto cancelling = [&](double t, StateView v, StateOut dydt) {
      oscillator(t, v, dydt);
      if (cancel) ++calls_after;
      if (t > 20.0) cancel = true;
    };
    y = vector({1.0, 0.0});
    result = integrate(cancelling, 0.0, 1e6, y, options);
    CHECK(result.outcome == Outcome::cancelled);
    CHECK(calls_after < 100);
    CHECK(integrate(oscillator, 0.0, 1.0, y, options).t == 0.0);
  }
}

TEST_CASE("exceptions reach the caller, and the integrator can be used again", "[integrate][failure]") {
  for (const Method& method : kMethods) {
    INFO(name(method));
    Integrator integrator(2, options_of(method, 1e-6));
    VectorXd fresh = vector({1.0, 0.0});
    integrator.advance(oscillator, 0.0, 3.0, fresh);
    for (const double when : {-1.0, 1.5}) {
      const auto throwing = [when](double t, StateView y, StateOut dydt) {
        oscillator(t, y, dydt);
        if (t > when) throw std::runtime_error("it broke at " + std::to_string(when));
      };
      const auto throwing_event = [&](double t, StateView y, StateOut g) { throwing(t, y, g); };
      VectorXd y = vector({1.0, 0.0});
      CHECK_THROWS_WITH(integrator.advance(throwing, 0.0, 3.0, y), "it broke at " + std::to_string(when));
      CHECK(same_bits(y, vector({1.0, 0.0})));
      const EventRequest request{throwing_event, {Crossing::rising, Crossing::rising}, false};
      CHECK_THROWS_WITH(integrator.advance(oscillator, 0.0, 3.0, y, &request),
                        "it broke at " + std::to_string(when));
      integrator.advance(oscillator, 0.0, 3.0, y);
      CHECK(same_bits(y, fresh));
    }
  }
}

TEST_CASE("options are checked", "[integrate][input]") {
  const auto refused = [](auto change) {
    IntegratorOptions options;
    change(options);
    CHECK_THROWS_AS(Integrator(2, options), InvalidInput);
  };
  refused([](auto& o) { o.order = 7; });
  refused([](auto& o) { o.relative_tolerance = 0.0; });
  refused([](auto& o) { o.relative_tolerance = kNan; });
  refused([](auto& o) { o.absolute_tolerance = -1.0; });
  refused([](auto& o) { o.max_step = 0.0; });
  refused([](auto& o) { o.max_step = kNan; });
  refused([](auto& o) { o.first_step = -0.1; });
  refused([](auto& o) { o.first_step = kInfinity; });
  refused([](auto& o) { o.max_steps = 0; });
  refused([](auto& o) { o.max_seconds = -1.0; });
  CHECK_THROWS_AS(Integrator(0, {}), InvalidInput);

  Integrator integrator(2, {});
  IntegratorOptions other;
  other.order = 5;
  CHECK_THROWS_AS(integrator.set_options(other), InvalidInput);
  other = {};
  other.backend = Backend::cvode_adams;
  CHECK_THROWS_AS(integrator.set_options(other), InvalidInput);
  VectorXd y = VectorXd::Zero(3);
  CHECK_THROWS_AS(integrator.advance(oscillator, 0.0, 1.0, y), InvalidInput);
}

}  // namespace strutt::test::failure_test
