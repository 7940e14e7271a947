#include "strutt/free_pendulum/phase_portrait.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::phase_portrait_test {

namespace {

using std::numbers::pi;
constexpr long double kPi = std::numbers::pi_v<long double>;
constexpr double kUlp = 0x1p-52;

/// Levels from next to rest to next to the separatrix and far beyond.
PortraitOptions extreme_levels() {
  PortraitOptions options;
  options.points = 81;
  options.amplitudes = {1e-150, 1e-8, 0.1, 1.0, pi / 2, 3.0, 3.14159, 3.14159265358, std::nextafter(pi, 0.0)};
  options.excesses = {-3.999999, -1.0, -1e-6, -1e-20, -1e-300, 1e-300, 1e-20, 1e-9, 1e-3, 1.0, 50.0, 1e12};
  return options;
}

/// (phi'/alpha)^2 - 4 cos^2(phi/2) - E and how much of it the rounding of a point explains, in long double.
std::array<long double, 2> level_error(const PhasePoint& p, double excess, double alpha) {
  const long double v = static_cast<long double>(p.velocity) / static_cast<long double>(alpha);
  const long double c = 2.0L * std::cos(static_cast<long double>(p.angle) / 2.0L);
  const long double slope = 2.0L * std::abs(std::sin(static_cast<long double>(p.angle)));
  const long double error = (v - c) * (v + c) - static_cast<long double>(excess);
  const long double dv = 2.0L * kUlp * std::abs(v), dphi = kUlp * std::abs(static_cast<long double>(p.angle));
  return {std::abs(error), 2.0L * std::abs(v) * dv + dv * dv + slope * dphi + dphi * dphi +
                               4.0L * kUlp * std::abs(static_cast<long double>(excess))};
}

/// Arc length between two points of the same level, an independent way: along the angle where the curve is
/// flat, along the velocity where it is steep.
long double arc_between(PhasePoint a, PhasePoint b, double excess) {
  using Rule = boost::math::quadrature::gauss_kronrod<long double, 61>;
  const long double e = excess;
  const auto rule = [](const auto& f, long double from, long double to) {
    return std::abs(Rule::integrate(f, from, to, 12, 1e-15L));
  };
  const auto along_angle = [=](long double phi) {
    const long double c = 2.0L * std::cos(phi / 2.0L), v = std::sqrt(e + c * c);
    return std::hypot(1.0L, std::sin(phi) / v);
  };
  // sin(phi) from 4 cos^2(phi/2) = v^2 - E.
  const auto along_velocity = [=](long double v) {
    const long double c2 = (v * v - e) / 4.0L, sine = 2.0L * std::sqrt(c2 * (1.0L - c2));
    return std::hypot(1.0L, v / sine);
  };
  const long double slope = std::abs(std::sin(static_cast<long double>(a.angle + b.angle) / 2.0L));
  const long double height = std::abs(static_cast<long double>(a.velocity + b.velocity) / 2.0L);
  return height > slope ? rule(along_angle, a.angle, b.angle) : rule(along_velocity, a.velocity, b.velocity);
}

const PhaseCurve& first_of(const std::vector<PhaseCurve>& curves, CurveKind kind) {
  return *std::find_if(curves.begin(), curves.end(), [=](const auto& c) { return c.kind == kind; });
}

bool same(const PhasePoint& a, const PhasePoint& b) { return a.angle == b.angle && a.velocity == b.velocity; }

}  // namespace

TEST_CASE("every point lies on its level within the rounding of the point", "[free_pendulum][portrait]") {
  auto options = extreme_levels();
  options.alpha = GENERATE(1.0, 3.8);
  options.cells = GENERATE(1, 2, 5);
  long double worst = 0.0L;
  for (const auto& curve : phase_portrait(options)) {
    for (const auto& p : curve.points) {
      const auto [error, bound] = level_error(p, curve.separatrix_excess, options.alpha);
      INFO(to_string(curve.kind) << " E = " << curve.separatrix_excess << " at " << p.angle << ", "
                                 << p.velocity);
      REQUIRE(error <= bound + 1e-300L);
      if (bound > 0.0L) worst = std::max(worst, error / bound);
    }
  }
  INFO("largest error/bound " << worst);
  CHECK(worst > 0.05L);
}

TEST_CASE("turning points keep all digits next to the separatrix and next to rest",
          "[free_pendulum][portrait]") {
  const double amplitude = GENERATE(1e-150, 1e-8, 1.0, 3.0, 3.14159265358, 3.1415926535897927);
  const auto curves = phase_portrait({.cells = 1, .amplitudes = {amplitude}, .excesses = {}});
  const auto& curve = first_of(curves, CurveKind::libration);
  const auto highest = std::max_element(curve.points.begin(), curve.points.end(),
                                        [](const auto& a, const auto& b) { return a.angle < b.angle; });
  CHECK(std::abs(highest->angle - amplitude) <= 2.0 * kUlp * amplitude);
  CHECK(highest->velocity == 0.0);
  CHECK(std::abs(curve.points.front().velocity - 2.0 * std::sin(amplitude / 2.0)) <= 2.0 * kUlp * amplitude);
}

TEST_CASE("points follow each other at equal arc length", "[free_pendulum][portrait]") {
  auto options = extreme_levels();
  options.amplitudes = {0.1, 1.0, pi / 2, 3.0, 3.14159};
  options.excesses = {-1.0, -1e-3, 1e-3, 1.0, 50.0};
  options.points = GENERATE(9, 81, 200);
  for (const auto& curve : phase_portrait(options)) {
    if (curve.points.size() < 2) continue;
    std::vector<long double> steps;
    long double total = 0.0L;
    for (std::size_t j = 1; j < curve.points.size(); ++j) {
      steps.push_back(arc_between(curve.points[j - 1], curve.points[j], curve.separatrix_excess));
      total += steps.back();
    }
    const long double mean = total / static_cast<long double>(steps.size());
    // The points are doubles: next to a sharp bend the reference feels their rounding, amplified by 1/k'.
    const bool sharp = std::abs(curve.separatrix_excess) < 1e-2;
    const long double allowed = sharp ? 3e-11L : 1e-14L * std::max(total, 20.0L);
    for (std::size_t j = 0; j < steps.size(); ++j) {
      INFO(to_string(curve.kind) << " E = " << curve.separatrix_excess << ", step " << j << " of "
                                 << steps.size());
      REQUIRE(static_cast<double>(std::abs(steps[j] - mean)) <= static_cast<double>(allowed));
    }
  }
}

TEST_CASE("the length of the separatrix is that of the complete elliptic integral",
          "[free_pendulum][portrait][ratchet]") {
  // Integral of sqrt(1 + cos^2(x/2)) over [0, 2 pi] = 4 sqrt(2) E(1/sqrt 2); chords of n steps fall short by
  // O(1/n^2).
  const double exact = 4.0 * std::numbers::sqrt2 * boost::math::ellint_2(1.0 / std::numbers::sqrt2);
  double before = 0.0;
  for (const int points : {101, 201, 401}) {
    const auto curves = phase_portrait({.cells = 1, .points = points});
    const auto& curve = first_of(curves, CurveKind::separatrix);
    REQUIRE(curve.points.size() == static_cast<std::size_t>(points));
    double length = 0.0;
    for (std::size_t j = 1; j < curve.points.size(); ++j) {
      length += std::hypot(curve.points[j].angle - curve.points[j - 1].angle,
                           curve.points[j].velocity - curve.points[j - 1].velocity);
    }
    const double shortfall = exact - length;
    CHECK(shortfall > 0.0);
    if (before > 0.0)
      check_close("chords of the separatrix: what twice the points leave over 1/4 (relative)",
                  before / shortfall, 4.0, 0.0002);
    before = shortfall;
  }
}

TEST_CASE("curves close, repeat themselves and run with time", "[free_pendulum][portrait]") {
  const int cells = GENERATE(1, 2, 3, 4);
  const auto curves = phase_portrait({.cells = cells, .points = 41});
  const double half = window_half_width(cells);
  for (const auto& curve : curves) {
    for (const auto& p : curve.points) CHECK(std::abs(p.angle) <= half);
    for (std::size_t j = 1; j < curve.points.size(); ++j) {
      const auto &a = curve.points[j - 1], &b = curve.points[j];
      CHECK((b.angle - a.angle) * (a.velocity + b.velocity) > 0.0);
    }
    if (curve.kind == CurveKind::libration) {
      const bool whole = std::abs(curve.points.front().angle) < half;
      CHECK(curve.points.size() == (whole ? 41 : 21));
      CHECK(same(curve.points.front(), curve.points.back()) == whole);
    }
    if (curve.kind == CurveKind::rotation) {
      REQUIRE(curve.points.size() == static_cast<std::size_t>(40 * cells + 1));
      CHECK(std::abs(curve.points.front().angle) == half);
      CHECK(curve.points.back().angle == -curve.points.front().angle);
      for (std::size_t j = 40; j < curve.points.size(); ++j) {
        const auto &p = curve.points[j], &before = curve.points[j - 40];
        CHECK(p.velocity == before.velocity);
        CHECK(std::abs(std::abs(p.angle - before.angle) - 2.0 * pi) <= 2.0 * kUlp * half);
      }
    }
  }
}

TEST_CASE("the window holds every equilibrium, well and branch", "[free_pendulum][portrait]") {
  const int cells = GENERATE(1, 2, 3, 4);
  const auto curves = phase_portrait({.cells = cells, .amplitudes = {1.0, 2.0}, .excesses = {0.5}});
  const auto count = [&](CurveKind kind) {
    return std::count_if(curves.begin(), curves.end(), [=](const auto& c) { return c.kind == kind; });
  };
  CHECK(count(CurveKind::equilibrium) == 2 * cells + 1);
  // Wells about multiples of 2 pi: an even window has half ones at its ends, and half branches.
  const int wells = cells % 2 == 0 ? cells + 1 : cells;
  CHECK(count(CurveKind::libration) == 2 * wells);
  CHECK(count(CurveKind::separatrix) == 2 * wells);
  CHECK(count(CurveKind::rotation) == 2);
  for (const auto& curve : curves) {
    if (curve.kind != CurveKind::equilibrium) continue;
    const double k = std::round(curve.points.at(0).angle / pi);
    CHECK(curve.points[0].angle == k * pi);
    CHECK(curve.separatrix_excess == (std::fmod(k, 2.0) == 0.0 ? -4.0 : 0.0));
  }
}

TEST_CASE("the velocity is scaled by alpha, nothing else", "[free_pendulum][portrait]") {
  const auto one = phase_portrait({.cells = 1}), four = phase_portrait({.alpha = 4.0, .cells = 1});
  REQUIRE(one.size() == four.size());
  for (std::size_t c = 0; c < one.size(); ++c) {
    CHECK(one[c].separatrix_excess == four[c].separatrix_excess);
    for (std::size_t j = 0; j < one[c].points.size(); ++j) {
      CHECK(one[c].points[j].angle == four[c].points[j].angle);
      CHECK(4.0 * one[c].points[j].velocity == four[c].points[j].velocity);
    }
  }
}

TEST_CASE("a portrait refuses what it cannot draw", "[free_pendulum][portrait][misuse]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double alpha : {0.0, -1.0, nan, infinity})
    CHECK_THROWS_AS(phase_portrait({.alpha = alpha}), InvalidInput);
  for (const int cells : {0, -1, 1001}) CHECK_THROWS_AS(phase_portrait({.cells = cells}), InvalidInput);
  CHECK_THROWS_AS(phase_portrait({.points = 8}), InvalidInput);
  for (const double amplitude : {0.0, -1.0, pi, 4.0, nan})
    CHECK_THROWS_AS(phase_portrait({.amplitudes = {amplitude}}), InvalidInput);
  for (const double excess : {-4.0, -5.0, 0.0, nan, infinity})
    CHECK_THROWS_AS(phase_portrait({.excesses = {excess}}), InvalidInput);
}

TEST_CASE("every kind of curve has its own name", "[free_pendulum][portrait]") {
  CHECK(to_string(CurveKind::libration) == "libration");
  CHECK(to_string(CurveKind::rotation) == "rotation");
  CHECK(to_string(CurveKind::separatrix) == "separatrix");
  CHECK(to_string(CurveKind::equilibrium) == "equilibrium");
  CHECK(to_string(CurveKind::section) == "section");
}

}  // namespace strutt::test::phase_portrait_test
