#include "strutt/io/tradeoff_figure.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "io/scratch.hpp"
#include "io/tradeoff_script.hpp"
#include "strutt/base/error.hpp"

namespace strutt::test::tradeoff_figure_test {

namespace {

using test::content_of;
using test::message_of;
using test::ScratchDirectory;

TradeoffRow row(Method method, double tolerance, double true_error, double rate, bool pareto = false) {
  return {.method = method,
          .tolerance = tolerance,
          .used = {method},
          .error = 10.0 * true_error,
          .true_error = true_error,
          .points_per_second = rate,
          .pareto = pareto};
}

Tradeoff sample() {
  return {
      .rows = {row(Method::automatic, 1e-3, 2e-4, 1e6), row(Method::automatic, 1e-6, 2e-8, 5e5),
               row(Method::propagator, 1e-3, 2e-4, 1e6, true), row(Method::propagator, 1e-6, 2e-8, 5e5, true),
               row(Method::arkode, 1e-3, 1e-4, 1e4), row(Method::arkode, 1e-6, 1e-10, 2e3, true)},
      .points = 5};
}

std::string drawn(const std::filesystem::path& path, const Tradeoff& tradeoff,
                  const std::string& title = "a title") {
  TradeoffFigure(path).draw(tradeoff, title);
  return content_of(path);
}

}  // namespace

TEST_CASE("speed and accuracy are drawn as PNG, SVG and PDF", "[io][tradeoff_figure]") {
  const ScratchDirectory scratch;
  CHECK(drawn(scratch / "a.png", sample()).starts_with("\x89PNG"));
  CHECK(drawn(scratch / "a.pdf", sample()).starts_with("%PDF"));
  const std::string svg = drawn(scratch / "a.svg", sample(), "Hill_1's {equation}");
  for (const char* text :
       {"Hill_1's {equation}", "Speed of one thread", "points per second", "largest true error", "propagator",
        "arkode", "auto, at its tolerance", "front of Pareto", "tolerance asked for", "error = tolerance"}) {
    INFO(text);
    CHECK(svg.find(text) != std::string::npos);
  }
  CHECK(svg.find("cvode") == std::string::npos);
  CHECK(scratch.names().size() == 3);
}

TEST_CASE("the data of a figure of speed and accuracy are the rows by method, then the front",
          "[io][tradeoff_figure]") {
  CHECK(tradeoff_data(sample()) ==
        "0.0002 1e+06 0.001 0.002 \"10^{\u22123}\"\n"
        "2e-08 500000 1e-06 2e-07 \"10^{\u22126}\"\n\n\n"
        "0.0002 1e+06 0.001 0.002 \"10^{\u22123}\"\n"
        "2e-08 500000 1e-06 2e-07 \"10^{\u22126}\"\n\n\n"
        "0.0001 10000 0.001 0.001 \"10^{\u22123}\"\n"
        "1e-10 2000 1e-06 1e-09 \"10^{\u22126}\"\n\n\n"
        "1e-10 2000\n2e-08 500000\n0.0002 1e+06\n1 1e+06\n");
}

TEST_CASE("points that lie on each other share a label, and rows without an error are left out",
          "[io][tradeoff_figure]") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  auto failed = row(Method::cvode, 1e-3, inf, 1e3);
  auto unbounded = row(Method::exact, 1e-9, 0.0, 1.1e6);
  unbounded.error = inf;
  const Tradeoff tradeoff{.rows = {row(Method::exact, 1e-3, 0.0, 1e6), row(Method::exact, 1e-4, 0.0, 1e6),
                                   row(Method::exact, 1e-6, 1e-20, 1.2e6), unbounded, failed}};
  CHECK(tradeoff_data(tradeoff) ==
        "1e-17 1e+06 0.001 1e-17 \"10^{\u22123\u2026\u22129}\"\n"
        "1e-17 1e+06 0.0001 1e-17 \"\"\n"
        "1e-17 1.2e+06 1e-06 1e-17 \"\"\n"
        "1e-17 1.1e+06 1e-09 NaN \"\"\n\n\n");
  const ScratchDirectory scratch;
  CHECK(drawn(scratch / "a.svg", tradeoff).find("</svg>") != std::string::npos);
}

TEST_CASE("a single point is drawn", "[io][tradeoff_figure]") {
  const ScratchDirectory scratch;
  const Tradeoff tradeoff{.rows = {row(Method::exact, 1e-9, 0.0, 1e6, true)}};
  CHECK(drawn(scratch / "a.svg", tradeoff).find("</svg>") != std::string::npos);
}

TEST_CASE("what is wrong with a figure of speed and accuracy is said", "[io][tradeoff_figure][misuse]") {
  const ScratchDirectory scratch;
  CHECK(message_of<InvalidInput>([&] { TradeoffFigure(scratch / "a.gif"); }).find(".png, .svg or .pdf") !=
        std::string::npos);
  CHECK_THROWS_AS(TradeoffFigure(scratch / "none/a.png"), InputOutputError);
  CHECK_THROWS_AS(TradeoffFigure(scratch / "a.svg").draw({}, ""), InvalidInput);
  CHECK(scratch.names().empty());
}

}  // namespace strutt::test::tradeoff_figure_test
