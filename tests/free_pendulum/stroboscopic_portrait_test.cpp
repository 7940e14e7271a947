#include "strutt/free_pendulum/stroboscopic_portrait.hpp"

#include <array>
#include <atomic>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::stroboscopic_portrait_test {

namespace {

using std::numbers::pi;

const PhysicalPendulum kRod = PhysicalPendulum::uniform_rod(1.0, 1.0, 9.81, 0.05);  // of kGentle
const Excitation kSupport = sinusoidal_support(0.05, 12.0);

/// A rod of 1 m on a support with r = amplitude sin(frequency t).
struct ShakenRod {
  double amplitude, frequency, damping;
};
constexpr ShakenRod kGentle{0.05, 12.0, 0.05};
constexpr ShakenRod kStrong{0.2, 6.0, 0.0};

/// (7) in long double, `sections` turns of the support by a fixed step of order 8.
std::array<long double, 2> reference_section(const ShakenRod& rod, const MotionStart& start, int sections) {
  using State = std::array<long double, 2>;
  constexpr int kSteps = 240;
  const long double gravity = 9.81, omega = rod.frequency, damping = rod.damping;
  const long double alpha2 = 1.5L * gravity;
  const long double ratio = static_cast<long double>(rod.amplitude) * omega * omega / gravity;
  const auto rate = [&](const State& y, State& dydt, long double t) {
    dydt[0] = y[1];
    dydt[1] = -damping * y[1] - alpha2 * (1.0L - ratio * std::sin(omega * t)) * std::sin(y[0]);
  };
  boost::numeric::odeint::runge_kutta_fehlberg78<State, long double> stepper;
  State y{start.angle, start.velocity};
  const long double step = 2.0L * std::numbers::pi_v<long double> / omega / kSteps;
  for (int i = 0; i < sections * kSteps; ++i) stepper.do_step(rate, y, i * step, step);
  return y;
}

/// The distance of two angles on the circle.
double apart(long double a, long double b, int cells) {
  return static_cast<double>(std::abs(std::remainder(a - b, 2.0L * cells * std::numbers::pi_v<long double>)));
}

bool identical(const StroboscopicPortrait& a, const StroboscopicPortrait& b) {
  if (a.curves.size() != b.curves.size()) return false;
  for (std::size_t c = 0; c < a.curves.size(); ++c) {
    const auto &p = a.curves[c].points, &q = b.curves[c].points;
    if (p.size() != q.size()) return false;
    for (std::size_t j = 0; j < p.size(); ++j) {
      if (p[j].angle != q[j].angle || p[j].velocity != q[j].velocity) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("sections agree with an integration in long double", "[free_pendulum][portrait][ratchet]") {
  const std::array<MotionStart, 3> starts{
      {{0.7, 0.0}, {-1.4, 2.0}, {0.5, 12.0}}};  // two librations, a rotation
  const int cells = GENERATE(1, 2);
  const double tolerance = GENERATE(1e-5, 1e-9);
  const auto portrait = stroboscopic_portrait(kRod, &kSupport, nullptr, starts,
                                              {.cells = cells, .sections = 12, .tolerance = tolerance});
  check_close("period of the sections (relative)", portrait.period, 2.0 * pi / 12.0, 8e-16);
  REQUIRE(portrait.curves.size() == 3);
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const auto& points = portrait.curves[s].points;
    REQUIRE(points.size() == 13);
    CHECK(portrait.curves[s].kind == CurveKind::section);
    for (const int n : {1, 5, 12}) {
      const auto expected = reference_section(kGentle, starts[s], n);
      INFO("start " << s << ", section " << n);
      CHECK(apart(points[static_cast<std::size_t>(n)].angle, expected[0], cells) <= tolerance);
      check_within("velocity of a section over the tolerance",
                   std::abs(static_cast<double>(points[static_cast<std::size_t>(n)].velocity - expected[1])) /
                       tolerance,
                   0.012);
    }
    for (const auto& p : points) CHECK((p.angle >= -cells * pi && p.angle < cells * pi));
  }
  CHECK(portrait.asked == 36);
  CHECK(portrait.reached == 36);
  CHECK(portrait.ended_early == 0);
}

TEST_CASE("a chaotic curve ends where its error bound exceeds the tolerance", "[free_pendulum][portrait]") {
  const auto shaken = sinusoidal_support(kStrong.amplitude, kStrong.frequency);
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 1.0);
  const std::array<MotionStart, 2> starts{{{3.0, 0.0}, {0.0, 0.0}}};
  const auto loose =
      stroboscopic_portrait(rod, &shaken, nullptr, starts, {.sections = 150, .tolerance = 1e-3});
  const auto tight =
      stroboscopic_portrait(rod, &shaken, nullptr, starts, {.sections = 150, .tolerance = 1e-7});
  CHECK(loose.ended_early >= 1);
  CHECK(loose.curves[0].points.size() < 151);
  CHECK(loose.curves[0].points.size() > 10);
  CHECK(tight.curves[0].points.size() < loose.curves[0].points.size());
  // The last point is still right, though errors have grown by a factor of about 1e9.
  const auto& last = loose.curves[0].points.back();
  const auto expected =
      reference_section(kStrong, starts[0], static_cast<int>(loose.curves[0].points.size()) - 1);
  CHECK(apart(last.angle, expected[0], 1) <= 1e-3);
  CHECK(apart(last.angle, expected[0], 1) > 1e-15);
  CHECK(loose.asked == 300);
  CHECK(loose.reached == loose.curves[0].points.size() + loose.curves[1].points.size() - 2);
}

TEST_CASE("without excitation every section lies on the level of its start",
          "[free_pendulum][portrait][ratchet]") {
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 1.0);
  const auto resting = sinusoidal_support(0.0, 5.0);
  const auto starts = portrait_starts(rod.alpha(), 1, 12);
  const auto portrait =
      stroboscopic_portrait(rod, &resting, nullptr, starts, {.sections = 20, .tolerance = 1e-10});
  for (const auto& curve : portrait.curves) {
    for (const auto& p : curve.points) {
      const double rate = p.velocity / rod.alpha();
      check_within(
          "energy of a section without excitation at tolerance 1e-10",
          std::abs(rate * rate - 4.0 * std::pow(std::cos(p.angle / 2.0), 2) - curve.separatrix_excess),
          1.5e-12);
    }
  }
}

TEST_CASE("the period of the sections is that of the excitation, else the eigenperiod",
          "[free_pendulum][portrait][ratchet]") {
  const std::array<MotionStart, 1> start{{{0.5, 0.0}}};
  const Excitation beating{7.0, PeriodicFunction::fourier(0.1, {{1, 0.0, 0.2}})};
  const Excitation constant{7.0, PeriodicFunction::fourier(0.1, {})};
  const auto period = [&](const Excitation* support, const Excitation* moment) {
    return stroboscopic_portrait(kRod, support, moment, start, {.sections = 1}).period;
  };
  check_close("period of the sections (relative)", period(nullptr, &beating), 2.0 * pi / 7.0, 8e-16);
  CHECK(period(nullptr, &constant) == kRod.period());
  CHECK(period(nullptr, nullptr) == kRod.period());
  check_close("period of the sections (relative)", period(&kSupport, &constant), 2.0 * pi / 12.0, 8e-16);
}

TEST_CASE("sections are the same to the bit for any number of threads",
          "[free_pendulum][portrait][threads]") {
  const auto starts = portrait_starts(kRod.alpha(), 1, 9);
  const StroboscopicOptions options{.sections = 10, .threads = 1};
  const auto one = stroboscopic_portrait(kRod, &kSupport, nullptr, starts, options);
  for (const int threads : {2, 5}) {
    auto more = options;
    more.threads = threads;
    CHECK(identical(stroboscopic_portrait(kRod, &kSupport, nullptr, starts, more), one));
  }
}

TEST_CASE("a portrait of sections can be cancelled", "[free_pendulum][portrait][threads]") {
  const std::atomic<bool> cancel{true};
  const auto starts = portrait_starts(kRod.alpha(), 1, 4);
  const auto portrait = stroboscopic_portrait(kRod, &kSupport, nullptr, starts, {.cancel = &cancel});
  CHECK(portrait.cancelled);
  CHECK(portrait.curves.empty());
}

TEST_CASE("starts cover the window evenly", "[free_pendulum][portrait]") {
  const auto starts = portrait_starts(2.0, 2, 400);
  REQUIRE(starts.size() == 400);
  std::array<int, 4> quadrant{};
  for (const auto& start : starts) {
    CHECK(std::abs(start.angle) <= 2.0 * pi);
    CHECK(std::abs(start.velocity) <= 2.0 * 2.75);
    ++quadrant[(start.angle > 0.0 ? 1U : 0U) + (start.velocity > 0.0 ? 2U : 0U)];
  }
  for (const int count : quadrant) CHECK(std::abs(count - 100) <= 5);
}

TEST_CASE("a portrait of sections refuses misuse", "[free_pendulum][portrait][misuse]") {
  const std::array<MotionStart, 1> start{{{0.5, 0.0}}};
  const auto call = [&](const StroboscopicOptions& options) {
    return stroboscopic_portrait(kRod, &kSupport, nullptr, start, options);
  };
  CHECK_THROWS_AS(call({.cells = 0}), InvalidInput);
  CHECK_THROWS_AS(call({.sections = 0}), InvalidInput);
  CHECK_THROWS_AS(call({.tolerance = 1e-14}), InvalidInput);
  CHECK_THROWS_AS(call({.method = Method::fourier}), InvalidInput);
  CHECK_THROWS_AS(call({.threads = -1}), InvalidInput);
  CHECK_THROWS_AS(portrait_starts(0.0, 1, 1), InvalidInput);
  CHECK_THROWS_AS(portrait_starts(1.0, 1, 0), InvalidInput);
}

TEST_CASE("the progress of a portrait counts every curve once, up to all of them",
          "[free_pendulum][portrait]") {
  const auto starts = portrait_starts(kRod.alpha(), 1, 9);
  std::vector<std::size_t> told;
  StroboscopicOptions options{.sections = 2, .threads = GENERATE(1, 3)};
  options.progress = [&](std::size_t done, std::size_t total) {
    CHECK(total == 9);
    told.push_back(done);
  };
  stroboscopic_portrait(kRod, &kSupport, nullptr, starts, options);
  CHECK(told == std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7, 8, 9});
}

}  // namespace strutt::test::stroboscopic_portrait_test
