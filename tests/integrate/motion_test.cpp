#include "strutt/integrate/motion.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "strutt/base/error.hpp"
#include "support/paths.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::motion_test {

using strutt::test::check_within;

namespace {

struct ReferenceMotion {
  double length, gravity, amplitude, frequency, damping, angle0, velocity0, t;
  long double angle, velocity;
  double sensitivity;  // s = max(1, largest |entry| of d(phi, phi'/alpha)/d(phi0, phi0'/alpha)); 0: not known
};

std::vector<ReferenceMotion> read_motions(const std::string& name) {
  std::ifstream file(strutt::test::source_directory() + "/tests/reference/" + name);
  std::vector<ReferenceMotion> rows;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line[0] == 'l') continue;
    std::array<std::string, 11> cells;
    std::istringstream stream(line);
    for (auto& cell : cells) std::getline(stream, cell, ',');
    const auto real = [&](std::size_t i) { return std::strtod(cells[i].c_str(), nullptr); };
    rows.push_back({real(0), real(1), real(2), real(3), real(4), real(5), real(6), real(7),
                    std::strtold(cells[8].c_str(), nullptr), std::strtold(cells[9].c_str(), nullptr),
                    real(10)});
  }
  return rows;
}

std::vector<ReferenceMotion> reference_motions() {
  auto rows = read_motions("motion.csv");
  REQUIRE(rows.size() == 40);
  return rows;
}

const PhysicalPendulum kRod = PhysicalPendulum::uniform_rod(1.0, 1.0);

double motion_error(const MotionPoint& point, long double angle) {
  return static_cast<double>(std::abs(static_cast<long double>(point.angle) - angle));
}

}  // namespace

TEST_CASE("the bound of a motion is never below the true error", "[integrate][motion][ratchet]") {
  const auto method = GENERATE(strutt::Method::automatic, strutt::Method::cvode);
  const auto tolerance = GENERATE(1e-2, 1e-5, 1e-9, 1e-12);
  double worst = 0.0;
  int converged = 0;
  for (const auto& row : reference_motions()) {
    const auto rod = PhysicalPendulum::uniform_rod(1.0, row.length, row.gravity, row.damping);
    const auto support = sinusoidal_support(row.amplitude, row.frequency);
    const MotionOptions options{.tolerance = tolerance, .method = method};
    const auto motion =
        integrate_motion(rod, &support, nullptr, {row.angle0, row.velocity0}, std::array{row.t}, options);
    const MotionPoint& point = motion.points.at(0);
    const double error = motion_error(point, row.angle);
    INFO(row.frequency << " rad/s, " << row.t << " s: error " << error << ", bound " << point.error);
    CHECK(error <= point.error);
    CHECK((point.outcome == Outcome::converged) == (point.error <= tolerance));
    // Two motions amplify rounding by 1e6 and 1e13 until t = 20 s, the first one by 1e3 until t = 10 s.
    const bool sensitive = (row.frequency == 7.0 && row.t == 20.0) ||
                           (row.frequency == 6.0 &&
                            ((row.t == 20.0 && tolerance < 1e-4) || (row.t == 10.0 && tolerance < 1e-8)));
    if (tolerance >= 1e-9 && method == strutt::Method::automatic && !sensitive)
      CHECK(point.outcome == Outcome::converged);
    converged += point.outcome == Outcome::converged;
    if (point.error > 0.0) worst = std::max(worst, error / point.error);
    if (point.error > 0.0) check_within("true error of a motion over its bound", error / point.error, 1.0);
    const double velocity_error = static_cast<double>(std::abs(point.velocity - row.velocity));
    CHECK(velocity_error <= 100.0 * point.error * std::max(1.0, row.frequency));
  }
  INFO("tolerance " << tolerance << ": converged " << converged << ", largest error/bound " << worst);
  CHECK(worst > 1e-4);
  if (method == strutt::Method::automatic) CHECK(converged >= (tolerance >= 1e-9 ? 37 : 15));
}

TEST_CASE("an excited motion keeps ten digits over fifty periods",
          "[integrate][motion][reference][ratchet]") {
  const auto method = GENERATE(strutt::Method::arkode, strutt::Method::cvode);
  const auto rows = read_motions("long_motion.csv");
  REQUIRE(rows.size() == 5);
  for (const auto& row : rows) {
    const auto rod = PhysicalPendulum::uniform_rod(1.0, row.length, row.gravity, row.damping);
    const auto support = sinusoidal_support(row.amplitude, row.frequency);
    const auto motion = integrate_motion(rod, &support, nullptr, {row.angle0, row.velocity0},
                                         std::array{row.t}, {.tolerance = 1e-13, .method = method});
    const MotionPoint& point = motion.points.at(0);
    const double error = motion_error(point, row.angle);
    INFO(to_string(method) << ", " << row.frequency << " rad/s: error " << error << ", bound " << point.error
                           << ", s " << row.sensitivity);
    REQUIRE(row.sensitivity >= 1.0);
    check_within("angle after fifty periods over its sensitivity", error / row.sensitivity, 1e-11);
    CHECK(error <= point.error);
  }
}

TEST_CASE("many times in one call keep the bound, in any order", "[integrate][motion]") {
  // Samples so close that both runs take the same steps.
  const auto rows = reference_motions();
  for (std::size_t first = 0; first < rows.size(); first += 5) {
    const auto& row = rows[first];
    const auto rod = PhysicalPendulum::uniform_rod(1.0, row.length, row.gravity, row.damping);
    const auto support = sinusoidal_support(row.amplitude, row.frequency);
    std::vector<double> times;
    for (std::size_t j = 5; j-- > 0;) times.push_back(rows[first + j].t);
    const std::size_t references = times.size();
    for (const int samples : {0, 200, 4000}) {
      times.resize(references);
      for (int j = 0; j < samples; ++j) times.push_back(20.0 * j / samples);
      const auto motion =
          integrate_motion(rod, &support, nullptr, {row.angle0, row.velocity0}, times, {.tolerance = 1e-6});
      REQUIRE(motion.points.size() == times.size());
      for (std::size_t j = 0; j < times.size(); ++j) CHECK(motion.points[j].t == times[j]);
      for (std::size_t j = 0; j < references; ++j) {
        CHECK(motion_error(motion.points[j], rows[first + 4 - j].angle) <= motion.points[j].error);
      }
    }
  }
}

TEST_CASE("the power balance of the shaken pendulum with moment and damping holds",
          "[integrate][motion][ratchet]") {
  auto body = PhysicalPendulum::uniform_rod(2.0, 0.7);
  body.damping = 0.3;
  const Excitation support{9.0, PeriodicFunction::fourier(0.0, {{1, 0.0, 0.05}, {3, 0.01, 0.0}})};
  const Excitation moment{9.0, PeriodicFunction::fourier(0.4, {{2, 0.3, -0.5}})};
  const auto rate = support.function.derivative();
  const auto acceleration = rate.derivative();

  // Composite Gauss-Legendre rule of order 10 for the work between two times.
  const std::array<double, 5> node{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                   0.9061798459386640};
  const std::array<double, 5> weight{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                     0.4786286704993665, 0.2369268850561891};
  const double end = 4.0;
  const int intervals = 200;
  std::vector<double> times{0.0, end};
  for (int i = 0; i < intervals; ++i)
    for (const double x : node) times.push_back(end / intervals * (i + 0.5 + 0.5 * x));
  const auto motion = integrate_motion(body, &support, &moment, {1.0, -2.0}, times, {.tolerance = 1e-10});

  const auto energy = [&](const MotionPoint& p) {
    const double theta = 9.0 * p.t;
    return body.kinetic_energy(p.angle, p.velocity, 9.0 * rate(theta)) +
           body.potential_energy(p.angle, support.value(p.t));
  };
  double work = 0.0;
  for (std::size_t j = 2; j < times.size(); ++j) {
    const auto& p = motion.points[j];
    REQUIRE(p.outcome == Outcome::converged);
    const double theta = 9.0 * p.t;
    const double support_acceleration = 81.0 * acceleration(theta);
    const double angular =
        body.angular_acceleration(p.angle, p.velocity, support_acceleration, moment.value(p.t));
    const double power =
        body.support_force(p.angle, p.velocity, angular, support_acceleration) * 9.0 * rate(theta) +
        moment.value(p.t) * p.velocity - body.damping * body.inertia * p.velocity * p.velocity;
    work += 0.5 * end / intervals * weight[(j - 2) % 5] * power;
  }
  check_close("power balance of a driven pendulum (relative)",
              energy(motion.points[1]) - energy(motion.points[0]), work, 8e-14);
}

TEST_CASE("the free pendulum keeps its first integral and its bound over many periods",
          "[integrate][motion]") {
  const auto start = GENERATE(MotionStart{2.0, 0.0}, MotionStart{3.0, 2.0}, MotionStart{1e-8, 0.0});
  const double alpha = kRod.alpha();
  const double energy = std::pow(start.velocity / alpha, 2) - 4.0 * std::pow(std::cos(start.angle / 2.0), 2);
  const auto motion =
      integrate_motion(kRod, nullptr, nullptr, start, std::array{10.0, 300.0}, {.tolerance = 1e-7});
  for (const auto& point : motion.points) {
    CHECK(point.outcome == Outcome::converged);
    CHECK(std::abs(point.energy - energy) <= 10.0 * point.error);
  }
}

TEST_CASE("starts at the equilibria", "[integrate][motion][ratchet]") {
  const std::array times{0.0, 1.0, 5.0, 12.0};
  for (const auto& point : integrate_motion(kRod, nullptr, nullptr, {0.0, 0.0}, times, {}).points) {
    CHECK(point.angle == 0.0);
    CHECK(point.velocity == 0.0);
    CHECK(point.energy == -4.0);
    CHECK(point.outcome == Outcome::converged);
  }
  // The double next to pi lies 1.22e-16 below it: the rod falls, and the bound stays small.
  const double rest = -1.2246467991473532e-16;
  const auto fall = integrate_motion(kRod, nullptr, nullptr, {std::numbers::pi, 0.0}, times, {}).points;
  CHECK(fall[0].angle == std::numbers::pi);
  for (const auto& point : fall) CHECK(point.outcome == Outcome::converged);
  const double grown = rest * std::cosh(kRod.alpha() * 5.0);
  check_close("fall from the double next to pi (relative)", fall[2].angle - std::numbers::pi, grown, 4e-8);
  check_within("energy of the fall from the double next to pi", std::abs(fall[2].energy), 1e-20);
  check_within("energy of a fall from the top after turns", std::abs(fall[3].energy + rest * rest), 8e-14);
}

TEST_CASE("the linear motion has its closed form", "[integrate][motion]") {
  const double alpha = kRod.alpha();
  const std::array times{0.3, 2.0};
  const auto hanging = integrate_motion(kRod, nullptr, nullptr, {0.5, 1.0}, times, {.linear = true});
  const auto inverted = integrate_motion(kRod, nullptr, nullptr, {3.0, 0.0}, times,
                                         {.linear = true, .about = Equilibrium::inverted});
  for (std::size_t j = 0; j < times.size(); ++j) {
    const double t = times[j];
    const double swing = 0.5 * std::cos(alpha * t) + std::sin(alpha * t) / alpha;
    CHECK(std::abs(hanging.points[j].angle - swing) <= hanging.points[j].error + 1e-15);
    const double fall = std::numbers::pi + (3.0 - std::numbers::pi) * std::cosh(alpha * t);
    CHECK(std::abs(inverted.points[j].angle - fall) <= inverted.points[j].error + 1e-12);
    CHECK(inverted.points[j].outcome == Outcome::converged);
  }
}

TEST_CASE("a square support acceleration is integrated piece by piece", "[integrate][motion]") {
  // Linear and hanging: constant stiffness on each half period.
  const double alpha = kRod.alpha(), omega = 4.0, amplitude = 0.1;
  const auto support = square_acceleration_support(amplitude, omega);
  double x = 0.2, v = 0.0;
  const double half = std::numbers::pi / omega;
  for (int j = 0; j < 6; ++j) {
    const double sign = j % 2 == 0 ? -1.0 : 1.0;
    const double s = alpha * std::sqrt(1.0 + sign * amplitude * omega * omega / kRod.gravity);
    const double next = x * std::cos(s * half) + v / s * std::sin(s * half);
    v = -x * s * std::sin(s * half) + v * std::cos(s * half);
    x = next;
  }
  const MotionOptions options{.tolerance = 1e-12, .linear = true};
  const auto motion = integrate_motion(kRod, &support, nullptr, {0.2, 0.0}, std::array{6.0 * half}, options);
  CHECK(motion.points[0].outcome == Outcome::converged);
  CHECK(std::abs(motion.points[0].angle - x) <= motion.points[0].error + 1e-14);
}

TEST_CASE("a moment without a support drives the pendulum", "[integrate][motion]") {
  // Linear, undamped, M = m cos(omega t): x = A (cos(omega t) - cos(alpha t)), A = m/Theta/(alpha^2 -
  // omega^2).
  const Excitation moment{2.5, PeriodicFunction::fourier(0.0, {{1, 0.3, 0.0}})};
  const double alpha = kRod.alpha(), t = 7.0;
  const double expected =
      0.3 / kRod.inertia / (alpha * alpha - 6.25) * (std::cos(2.5 * t) - std::cos(alpha * t));
  const MotionOptions options{.tolerance = 1e-12, .linear = true};
  const auto motion = integrate_motion(kRod, nullptr, &moment, {0.0, 0.0}, std::array{t}, options);
  CHECK(std::abs(motion.points[0].angle - expected) <= motion.points[0].error + 1e-14);
  CHECK(motion.points[0].outcome == Outcome::converged);
}

}  // namespace strutt::test::motion_test
