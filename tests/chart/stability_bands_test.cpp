#include "strutt/chart/stability_bands.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/base/error.hpp"
#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"
#include "support/scenes.hpp"

namespace strutt::test::stability_bands_test {
namespace {

Verdict verdict_at(Scene scene, const std::string& path, double value) {
  parameter(scene, path) = value;
  static MonodromyEngine engine;
  return analyse(engine, linear_model(scene), {.tolerance = 1e-13}).verdict;
}

/// Where a factor u1, u2, u1' or u2' of the half period, by the propagator, is zero: an edge of stability.
double factor_zero(Scene scene, const std::string& path, int row, int column, double low, double high) {
  MonodromyEngine engine;
  const auto factor = [&](double value) {
    parameter(scene, path) = value;
    const auto monodromy = engine.compute(std::get<HillEquation>(linear_model(scene)),
                                          {.tolerance = 1e-13, .method = Method::propagator});
    return monodromy.half->value.entry(row, column);
  };
  std::uintmax_t steps = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(factor, low, high,
                                                        boost::math::tools::eps_tolerance<double>(52), steps);
  return 0.5 * (a + b);
}

}  // namespace

TEST_CASE(
    "Kapitza's threshold of the rod is the same by Fourier edges and by the zeros of half-period factors",
    "[chart][bands][kapitza][ratchet]") {
  // epsilon = 3 r0/(2 l) = 0.075 whatever the frequency; stable above the frequency at which -delta = -a_0(2
  // epsilon)/4
  const Scene scene = rod(Equilibrium::inverted, 0.05, 100.0);
  const auto bands = stability_bands(scene, {"support.frequency", 10.0, 1e4});
  REQUIRE(bands.size() == 2);
  CHECK(bands[0].verdict == Verdict::unstable);
  CHECK(bands[0].tongue == 0);
  CHECK(bands[1].verdict == Verdict::stable);
  CHECK(bands[1].to == 1e4);
  CHECK(bands[1].method == Method::fourier);
  const double threshold = bands[1].from;
  check_within("bound of Kapitza's threshold (relative)", bands[1].from_error / threshold, 1e-15);
  const double a0 = characteristic_values(0, 0, 0.15).front().a.value;
  check_close("Kapitza's threshold against a characteristic value (relative)", threshold,
              std::sqrt(1.5 * 9.81 / (-a0 / 4.0)), 8e-16);
  const double by_factor = factor_zero(scene, "support.frequency", 1, 0, 60.0, 90.0);
  check_close("end of a band against a zero of a half-period factor (relative)", by_factor, threshold,
              2.5e-14);
  // r0 omega/sqrt(g l): for small amplitudes 2/sqrt 3, less by a term of order epsilon^2
  const double classical = std::sqrt(4.0 * 9.81 / 3.0) / 0.05;
  CHECK(std::abs(threshold / classical - 1.0) < 0.075 * 0.075);
}

TEST_CASE("the amplitudes that hold the inverted rod have a least and a largest, by both routes",
          "[chart][bands][kapitza][ratchet]") {
  const Scene scene = rod(Equilibrium::inverted, 0.05, 120.0);
  const auto bands = stability_bands(scene, {"support.amplitude", 0.0, 0.35});
  REQUIRE(bands.size() == 3);
  CHECK(bands[0].tongue == 0);
  CHECK(bands[1].verdict == Verdict::stable);
  CHECK(bands[2].tongue == 1);
  const double least = factor_zero(scene, "support.amplitude", 1, 0, 0.02, 0.05);
  check_close("end of a band against a zero of a half-period factor (relative)", bands[1].from, least,
              2.5e-14);
  // the upper limit is an edge of tongue 1, D = -2: u1 or u2' is zero
  for (const auto& [row, column] : {std::pair(0, 0), std::pair(1, 1)}) {
    double largest = 0.0;
    try {
      largest = factor_zero(scene, "support.amplitude", row, column, 0.2, 0.35);
    } catch (const std::exception&) {
      continue;  // no change of sign: the other one
    }
    check_close("end of a band against a zero of a half-period factor (relative)", bands[1].to, largest,
                2.5e-14);
  }
  CHECK(bands[1].to == Approx(0.30382577599750).epsilon(1e-12));
}

TEST_CASE("bands follow each other without gap, each with one verdict", "[chart][bands]") {
  Scene square;
  square.hill = HillTable{.waveform = Waveform::square, .period = 6.0, .mean = 0.8, .amplitude = 0.3};
  const std::vector<std::pair<Scene, TongueLine>> cases{
      {rod(Equilibrium::hanging, 0.3, 12.0), {"support.frequency", 2.0, 30.0}},
      {rod(Equilibrium::hanging, 0.3, 12.0, 0.4), {"support.frequency", 2.0, 30.0}},
      {rod(Equilibrium::inverted, 0.1, 60.0, 0.4), {"support.amplitude", 0.0, 0.9}},
      {square, {"hill.mean", -0.5, 8.0}}};
  for (const auto& [scene, line] : cases) {
    CAPTURE(describe(scene));
    const auto bands = stability_bands(scene, line);
    CHECK(bands.size() >= 2);
    CHECK(bands.front().from == line.from);
    CHECK(bands.back().to == line.to);
    for (std::size_t i = 0; i < bands.size(); ++i) {
      if (i > 0) CHECK(bands[i].from == bands[i - 1].to);
      if (i > 0) CHECK(bands[i].verdict != bands[i - 1].verdict);
      CHECK(bands[i].tongue.has_value() == (bands[i].verdict == Verdict::unstable));
      CHECK(bands[i].outcome == Outcome::converged);
      for (int k = 1; k < 20; ++k)
        CHECK(verdict_at(scene, line.parameter, std::lerp(bands[i].from, bands[i].to, k / 20.0)) ==
              bands[i].verdict);
    }
  }
}

TEST_CASE("a line without an edge is one band", "[chart][bands]") {
  const auto stable =
      stability_bands(rod(Equilibrium::hanging, 0.05, 12.0), {"support.frequency", 10.0, 14.0});
  REQUIRE(stable.size() == 1);
  CHECK(stable.front().verdict == Verdict::stable);
  CHECK_FALSE(stable.front().tongue);
  const auto unstable =
      stability_bands(rod(Equilibrium::hanging, 0.05, 12.0), {"support.frequency", 7.4, 7.6});
  REQUIRE(unstable.size() == 1);
  CHECK(unstable.front().verdict == Verdict::unstable);
  CHECK(unstable.front().tongue == 1);
}

TEST_CASE("bands refuses what it cannot answer", "[chart][bands]") {
  const Scene scene = rod(Equilibrium::hanging, 0.05, 12.0);
  CHECK_THROWS_AS(stability_bands(scene, {"support.frequency", 3.0, 2.0}), InvalidInput);
  CHECK_THROWS_AS(stability_bands(scene, {"support.frequency", 0.0, 2.0}), InvalidInput);
  CHECK_THROWS_AS(stability_bands(scene, {"support.frequency", 1.0, HUGE_VAL}), InvalidInput);
  CHECK_THROWS_AS(stability_bands(scene, {"support.frequncy", 1.0, 2.0}), InvalidInput);
  CHECK_THROWS_AS(stability_bands(scene, {"support.frequency", 1.0, 2.0}, {.tolerance = 1.0}), InvalidInput);
  CHECK_THROWS_AS(stability_bands(scene, {"support.frequency", 1.0, 2.0}, {.samples = 1}), InvalidInput);
}

}  // namespace strutt::test::stability_bands_test
