// tongue_curves() of systems.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/chart/tongue_curves.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::system_curves_test {
namespace {

using Eigen::Matrix2d;
using std::numbers::pi;

const std::string kExcitation = "linear.stiffness.harmonics.1.cos.0.0";
const TongueLine kAlong{"linear.period", 1.8, 3.4}, kOver{kExcitation, 0.0, 1.2};

/// docs/examples/coupled_pendulums.toml.
Scene coupled_pendulums() {
  Matrix2d mean, cosine;
  mean << 1.3, -0.3, -0.3, 2.3;
  cosine << 0.4, 0.0, 0.0, 0.0;
  Scene scene;
  scene.linear =
      LinearPeriodicSystem{.period = 3.0, .mass = Matrix2d::Identity(), .damping = {}, .stiffness = {}};
  scene.linear->stiffness.mean = mean;
  scene.linear->stiffness.harmonics = {{1, cosine, Matrix2d::Zero()}};
  return scene;
}

// of the unexcited pendulums: the eigenvalues of `mean`
const double kSlow = std::sqrt(1.8 - std::sqrt(0.34)), kFast = std::sqrt(1.8 + std::sqrt(0.34));

struct Interval {
  double from, to;
};

/// The unstable intervals of the period that verdicts at equal distances show.
std::vector<Interval> scanned(Scene scene, double excitation, double step) {
  MonodromyEngine engine;
  parameter(scene, kExcitation) = excitation;
  std::vector<Interval> found;
  bool inside = false;
  for (double p = kAlong.from; p <= kAlong.to; p += step) {
    parameter(scene, kAlong.parameter) = p;
    const bool unstable =
        analyse(engine, linear_model(scene), {.tolerance = 1e-10}, {.winding = false}).verdict ==
        Verdict::unstable;
    if (unstable && !inside) found.push_back({p, p});
    if (unstable) found.back().to = p;
    inside = unstable;
  }
  return found;
}

/// Where curves meet a value of the second parameter, ascending; by straight lines between their points.
std::vector<double> crossings(const std::vector<TongueCurve>& curves, double over) {
  std::vector<double> found;
  for (const TongueCurve& curve : curves)
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const CurvePoint &a = curve.points[i - 1], &b = curve.points[i];
      if ((a.over <= over) == (b.over <= over)) continue;
      found.push_back(a.along + (b.along - a.along) * (over - a.over) / (b.over - a.over));
    }
  std::ranges::sort(found);
  return found;
}

std::vector<CurvePoint> tips_of(const TongueCurve& curve) {
  std::vector<CurvePoint> tips;
  std::ranges::copy_if(curve.points, std::back_inserter(tips),
                       [](const CurvePoint& p) { return p.kind == CurvePoint::Kind::tip; });
  return tips;
}

}  // namespace

TEST_CASE("curves of a system agree with a dense scan of the verdict", "[chart][tongues][slow]") {
  const Scene scene = coupled_pendulums();
  const double chord = 1e-3, step = 4e-4;
  const auto curves = tongue_curves(scene, kAlong, kOver, {.tolerance = 1e-9, .chord = chord});
  for (const double excitation : {0.03, 0.21, 0.77, 1.13}) {
    const auto intervals = scanned(scene, excitation, step);
    const auto found = crossings(curves, excitation);
    CAPTURE(excitation);
    REQUIRE(found.size() == 2 * intervals.size() - (intervals.back().to > kAlong.to - 2.0 * step ? 1 : 0));
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Interval& interval = intervals[i / 2];
      CAPTURE(i, found[i]);
      CHECK(std::abs(found[i] - (i % 2 == 0 ? interval.from : interval.to)) <
            step + 2.0 * chord * (kAlong.to - kAlong.from));
    }
  }
}

TEST_CASE("tongues of a system begin at the resonances at zero excitation",
          "[chart][tongues][ratchet][slow]") {
  auto curves = tongue_curves(coupled_pendulums(), kAlong, kOver, {.tolerance = 1e-8});
  REQUIRE(curves.size() == 3);  // down one edge, up the other
  std::ranges::sort(curves, {}, [](const TongueCurve& c) { return c.points.front().along; });
  const double resonances[] = {pi / kFast, 2.0 * pi / (kSlow + kFast), pi / kSlow};
  const Mechanism mechanisms[] = {Mechanism::minus_one, Mechanism::complex_pair, Mechanism::minus_one};
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    const auto tips = tips_of(curves[i]);
    REQUIRE(tips.size() == 1);
    CHECK(tips[0].over == 0.0);
    check_close("resonance of a system at rest (relative)", tips[0].along, resonances[i], 8e-16);
    CHECK(curves[i].points.size() < 300);
    for (const CurvePoint& p : curves[i].points) {
      CHECK(p.mechanism == mechanisms[i]);
      CHECK(p.outcome == Outcome::converged);
    }
  }
}

TEST_CASE("thin tongues of higher order are joined to their resonances", "[chart][tongues][ratchet][slow]") {
  const auto curves = tongue_curves(coupled_pendulums(), {"linear.period", 4.6, 7.6}, kOver,
                                    {.tolerance = 1e-8, .chord = 2e-3});
  std::vector<double> found;
  for (const TongueCurve& curve : curves)
    for (const CurvePoint& tip : tips_of(curve))
      if (tip.over == 0.0) found.push_back(tip.along);
  std::ranges::sort(found);
  const double resonances[] = {4.0 * pi / (kSlow + kFast), 2.0 * pi / kSlow, 3.0 * pi / kFast,
                               6.0 * pi / (kSlow + kFast)};
  REQUIRE(found.size() == 4);
  for (std::size_t i = 0; i < 4; ++i)
    check_close("resonance of higher order of a system at rest (relative)", found[i], resonances[i], 8e-16);
}

}  // namespace strutt::test::system_curves_test
