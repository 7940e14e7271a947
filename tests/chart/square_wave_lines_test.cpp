#include <boost/math/tools/toms748_solve.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/chart/stability_bands.hpp"
#include "strutt/chart/stability_margin.hpp"
#include "strutt/chart/tongues.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::square_wave_lines_test {
namespace {

using std::numbers::pi;

constexpr const char* kAmplitude = "hill.amplitude";

/// Meissner's equation in canonical time but for the rounding of the period.
Scene meissner(double mean, double amplitude = 0.5) {
  Scene scene;
  scene.hill =
      HillTable{.waveform = Waveform::square, .period = 2.0 * pi, .mean = mean, .amplitude = amplitude};
  return scene;
}

/// D of x'' + (mean +- A) x = 0, half of the period each, by the product of both propagators.
double discriminant(double mean, double amplitude) {
  const double one = std::sqrt(mean + amplitude), two = std::sqrt(std::abs(mean - amplitude));
  const bool turns = mean > amplitude;
  const double c = turns ? std::cos(pi * two) : std::cosh(pi * two),
               s = turns ? std::sin(pi * two) : std::sinh(pi * two);
  const double ratio = turns ? one / two + two / one : one / two - two / one;
  return 2.0 * std::cos(pi * one) * c - ratio * std::sin(pi * one) * s;
}

/// Where |D| = 2 between two amplitudes.
double edge_between(double mean, double low, double high, double level) {
  std::uintmax_t steps = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(
      [&](double amplitude) { return discriminant(mean, amplitude) - level; }, low, high,
      boost::math::tools::eps_tolerance<double>(52), steps);
  return 0.5 * (a + b);
}

}  // namespace

TEST_CASE("an amplitude and its opposite have the same edges, on a line through both",
          "[chart][tongues][bands][ratchet]") {
  const double first = edge_between(0.3, 0.01, 0.2, -2.0), second = edge_between(0.3, 1.7, 1.8, -2.0),
               third = edge_between(0.3, 1.8, 1.9, 2.0);
  const auto bands = stability_bands(meissner(0.3), {kAmplitude, -2.0, 2.0});
  REQUIRE(bands.size() == 7);
  const std::vector<double> ends{-third, -second, -first, first, second, third};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    check_close("edges of Meissner's equation along the amplitude against its discriminant (relative)",
                bands[i].to, ends[i], 5e-15);
    CHECK(bands[i].to == bands[i + 1].from);
    CHECK(bands[i].verdict == (i % 2 == 0 ? Verdict::unstable : Verdict::stable));
  }
  std::size_t edges = 0;
  for (const TongueEdge& edge : tongues(meissner(0.3), {kAmplitude, -2.0, 2.0})) {
    if (edge.order <= 2) ++edges;
    CHECK(edge.outcome == Outcome::converged);
  }
  CHECK(edges == 6);
  const auto row = stability_margin(meissner(0.3), {kAmplitude}).parameters.front();
  REQUIRE(row.lower_edge);
  check_close("margin of Meissner's equation against its discriminant (relative)", row.distance, first - 0.5,
              1.5e-15);
  CHECK(*row.lower_edge == bands[3].to);
  CHECK(*row.upper_edge == bands[4].to);
}

TEST_CASE("near a resonance the edge towards no excitation is found", "[chart][margin]") {
  for (const double mean : {0.94, 0.9999, 1.0001, 2.2499, 3.999}) {
    CAPTURE(mean);
    const auto row = stability_margin(meissner(mean), {kAmplitude}).parameters.front();
    REQUIRE(row.lower_edge);
    CHECK(*row.lower_edge > 0.0);
    CHECK(row.outcome == Outcome::converged);
    const double beside = 1e-6 * *row.lower_edge + 1e3 * row.error;
    const double level = std::abs(discriminant(mean, *row.lower_edge + beside)) - 2.0,
                 other = std::abs(discriminant(mean, *row.lower_edge - beside)) - 2.0;
    CHECK(level * other < 0.0);
  }
}

TEST_CASE("on a resonance the edges end in the tip, as far as the rounding of the period lets tell",
          "[chart][tongues][bands][margin]") {
  for (const int order : {2, 4}) {
    CAPTURE(order);
    const Scene scene = meissner(0.25 * order * order);
    const auto edges = tongues(scene, {kAmplitude, 0.0, 0.3});
    REQUIRE(edges.size() == 1);
    CHECK(edges[0].order == order);
    CHECK(edges[0].position <= edges[0].error);
    CHECK(edges[0].error < 1e-6);
    CHECK(edges[0].outcome == Outcome::tolerance_not_reached);
    for (const StabilityBand& band : stability_bands(scene, {kAmplitude, -1.0, 1.0})) {
      const bool outer = band.to - band.from > 0.5;
      CHECK(band.verdict == (outer ? Verdict::unstable : Verdict::stable));
      if (!outer) CHECK(std::max(std::abs(band.from), std::abs(band.to)) < 1e-6);
    }
    const StabilityMargin margin = stability_margin(scene, {kAmplitude});
    CHECK(std::abs(margin.parameters.front().distance + 0.5) <= margin.parameters.front().error);
    CHECK(margin.joint.distance == margin.parameters.front().relative_distance);
  }
}

TEST_CASE("all parameters together are never farther from an edge than one, also at a tip",
          "[chart][margin]") {
  Scene scene;
  scene.mathieu = MathieuTable{.delta = 1.0, .epsilon = 0.5};
  const StabilityMargin margin = stability_margin(scene, {"mathieu.epsilon"});
  CHECK(margin.parameters.front().lower_edge == 0.0);
  CHECK(margin.parameters.front().error == 0.0);
  CHECK(margin.joint.distance == -1.0);
  CHECK(margin.joint.edge == std::vector<double>{0.0});
  CHECK(margin.joint.tongue == 2);
}

}  // namespace strutt::test::square_wave_lines_test
