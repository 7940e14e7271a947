#include "strutt/io/figure.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "io/contour.hpp"
#include "io/figure_axis.hpp"
#include "io/figure_data.hpp"
#include "io/figure_format.hpp"
#include "io/figure_labels.hpp"
#include "io/own_strip.hpp"
#include "io/scratch.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt::test::figure_test {

namespace {

using test::content_of;
using test::message_of;
using test::OwnStrip;
using test::ScratchDirectory;

/// The function x^2 + y^2 on [-1, 1] x [-1, 1].
std::vector<float> paraboloid(std::size_t cells) {
  std::vector<float> values;
  for (std::size_t j = 0; j < cells; ++j) {
    for (std::size_t i = 0; i < cells; ++i) {
      const double x = 2.0 * static_cast<double>(i) / static_cast<double>(cells - 1) - 1.0;
      const double y = 2.0 * static_cast<double>(j) / static_cast<double>(cells - 1) - 1.0;
      values.push_back(static_cast<float>(x * x + y * y));
    }
  }
  return values;
}

double radius(GridPoint p, std::size_t cells) {
  const double half = 0.5 * static_cast<double>(cells - 1);
  return std::hypot(p.column / half - 1.0, p.row / half - 1.0);
}

/// A chart of nx x ny cells, unstable with growth i/nx right of the middle.
ChartDescription description_of(std::size_t nx, std::size_t ny) {
  ChartDescription d;
  d.x = {"mathieu.delta", "", "delta"};
  d.y = {"mathieu.epsilon", "", "it's $`\\ <&>"};  // must come through gnuplot and SVG as it is
  d.request.x = {"mathieu.delta", 0.0, nx == 1 ? 0.0 : 1.0, nx, AxisScale::linear};
  d.request.y = {"mathieu.epsilon", 1e-3, ny == 1 ? 1e-3 : 1e3, ny, AxisScale::logarithmic};
  d.request.layers = ChartFigure::layers();
  d.provenance = {{"model", "a test"}};
  return d;
}

OwnStrip strip_of(std::size_t nx, std::size_t ny) {
  std::vector<double> verdict, growth, margin;
  for (std::size_t k = 0; k < nx * ny; ++k) {
    const double excess = static_cast<double>(k % nx) / static_cast<double>(nx) - 0.5;
    verdict.push_back(static_cast<double>(excess > 0.0 ? Verdict::unstable : Verdict::stable));
    growth.push_back(std::max(excess, 0.0));
    margin.push_back(-excess);
  }
  OwnStrip strip{0, ny, nx};
  for (auto* layer : {&verdict, &growth, &margin}) strip.add(std::move(*layer));
  return strip;
}

std::string drawn(const std::filesystem::path& path, std::size_t nx, std::size_t ny) {
  ChartFigure figure(path, description_of(nx, ny));
  figure.add(strip_of(nx, ny));
  figure.commit();
  return content_of(path);
}

}  // namespace

TEST_CASE("a contour line stays on its level and closes", "[io][figure]") {
  constexpr std::size_t cells = 41;
  const auto lines = contour_lines(paraboloid(cells), cells, 0.25);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].front().column == lines[0].back().column);
  CHECK(lines[0].front().row == lines[0].back().row);
  for (const auto& p : lines[0]) CHECK(std::abs(radius(p, cells) - 0.5) < 2e-3);  // h^2/8 r
  CHECK(length_of(lines[0], 0.05, 0.05) == Approx(M_PI).epsilon(2e-3));
}

TEST_CASE("contour lines avoid NaN, and infinities do no harm", "[io][figure]") {
  const float nan = std::nanf(""), inf = INFINITY;
  CHECK(contour_lines({0, nan, nan, 0}, 2, 0.5).empty());
  const auto lines = contour_lines({-inf, inf, -inf, inf}, 2, 0.5);
  REQUIRE(lines.size() == 1);
  for (const auto& p : lines[0]) CHECK(p.column == 0.5);
  CHECK(contour_lines({0, 1}, 2, 0.5).empty());
  CHECK(contour_lines({0, 1, 0}, 1, 0.5).empty());
}

TEST_CASE("labels cut a gap into their line and move no point of it", "[io][figure]") {
  constexpr std::size_t cells = 41;
  auto lines = contour_lines(paraboloid(cells), cells, 0.5);
  LabelPlacer placer({1000.0, 1000.0, cells, cells}, {});
  placer.place(lines, "0.5");
  REQUIRE(placer.labels().size() == 1);
  REQUIRE(lines.size() == 2);
  for (const auto& line : lines) {
    for (const auto& p : line) CHECK(std::abs(radius(p, cells) - std::sqrt(0.5)) < 2e-3);
  }
  const auto& label = placer.labels().front();
  CHECK(std::hypot(2.0 * label.x - 1.0, 2.0 * label.y - 1.0) == Approx(std::sqrt(0.5)).margin(0.02));
  const double gap = std::hypot(lines[0].back().column - lines[1].front().column,
                                lines[0].back().row - lines[1].front().row);
  CHECK(gap > 1.0);
  CHECK(gap < 5.0);
}

TEST_CASE("ticks stand at round numbers of linear, reversed and logarithmic axes", "[io][figure]") {
  const auto linear = axis_ticks({"p", -1.0, 5.0, 7, AxisScale::linear});
  REQUIRE(linear.size() == 7);
  CHECK(linear[1].label == "0");
  CHECK(linear[1].position == Approx(1.0 / 6.0).epsilon(1e-14));
  const auto reversed = axis_ticks({"p", 5.0, -1.0, 7, AxisScale::linear});
  CHECK(reversed.back().position == Approx(0.0).margin(1e-12));
  for (const auto& tick : axis_ticks({"p", 1e-3, 1e3, 7, AxisScale::logarithmic})) {
    CHECK(tick.position >= -1e-9);
    CHECK(tick.position <= 1.0 + 1e-9);
  }
  CHECK(axis_ticks({"p", 2.0, 2.0, 1, AxisScale::linear}).front().label == "2");
  CHECK(axis_ticks({"p", 1.0, std::nextafter(1.0, 2.0), 2, AxisScale::linear}).size() >= 2);
  CHECK(axis_label({"p", 0, 1, 2}, {"p", "rad/s", "frequency"}) == "frequency [rad/s]");
}

TEST_CASE("a figure is drawn as PNG, SVG and PDF, whatever its shape", "[io][figure]") {
  const ScratchDirectory scratch;
  CHECK(drawn(scratch / "a.png", 20, 10).starts_with("\x89PNG"));
  CHECK(drawn(scratch / "B.PNG", 20, 10).starts_with("\x89PNG"));
  CHECK(drawn(scratch / "a.pdf", 20, 10).starts_with("%PDF"));
  const std::string svg = drawn(scratch / "a.svg", 20, 10);
  CHECK(svg.find("<svg") != std::string::npos);
  for (const char* text :
       {"delta", "it's $`\\ &lt;&amp;>", "stable", "unstable", "edge of stability", "equal growth"}) {
    CHECK(svg.find(text) != std::string::npos);
  }
  CHECK(drawn(scratch / "b.svg", 1, 1).find("</svg>") != std::string::npos);
  CHECK(drawn(scratch / "b.svg", 1, 7).find("</svg>") != std::string::npos);
  CHECK(drawn(scratch / "b.svg", 2500, 3).find("</svg>") != std::string::npos);
  CHECK(scratch.names().size() == 5);
}

TEST_CASE("the copy for a figure does not grow with the chart", "[io][figure]") {
  auto d = description_of(5000, 3000);
  FigureData data(d.request);
  CHECK(data.columns() == FigureData::kMostCells);
  CHECK(data.rows() == FigureData::kMostCells);
}

TEST_CASE("what is wrong with a figure is said before anything is drawn", "[io][figure]") {
  const ScratchDirectory scratch;
  CHECK(message_of<InvalidInput>([&] {
          ChartFigure(scratch / "a.gif", description_of(2, 2));
        }).find(".png, .svg or .pdf") != std::string::npos);
  auto d = description_of(2, 2);
  d.request.layers = {Layer::verdict};
  CHECK(message_of<InvalidInput>([&] { ChartFigure(scratch / "a.png", d); }).find("growth") !=
        std::string::npos);
  CHECK_THROWS_AS(ChartFigure(scratch / "none/a.png", description_of(2, 2)), InputOutputError);
  CHECK(scratch.names().empty());
}

TEST_CASE("the ending of a figure is taken in any case", "[io][figure]") {
  CHECK(figure_format("a.png") == FigureFormat::png);
  CHECK(figure_format("a.PNG") == FigureFormat::png);
  CHECK(figure_format("A.Svg") == FigureFormat::svg);
  CHECK(figure_format("a.b.PDF") == FigureFormat::pdf);
  for (const char* name : {"png", ".png", "a.png.gz", "a.PNGS", "a."})
    CHECK_THROWS_AS(figure_format(name), InvalidInput);
}

TEST_CASE("without gnuplot the message says so and the old picture stays", "[io][figure][F7]") {
  const ScratchDirectory scratch;
  const auto path = scratch.with("a.png", "old");
  const std::string old_path = std::getenv("PATH");
  ::setenv("PATH", scratch.path().c_str(), 1);
  CHECK(message_of<InputOutputError>([&] { drawn(path, 4, 4); }).find("gnuplot is not installed") !=
        std::string::npos);
  ::setenv("PATH", old_path.c_str(), 1);
  CHECK(content_of(path) == "old");
  CHECK(scratch.names().size() == 1);
}

}  // namespace strutt::test::figure_test
