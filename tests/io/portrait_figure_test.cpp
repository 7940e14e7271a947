#include "strutt/io/portrait_figure.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

#include "io/portrait_script.hpp"
#include "io/scratch.hpp"
#include "strutt/base/error.hpp"

namespace strutt::test::portrait_figure_test {

namespace {

using std::numbers::pi;
using test::content_of;
using test::message_of;
using test::ScratchDirectory;

std::string drawn(const std::filesystem::path& path, const std::vector<PhaseCurve>& curves,
                  const PortraitDescription& description) {
  PortraitFigure(path).draw(curves, description);
  return content_of(path);
}

const std::vector<PhaseCurve> kSections{{CurveKind::section, 1.0, {{0.1, 2.0}, {-0.5, 1.0}}},
                                        {CurveKind::section, -3.0, {{0.2, -1.0}}}};

}  // namespace

TEST_CASE("a portrait is drawn as PNG, SVG and PDF", "[io][portrait_figure]") {
  const ScratchDirectory scratch;
  const auto curves = phase_portrait({.cells = 2, .points = 41});
  const PortraitDescription description{.title = "it's $`\\ <&>", .cells = 2};
  CHECK(drawn(scratch / "a.png", curves, description).starts_with("\x89PNG"));
  CHECK(drawn(scratch / "a.pdf", curves, description).starts_with("%PDF"));
  const std::string svg = drawn(scratch / "a.svg", curves, description);
  for (const char* text : {"it's $`\\ &lt;&amp;>", "libration", "rotation", "separatrix", "centre", "saddle",
                           "direction of motion", "\u03C0/2", "\u22122\u03C0", "angular velocity"}) {
    INFO(text);
    CHECK(svg.find(text) != std::string::npos);
  }
  CHECK(scratch.names().size() == 3);
}

TEST_CASE("a portrait of sections has a colour for every start, no field", "[io][portrait_figure]") {
  const ScratchDirectory scratch;
  const PortraitDescription description{.title = "sections", .alpha = 3.0, .cells = 1, .has_units = true};
  const std::string svg = drawn(scratch / "a.svg", kSections, description);
  CHECK(svg.find("[rad/s]") != std::string::npos);
  CHECK(svg.find("separatrix excess") != std::string::npos);
  CHECK(svg.find("direction of motion") == std::string::npos);
  CHECK(arrow_data(kSections, description).empty());
  // The smallest excess comes first, whatever the order of the curves.
  CHECK(portrait_data(kSections, CurveKind::section).starts_with("0.06366198 -1 -3\n\n"));
}

TEST_CASE("the window, the levels and unusual portraits are drawn", "[io][portrait_figure]") {
  const ScratchDirectory scratch;
  for (const int cells : {1, 40}) {
    const auto curves = phase_portrait({.cells = cells, .points = 9, .amplitudes = {}, .excesses = {}});
    CHECK(drawn(scratch / "a.svg", curves, {.title = "bare", .cells = cells}).find("</svg>") !=
          std::string::npos);
  }
  const std::vector<PhaseCurve> rest{{CurveKind::section, -4.0, {{0.0, 0.0}}}};
  CHECK(drawn(scratch / "a.svg", rest, {.title = "rest", .cells = 1}).find("</svg>") != std::string::npos);
}

TEST_CASE("wide numbers on the velocity axis get their room", "[io][portrait_figure]") {
  const auto margin = [](const std::vector<double>& excesses) {
    const auto curves = phase_portrait({.cells = 1, .points = 9, .excesses = excesses});
    const std::string script = portrait_script(curves, {.title = "", .cells = 1}, FigureFormat::svg);
    const std::string words = "set lmargin at screen ";
    return std::stod(script.substr(script.find(words) + words.size()));
  };
  CHECK(margin({}) >= 0.085);
  CHECK(margin({1e300}) > margin({}) + 0.03);  // -1*10^150 against -2
}

TEST_CASE("arrows show where the state moves, all of one length on paper", "[io][portrait_figure]") {
  const double alpha = GENERATE(1.0, 3.8);
  const PortraitDescription description{.title = "", .alpha = alpha, .cells = 2};
  const auto curves = phase_portrait({.alpha = alpha, .cells = 2, .points = 41});
  std::istringstream stream(arrow_data(curves, description));
  double x = 0.0, y = 0.0, dx = 0.0, dy = 0.0, first = 0.0;
  int count = 0;
  while (stream >> x >> y >> dx >> dy) {
    const double angle = pi * (x + dx / 2.0), velocity = y + dy / 2.0;
    const double cross = dx * pi * (-alpha * alpha * std::sin(angle)) - dy * velocity;
    const double along = dx * pi * velocity + dy * (-alpha * alpha * std::sin(angle));
    CHECK(along > 0.0);
    CHECK(std::abs(cross) < 2e-3 * along + 1e-4);
    // The plot area is 1424 x 841.5 pixels for 4 pi by twice 1.06 of the largest velocity.
    const double largest = 1.06 * alpha * std::sqrt(2.25 + 4.0);
    const double length = std::hypot(dx / 4.0 * 1424.0, dy / (2.0 * largest) * 841.5);
    if (first == 0.0) first = length;
    CHECK(length == Approx(first).epsilon(1e-3));
    ++count;
  }
  CHECK(count > 600);
}

TEST_CASE("what is wrong with a portrait's figure is said before anything is drawn",
          "[io][portrait_figure][misuse]") {
  const ScratchDirectory scratch;
  CHECK(message_of<InvalidInput>([&] { PortraitFigure(scratch / "a.gif"); }).find(".png, .svg or .pdf") !=
        std::string::npos);
  CHECK_THROWS_AS(PortraitFigure(scratch / "none/a.png"), InputOutputError);
  CHECK(scratch.names().empty());
}

}  // namespace strutt::test::portrait_figure_test
