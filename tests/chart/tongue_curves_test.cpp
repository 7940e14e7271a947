#include "strutt/chart/tongue_curves.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::tongue_curves_test {
namespace {

using std::numbers::pi;

Scene mathieu_scene(double damping) {
  Scene scene;
  scene.mathieu = MathieuTable{.delta = 1.0, .epsilon = 0.5, .damping = damping};
  return scene;
}

std::vector<CurvePoint> points_of(const std::vector<TongueCurve>& curves, int order) {
  std::vector<CurvePoint> points;
  for (const TongueCurve& curve : curves)
    if (curve.order == order) points.insert(points.end(), curve.points.begin(), curve.points.end());
  return points;
}

std::vector<CurvePoint> tips_of(const std::vector<TongueCurve>& curves) {
  std::vector<CurvePoint> tips;
  for (const TongueCurve& curve : curves)
    std::ranges::copy_if(curve.points, std::back_inserter(tips),
                         [](const CurvePoint& p) { return p.kind == CurvePoint::Kind::tip; });
  return tips;
}

Margin margin_at(double delta, double epsilon, double damping) {
  static MonodromyEngine engine;
  const auto s = analyse(engine, mathieu_delta_epsilon(delta, epsilon, damping), {.tolerance = 1e-13});
  return {s.margin, s.margin_error};
}

}  // namespace

TEST_CASE("curves of Mathieu's tongues are the characteristic values", "[chart][tongues][ratchet]") {
  const auto curves =
      tongue_curves(mathieu_scene(0.0), {"mathieu.delta", -6.0, 9.5}, {"mathieu.epsilon", 0.1, 5.0});
  for (int n = 0; n <= 5; ++n) {
    const auto points = points_of(curves, n);
    CHECK(points.size() >= 16);
    for (const CurvePoint& p : points) {
      const auto pair = characteristic_values(n, n, 2.0 * p.over).front();
      const double expected = 0.25 * (p.kind == CurvePoint::Kind::upper ? pair.a.value : pair.b->value);
      check_within("curve of a tongue of Mathieu's equation over max(1; |delta|)",
                   std::abs(p.along - expected) / std::max(1.0, std::abs(expected)), 8e-16);
    }
  }
  CHECK(std::ranges::count_if(curves, [](const auto& c) { return c.order == 3; }) == 2);
  CHECK(tips_of(curves).empty());
}

TEST_CASE("between its points a curve is as straight as was asked for", "[chart][tongues][slow]") {
  for (const double chord : {1e-2, 1e-4}) {
    const TongueLine along{"mathieu.delta", -1.0, 5.0}, over{"mathieu.epsilon", 0.0, 5.0};
    const auto curves = tongue_curves(mathieu_scene(0.1), along, over, {.chord = chord});
    CHECK(curves.size() >= 4);
    for (const TongueCurve& curve : curves)
      for (std::size_t i = 1; i < curve.points.size(); ++i) {
        const CurvePoint &p = curve.points[i - 1], &q = curve.points[i];
        const double u = (q.along - p.along) / 6.0, v = (q.over - p.over) / 5.0, length = std::hypot(u, v);
        if (std::abs(v) < 0.3 * length) continue;
        Scene scene = mathieu_scene(0.1);
        parameter(scene, "mathieu.epsilon") = 0.5 * (p.over + q.over);
        double nearest = HUGE_VAL;
        for (const TongueEdge& edge : tongues(scene, along, {.count = curve.order + 1}))
          if (edge.order == curve.order)
            nearest = std::min(nearest, std::abs(edge.position - 0.5 * (p.along + q.along)) / 6.0);
        CAPTURE(chord, curve.order, p.along, p.over, q.along, q.over);
        CHECK(nearest * std::abs(v) / length <= 1.1 * chord);
      }
  }
}

TEST_CASE("tips of damped tongues are their least excitation", "[chart][tongues][ratchet][slow]") {
  const double c = 0.05;
  const auto curves =
      tongue_curves(mathieu_scene(c), {"mathieu.delta", -0.5, 5.0}, {"mathieu.epsilon", 0.0, 5.0});
  const auto tips = tips_of(curves);
  REQUIRE(tips.size() >= 3);
  // n = 1: epsilon = c, n = 2: epsilon^2/2 = 2 c, each to lowest order
  check_close("excitation at the tip of damped tongue 1 against first order (relative)", tips[0].over, c,
              0.0015);
  check_close("place of the tip of damped tongue 1 against first order (relative)", tips[0].along, 0.25,
              0.004);
  check_close("excitation at the tip of damped tongue 2 against second order (relative)", tips[1].over,
              std::sqrt(4.0 * c), 0.08);
  for (const CurvePoint& tip : tips) {
    check_within("bound of a tip of a damped tongue", tip.error, 3e-13);
    CHECK(tip.outcome == Outcome::converged);
    // no instability below it, near it; instability above it
    double below = HUGE_VAL, above = HUGE_VAL;
    for (int i = -100; i <= 100; ++i) {
      const double delta = tip.along + 1e-6 * i;
      below = std::min(below, margin_at(delta, tip.over * (1.0 - 1e-9), c).value);
      above = std::min(above, margin_at(delta, tip.over * (1.0 + 1e-9), c).value);
    }
    CHECK(below > 0.0);
    CHECK(above < 0.0);
  }
  // one curve down one side and up the other
  const auto first = std::ranges::find(curves, 1, &TongueCurve::order);
  REQUIRE(first != curves.end());
  CHECK(std::ranges::count(curves, 1, &TongueCurve::order) == 1);
  CHECK(first->points.front().kind != first->points.back().kind);
  bool passed = false;
  for (std::size_t i = 1; i < first->points.size(); ++i) {
    passed = passed || first->points[i - 1].kind == CurvePoint::Kind::tip;
    CHECK((first->points[i].over > first->points[i - 1].over) == passed);
  }
}

TEST_CASE("without damping a tongue begins with a tip where nothing is excited",
          "[chart][tongues][ratchet]") {
  const auto check = [](const Scene& scene, const TongueLine& along, const TongueLine& over, double rest,
                        const auto& resonance) {
    const auto curves = tongue_curves(scene, along, over);
    for (int n = 1; n <= 3; ++n) {
      CAPTURE(over.parameter, over.from, n);
      REQUIRE(std::ranges::count(curves, n, &TongueCurve::order) == 1);  // down one edge and up the other
      const auto& points = std::ranges::find(curves, n, &TongueCurve::order)->points;
      const auto tips = tips_of({{n, points}});
      REQUIRE(tips.size() == 1);
      CHECK(tips[0].over == rest);
      check_within("tip of a tongue at rest over max(1; its place)",
                   std::abs(tips[0].along - resonance(n)) / std::max(1.0, resonance(n)), 6e-16);
      check_within("bound of a tip of a tongue at rest", tips[0].error, 4e-15);
      CHECK(tips[0].outcome == Outcome::converged);
      CHECK(points.front().kind != points.back().kind);
      CHECK(std::ranges::count(points, rest, &CurvePoint::over) == 1);
    }
  };
  const auto square_of_half = [](int n) { return 0.25 * n * n; };
  const TongueLine delta{"mathieu.delta", -1.0, 2.9};
  check(mathieu_scene(0.0), delta, {"mathieu.epsilon", 0.0, 0.5}, 0.0, square_of_half);
  check(mathieu_scene(0.0), delta, {"mathieu.epsilon", -0.5, 0.0}, 0.0, square_of_half);
  Scene meissner;
  meissner.hill = HillTable{.waveform = Waveform::square, .period = 2.0 * pi};
  check(meissner, {"hill.mean", -1.0, 2.9}, {"hill.amplitude", 0.0, 0.5}, 0.0, square_of_half);
  Scene rod;
  rod.pendulum = PendulumTable{.length = 1.0};
  rod.support = SupportTable{.frequency = 12.0};
  const double alpha = std::sqrt(1.5 * 9.81);
  check(rod, {"support.frequency", 2.3, 9.0}, {"support.amplitude", 0.0, 0.05}, 0.0,
        [=](int n) { return 2.0 * alpha / n; });
  // damping closes the tongue before, and without a line at rest there is no tip
  for (const CurvePoint& tip :
       tips_of(tongue_curves(mathieu_scene(0.02), delta, {"mathieu.epsilon", 0.0, 0.5})))
    CHECK(tip.over > 0.0);
  CHECK(tips_of(tongue_curves(mathieu_scene(0.0), delta, {"mathieu.epsilon", -0.25, 0.5})).empty());
}

TEST_CASE("curves turn back wherever the second parameter does", "[chart][tongues][ratchet][slow]") {
  // the upper edge of tongue 2, a_2(2 epsilon)/4, has a maximum
  const auto curves =
      tongue_curves(mathieu_scene(0.0), {"mathieu.epsilon", 0.1, 8.0}, {"mathieu.delta", 0.5, 3.0});
  double most = 0.0, where = 0.0;
  for (int i = 0; i <= 80'000; ++i) {
    const double epsilon = 1e-4 * i, a = 0.25 * characteristic_values(2, 2, 2.0 * epsilon).front().a.value;
    if (a > most) most = a, where = epsilon;
  }
  bool found = false;
  for (const CurvePoint& tip : tips_of(curves)) {
    if (std::abs(tip.over - most) > 1e-6) continue;
    found = true;
    check_close("turning point of an edge of tongue 2 (relative)", tip.over, most, 8e-11);
    check_close("excitation at the turning point of an edge of tongue 2 (relative)", tip.along, where, 2e-5);
  }
  CHECK(found);
}

TEST_CASE("curves of systems carry their mechanism", "[chart][tongues]") {
  Scene scene;
  LinearPeriodicSystem system{.mass = Eigen::Matrix2d::Identity(), .damping = {}, .stiffness = {}};
  Eigen::Matrix2d mean, cosine;
  mean << 1.0, 0.0, 0.0, 2.0;
  cosine << 0.0, 0.2, 0.2, 0.0;
  system.stiffness.mean = mean;
  system.stiffness.harmonics = {{1, cosine, Eigen::Matrix2d::Zero()}};
  system.damping.mean = 0.02 * system.mass;
  scene.linear = system;
  const double at = 2.0 * pi / (1.0 + std::sqrt(2.0));
  // damping c M closes the combination resonance at the width c in frequency over sqrt(b12 b21/(w1 w2))
  const auto curves = tongue_curves(scene, {"linear.period", at - 0.3, at + 0.3},
                                    {"linear.damping.mean.0.0", 0.01, 0.03}, {.tolerance = 1e-6});
  for (const TongueCurve& curve : curves)
    for (const CurvePoint& p : curve.points) CHECK(p.mechanism == Mechanism::complex_pair);
  CHECK_FALSE(curves.empty());
  CHECK(curves.front().order == kNoOrder);
}

TEST_CASE("what damping does not change is computed once for all lines", "[chart][tongues]") {
  // a triangle in 32 values, with 16 harmonics
  Scene scene;
  scene.pendulum.emplace();
  scene.pendulum->length = 1.0;
  scene.support.emplace();
  scene.support->frequency = 12.0;
  scene.support->waveform = Waveform::samples;
  for (int i = 0; i < 32; ++i) scene.support->samples.push_back(0.05 * (1.0 - std::abs(i / 8.0 - 2.0)));
  const TongueLine along{"support.frequency", 2.2, 16.0}, over{"pendulum.damping", 0.0, 0.5};
  CurveOptions options{.tolerance = 1e-9, .chord = 2e-3, .resolution = 1e-5, .max_evaluations = 6000};
  const auto curves = tongue_curves(scene, along, over, options);
  CHECK(points_of(curves, 1).size() > 20);
  CHECK(tips_of(curves).size() >= 1);
  options.max_evaluations = 500;
  CHECK_THROWS_AS(tongue_curves(scene, along, over, options), NumericalFailure);
}

TEST_CASE("a curve reaches the corner where both edges of a tongue meet at no excitation",
          "[chart][tongues]") {
  // along epsilon the edges of tongue 2 are square roots of |delta - 1|, about delta = 1
  constexpr double kChord = 2e-3;
  const auto curves = tongue_curves(mathieu_scene(0.0), {"mathieu.epsilon", 0.0, 6.0},
                                    {"mathieu.delta", -1.0, 5.0}, {.chord = kChord, .count = 5});
  for (const int n : {1, 2, 3, 4}) {
    const auto points = points_of(curves, n);
    REQUIRE(!points.empty());
    CAPTURE(n);
    CHECK(std::ranges::min(points, {}, &CurvePoint::along).along <= 2.0 * kChord * 6.0);
  }
}

TEST_CASE("in a logarithmic window chords are as close to the curve as there", "[chart][tongues]") {
  constexpr double kChord = 2e-3;
  const auto curves =
      tongue_curves(mathieu_scene(0.0), {"mathieu.delta", 0.1, 50.0}, {"mathieu.epsilon", 0.1, 30.0},
                    {.chord = kChord, .log_along = true, .log_over = true, .count = 4});
  int chords = 0;
  for (const TongueCurve& curve : curves) {
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const CurvePoint &a = curve.points[i], &b = curve.points[i + 1];
      if (a.kind != b.kind) continue;
      const auto pair =
          characteristic_values(curve.order, curve.order, 2.0 * std::sqrt(a.over * b.over)).front();
      const double edge = 0.25 * (a.kind == CurvePoint::Kind::upper ? pair.a.value : pair.b->value);
      const double x = std::log(b.along / a.along) / std::log(500.0),
                   y = std::log(b.over / a.over) / std::log(300.0);
      const double u = std::log(edge / a.along) / std::log(500.0);
      CAPTURE(curve.order, a.along, a.over);
      CHECK(std::abs(u * y - 0.5 * y * x) <= 2.0 * kChord * std::hypot(x, y));
      ++chords;
    }
  }
  CHECK(chords > 100);
}

TEST_CASE("tongue_curves refuses what makes no window", "[chart][tongues]") {
  const Scene scene = mathieu_scene(0.0);
  const TongueLine along{"mathieu.delta", 0.0, 1.0}, over{"mathieu.epsilon", 0.0, 1.0};
  CHECK_THROWS_AS(tongue_curves(scene, along, along), InvalidInput);
  CHECK_THROWS_AS(tongue_curves(scene, along, {"mathieu.epsilon", 1.0, 0.0}), InvalidInput);
  CHECK_THROWS_AS(tongue_curves(scene, along, over, {.chord = 1e-7}), InvalidInput);
  CHECK_THROWS_AS(tongue_curves(scene, along, over, {.tolerance = 1.0}), InvalidInput);
  CHECK_THROWS_AS(tongue_curves(scene, along, over, {.slices = 0}), InvalidInput);
  CHECK_THROWS_AS(tongue_curves(scene, along, over, {.log_over = true}), InvalidInput);
  CHECK_THROWS_AS(tongue_curves(scene, along, over, {.max_evaluations = 0}), InvalidInput);
  CHECK_THROWS_AS(tongue_curves(scene, along, {"mathieu.damping", -1.0, 0.0}), InvalidInput);
}

}  // namespace strutt::test::tongue_curves_test
