#include "strutt/io/period_figure.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/period_script.hpp"
#include "io/scratch.hpp"
#include "strutt/base/error.hpp"

namespace strutt::test::period_figure_test {

namespace {

using test::content_of;
using test::message_of;
using test::ScratchDirectory;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PeriodSample sample(double amplitude) {
  return {amplitude, period_ratio(amplitude), formula_of_amplitude(PeriodMethod::krylov, amplitude),
          formula_of_amplitude(PeriodMethod::krylov_squared, amplitude)};
}

/// From rest to the last double below pi.
std::vector<PeriodSample> samples() {
  std::vector<PeriodSample> result;
  for (int i = 0; i <= 30; ++i) result.push_back(sample(std::numbers::pi * i / 30.0));
  return result;
}

std::string drawn(const std::filesystem::path& path, const std::vector<PeriodSample>& periods) {
  PeriodFigure(path).draw(periods);
  return content_of(path);
}

}  // namespace

TEST_CASE("periods are drawn as PNG, SVG and PDF", "[io][period_figure]") {
  const ScratchDirectory scratch;
  CHECK(drawn(scratch / "a.png", samples()).starts_with("\x89PNG"));
  CHECK(drawn(scratch / "a.pdf", samples()).starts_with("%PDF"));
  const std::string svg = drawn(scratch / "a.svg", samples());
  for (const char* text : {"exact (10)", "(31) and (22)", "Krylov with \u03B3\u00B2", "amplitude A [rad]",
                           "period ratio T/T", "Error of the formulas"}) {
    INFO(text);
    CHECK(svg.find(text) != std::string::npos);
  }
  CHECK(scratch.names().size() == 3);
}

TEST_CASE("periods are drawn in the order of their amplitudes", "[io][period_figure]") {
  const ScratchDirectory scratch;
  auto periods = samples();
  const std::string ordered = drawn(scratch / "a.svg", periods);
  std::reverse(periods.begin(), periods.end());
  CHECK(drawn(scratch / "b.svg", periods) == ordered);
}

TEST_CASE("the data of a figure of periods are the samples", "[io][period_figure]") {
  const std::vector<PeriodSample> periods{{1.0, 1.25, {1.5, 0.2}, {1.125, -0.1}},
                                          {3.0, INFINITY, {kNaN, kNaN}, {2.0, 0.0}}};
  CHECK(period_data(periods) == "1 1.25 1.5 0.2 1.125 -0.1\n3 NaN NaN NaN 2 0\n");
}

TEST_CASE("the axis of errors holds them all, in whole decades", "[io][period_figure]") {
  const auto decades = [](double first, double second) {
    const Decades d = error_decades({{1.0, 1.0, {1.0, first}, {1.0, second}}});
    return std::pair(d.from, d.to);
  };
  CHECK(decades(3e-4, -0.2) == std::pair(-4, 0));
  CHECK(decades(-3e-4, 2.0) == std::pair(-4, 1));
  CHECK(decades(5e-3, kNaN) == std::pair(-3, -2));
  CHECK(decades(0.01, 0.01) == std::pair(-3, -2));  // a single power of ten
  CHECK(decades(1e-200, 1e9) == std::pair(-10, 1));
  CHECK(decades(1e-200, 1e-150) == std::pair(-10, -9));
  CHECK(decades(0.0, kNaN) == std::pair(-1, 0));  // nothing to draw
}

TEST_CASE("unusual periods are drawn", "[io][period_figure]") {
  const ScratchDirectory scratch;
  const auto is_drawn = [&](const std::vector<PeriodSample>& periods) {
    return drawn(scratch / "a.svg", periods).find("</svg>") != std::string::npos;
  };
  CHECK(is_drawn({sample(0.0), sample(1e-300)}));           // no error at all
  CHECK(is_drawn({sample(3.0), sample(3.1)}));              // one formula without meaning
  CHECK(is_drawn({{3.0, 2.57, {kNaN, kNaN}, {kNaN, kNaN}},  // no formula
                  {std::numbers::pi, INFINITY, {kNaN, kNaN}, {kNaN, kNaN}}}));
}

TEST_CASE("what is wrong with a figure of periods is said", "[io][period_figure][misuse]") {
  const ScratchDirectory scratch;
  CHECK(message_of<InvalidInput>([&] { PeriodFigure(scratch / "a.gif"); }).find(".png, .svg or .pdf") !=
        std::string::npos);
  CHECK_THROWS_AS(PeriodFigure(scratch / "none/a.png"), InputOutputError);
  CHECK_THROWS_AS(PeriodFigure(scratch / "a.svg").draw({}), InvalidInput);
  CHECK_THROWS_AS(PeriodFigure(scratch / "a.svg").draw({sample(1.0), sample(1.0)}), InvalidInput);
  CHECK(scratch.names().empty());
}

}  // namespace strutt::test::period_figure_test
