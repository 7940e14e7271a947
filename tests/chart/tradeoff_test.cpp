#include "strutt/chart/tradeoff.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::tradeoff_test {

namespace {

Scene mathieu(double delta, double epsilon, double damping = 0.0) {
  Scene scene;
  scene.mathieu = MathieuTable{false, delta, epsilon, damping};
  return scene;
}

/// Measured as shortly as possible: no test looks at the times.
TradeoffRequest quick(std::vector<double> tolerances = {}) {
  return {.tolerances = std::move(tolerances), .repeats = 1, .seconds = 0.0, .threads = 1};
}

const TradeoffRow& row_of(const Tradeoff& tradeoff, Method method, double tolerance) {
  const auto found = std::find_if(tradeoff.rows.begin(), tradeoff.rows.end(), [&](const TradeoffRow& row) {
    return row.method == method && row.tolerance == tolerance;
  });
  REQUIRE(found != tradeoff.rows.end());
  return *found;
}

/// What holds of every row, whatever the machine.
void check_laws(const Tradeoff& tradeoff) {
  CHECK_FALSE(tradeoff.cancelled);
  for (const auto& row : tradeoff.rows) {
    INFO(to_string(row.method) << " at " << row.tolerance << ": error " << row.error << ", true "
                               << row.true_error);
    CHECK(row.exceeded == 0);
    CHECK(row.true_error <= row.error);
    CHECK(row.median_true_error <= row.true_error);
    CHECK(row.points == tradeoff.points);
    CHECK((row.converged < row.points || row.error <= row.tolerance));
    CHECK(row.points_per_second > 0.0);
    CHECK(std::isfinite(row.points_per_second));
    CHECK(row.spread == 0.0);  // a single measurement
    const bool mixed = row.method == Method::automatic || row.method == Method::surrogate;
    CHECK((mixed || row.used == std::vector{row.method}));
  }
}

}  // namespace

TEST_CASE("Every method that fits is measured at every decade", "[chart][tradeoff]") {
  const auto tradeoff = measure_tradeoff(mathieu(1.0, 0.5), quick());
  check_laws(tradeoff);
  REQUIRE(tradeoff.rows.size() == 4 * 12);
  CHECK(tradeoff.points == 1);
  std::set<Method> methods;
  for (const auto& row : tradeoff.rows) methods.insert(row.method);
  CHECK(methods == std::set{Method::automatic, Method::propagator, Method::arkode, Method::cvode});
  CHECK(tradeoff.rows.front().tolerance == 1e-2);
  CHECK(tradeoff.rows.back().tolerance == 1e-13);
  CHECK(row_of(tradeoff, Method::propagator, 1e-9).converged == 1);
}

TEST_CASE("The surrogate of a box is measured, building included", "[chart][tradeoff][surrogate][slow]") {
  Scene rod;  // a sine: seen from another phase than 0
  rod.pendulum = PendulumTable{.length = 1.0};
  rod.support = SupportTable{.amplitude = 0.1, .frequency = 12.0};
  const auto check = [](const Scene& scene, const Axis& x, const Axis& y) {
    auto request = quick({1e-4, 1e-9, 1e-13});
    request.points = scattered_points(x, y, 20);
    request.methods = {Method::surrogate, Method::propagator};
    const auto tradeoff = measure_tradeoff(scene, request);
    check_laws(tradeoff);
    for (const double tolerance : {1e-4, 1e-9}) {
      const auto& row = row_of(tradeoff, Method::surrogate, tolerance);
      CHECK(row.used == std::vector{Method::surrogate});
      CHECK(row.converged == 20);
      CHECK(row.right_hand_sides < 0.5 * row_of(tradeoff, Method::propagator, tolerance).right_hand_sides);
    }
    // where rounding alone is more than the tolerance the points are computed one by one
    CHECK(row_of(tradeoff, Method::surrogate, 1e-13).used == std::vector{Method::propagator});
  };
  check(mathieu(1.0, 0.5), {"mathieu.delta", -1.0, 5.0, 200}, {"mathieu.epsilon", 0.0, 6.0, 200});
  check(rod, {"support.frequency", 6.0, 40.0, 200}, {"support.amplitude", 0.0, 0.3, 200});
  rod.pendulum->about = Equilibrium::inverted;  // M from the even phase is often larger than from 0
  check(rod, {"support.frequency", 5.0, 100.0, 200}, {"support.amplitude", 0.0, 0.4, 200});
  auto request = quick({1e-9});
  request.methods = {Method::surrogate};
  CHECK_THROWS_AS(measure_tradeoff(mathieu(1.0, 0.5), request), InvalidInput);  // no box
}

TEST_CASE("More accuracy is more work", "[chart][tradeoff]") {
  const auto tradeoff = measure_tradeoff(mathieu(1.0, 0.5), quick({1e-3, 1e-7, 1e-11}));
  for (const Method method : {Method::propagator, Method::arkode, Method::cvode}) {
    const auto& rough = row_of(tradeoff, method, 1e-3);
    const auto& fine = row_of(tradeoff, method, 1e-11);
    CHECK(fine.true_error < 1e-3 * rough.true_error);
    CHECK(rough.steps > 0.0);
    CHECK(fine.steps >= rough.steps);  // a power series takes more terms first
    CHECK(fine.right_hand_sides > rough.right_hand_sides);
    if (method != Method::propagator) CHECK(rough.estimate_right_hand_sides > 0.0);  // whose bound costs none
  }
}

TEST_CASE("Bounds hold at the extremes", "[chart][tradeoff][extremes]") {
  const auto check = [](const Scene& scene) {
    check_laws(measure_tradeoff(scene, quick({1e-2, 1e-6, 1e-9, 1e-13})));
  };
  SECTION("delta = 1e4") { check(mathieu(1e4, 1.0)); }
  SECTION("delta = -50") { check(mathieu(-50.0, 10.0)); }
  SECTION("epsilon = 1e3") { check(mathieu(1.0, 1e3)); }
  SECTION("damping = 1e-9") { check(mathieu(1.0, 0.5, 1e-9)); }
  SECTION("damping = 10") { check(mathieu(1.0, 0.5, 10.0)); }
  SECTION("a support 100 times as fast as the rod") {
    Scene scene;
    scene.pendulum = PendulumTable{.length = 1.0, .about = Equilibrium::inverted};
    scene.support = SupportTable{.amplitude = 0.02, .frequency = 100.0 * std::sqrt(1.5 * 9.81)};
    check(scene);
  }
}

TEST_CASE("A coefficient that jumps has a closed form, which beats the others",
          "[chart][tradeoff][ratchet]") {
  Scene scene;
  scene.hill = HillTable{.waveform = Waveform::square, .period = 6.0, .mean = 1.0, .amplitude = 0.5};
  const auto tradeoff = measure_tradeoff(scene, quick({1e-4, 1e-10}));
  check_laws(tradeoff);
  CHECK(row_of(tradeoff, Method::automatic, 1e-10).used == std::vector{Method::exact});
  check_within("true error of M of a square wave in closed form",
               row_of(tradeoff, Method::exact, 1e-4).true_error, 1e-15);
}

TEST_CASE("Systems with n states have fewer methods", "[chart][tradeoff]") {
  Scene scene;
  LinearPeriodicSystem system;
  system.period = 3.0;
  system.mass = Eigen::Matrix2d::Identity();
  system.stiffness = {Eigen::MatrixXd{{1.3, -0.3}, {-0.3, 2.3}},
                      {{1, Eigen::MatrixXd{{0.4, 0.0}, {0.0, 0.0}}, {}}}};
  scene.linear = system;
  const auto tradeoff = measure_tradeoff(scene, quick({1e-6}));
  check_laws(tradeoff);
  for (const auto& row : tradeoff.rows) CHECK(row.method != Method::exact);
  CHECK(row_of(tradeoff, Method::arkode, 1e-6).converged == 1);
}

TEST_CASE("Points are scattered over the box of two axes", "[chart][tradeoff]") {
  const Axis x{.parameter = "mathieu.delta", .from = -1.0, .to = 3.0, .points = 7};
  const Axis y{
      .parameter = "mathieu.epsilon", .from = 1e-4, .to = 1.0, .points = 5, .scale = AxisScale::logarithmic};
  const auto points = scattered_points(x, y, 400);
  CHECK(points.parameters == std::vector<std::string>{"mathieu.delta", "mathieu.epsilon"});
  REQUIRE(points.rows.size() == 400);
  int cells[4][4] = {};
  for (const auto& row : points.rows) {
    CHECK((row[0] >= -1.0 && row[0] <= 3.0 && row[1] >= 1e-4 && row[1] <= 1.0));
    ++cells[std::min(static_cast<int>(row[0] + 1.0), 3)]
           [std::min(static_cast<int>(4.0 + std::log10(row[1])), 3)];
  }
  for (const auto& column : cells) {
    for (const int count : column) CHECK((count >= 20 && count <= 30));  // 25 on average
  }
  CHECK(scattered_points(x, y, 400).rows == points.rows);
  const Axis fixed{.parameter = "mathieu.delta", .from = 2.0, .to = 2.0, .points = 1};
  CHECK(scattered_points(fixed, y, 3).rows[2][0] == 2.0);
}

TEST_CASE("The errors are the largest of all points", "[chart][tradeoff]") {
  auto request = quick({1e-6});
  request.methods = {Method::arkode};
  const auto error_at = [&](std::vector<std::vector<double>> rows) {
    request.points = {{"mathieu.delta"}, std::move(rows)};
    return measure_tradeoff(mathieu(1.0, 0.5), request).rows.front();
  };
  std::vector<double> each;
  for (const double delta : {0.3, 2.0, 4.0}) each.push_back(error_at({{delta}}).true_error);
  std::sort(each.begin(), each.end());
  const auto all = error_at({{0.3}, {2.0}, {4.0}});
  CHECK(all.points == 3);
  CHECK(all.true_error == each[2]);
  CHECK(all.median_true_error == each[1]);
}

TEST_CASE("The front is what no other row beats in both", "[chart][tradeoff]") {
  const auto tradeoff = measure_tradeoff(mathieu(1.0, 0.5), quick());
  const auto beaten = [&](const TradeoffRow& row) {
    return std::any_of(tradeoff.rows.begin(), tradeoff.rows.end(), [&](const TradeoffRow& other) {
      return other.method != Method::automatic && other.true_error <= row.true_error &&
             other.points_per_second >= row.points_per_second &&
             (other.true_error < row.true_error || other.points_per_second > row.points_per_second);
    });
  };
  int marked = 0;
  for (const auto& row : tradeoff.rows) {
    marked += row.pareto ? 1 : 0;
    if (row.method == Method::automatic)
      CHECK_FALSE(row.pareto);
    else
      CHECK(row.pareto == !beaten(row));
  }
  CHECK(marked >= 1);
}

TEST_CASE("Points that make no equation are left out", "[chart][tradeoff]") {
  Scene scene = mathieu(1.0, 0.5);
  auto request = quick({1e-6});
  request.points = {{"mathieu.damping"}, {{0.1}, {-0.1}, {0.2}}};
  CHECK(measure_tradeoff(scene, request).points == 2);
  request.points.rows = {{-0.1}};
  CHECK_THROWS_AS(measure_tradeoff(scene, request), InvalidInput);
}

TEST_CASE("A study is watched and stopped", "[chart][tradeoff]") {
  std::atomic<bool> cancel = false;
  auto request = quick({1e-6});
  request.cancel = &cancel;
  std::size_t calls = 0, last = 0, total = 0;
  const auto complete = measure_tradeoff(mathieu(1.0, 0.5), request, [&](std::size_t done, std::size_t of) {
    ++calls;
    last = done;
    total = of;
  });
  CHECK_FALSE(complete.cancelled);
  CHECK((calls == 8 && last == 8 && total == 8));  // four methods, judged once and timed once
  const auto stopped = measure_tradeoff(mathieu(1.0, 0.5), request,
                                        [&](std::size_t done, std::size_t) { cancel = done == 2; });
  CHECK(stopped.cancelled);
  CHECK(stopped.rows.empty());
}

TEST_CASE("What cannot be measured is refused", "[chart][tradeoff][misuse]") {
  const Scene scene = mathieu(1.0, 0.5);
  const auto refused = [&](TradeoffRequest request) {
    CHECK_THROWS_AS(completed(scene, request), InvalidInput);
  };
  refused({.methods = {Method::exact}});
  refused({.methods = {Method::surrogate}});
  refused({.tolerances = {1e-14}});
  refused({.tolerances = {1e-3, NAN}});
  refused({.repeats = 0});
  refused({.seconds = NAN});
  const auto request = completed(scene, {});
  CHECK(request.methods.size() == 4);
  CHECK(request.tolerances.size() == 12);
  CHECK(expected_seconds(scene, request) > 0.0);
}

}  // namespace strutt::test::tradeoff_test
