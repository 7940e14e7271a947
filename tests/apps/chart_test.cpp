// `strutt chart`: its files, formats and figures.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test::chart_test {
namespace {

using Words = std::vector<std::string>;
const std::string kAll = "verdict,growth,winding,discriminant,margin,outcome";

/// The middle column of this chart has no equation of motion.
const std::string kFailing =
    "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\nstiffness = { mean = [[1, 0], [0, 2]] }\n"
    "[chart]\nx = { parameter = \"linear.mass.0.0\", from = -1, to = 1, points = 3 }\n"
    "y = { parameter = \"linear.period\", from = 1, to = 2, points = 2 }\n";

Words chart(const std::string& x, const std::string& y, const Words& more = {}) {
  Words words{"chart", "-", "--quiet", "--x", "mathieu.delta=" + x, "--y", "mathieu.epsilon=" + y};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Setup in(const ScratchDirectory& directory) {
  return {.input = "[mathieu]\n", .environment = {"SOURCE_DATE_EPOCH=1"}, .directory = directory.path()};
}

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

double bits_at(const std::string& bytes, std::size_t at) {
  double value = 0.0;
  REQUIRE(at + 8 <= bytes.size());
  std::memcpy(&value, bytes.data() + at, 8);
  return value;
}

}  // namespace

TEST_CASE("a chart on standard output is CSV as documented", "[apps][chart]") {
  const Result result = strutt(chart("-1:1:3", "0:0:1", {"--layers", kAll}), {.input = "[mathieu]\n"});
  CHECK(result.code == 0);
  CHECK(result.err.empty());
  CHECK(csv_comment(result.out, "units") == "1,1,,1,1,1,1,");
  CHECK(csv_comment(result.out, "tolerance") == "1e-09");
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0] == Words{"mathieu.delta", "mathieu.epsilon", "verdict", "growth", "winding", "discriminant",
                         "margin", "outcome"});
  // x'' + delta x over 2 pi: trace 2 cosh(2 pi), 2, 2 and growth 2 pi, 0, 0.
  const double two_pi = 2.0 * std::numbers::pi;
  CHECK(Words{rows[1][0], rows[2][0], rows[3][0]} == Words{"-1", "0", "1"});
  CHECK(rows[1][2] == "unstable");
  CHECK(number(rows[1][3]) == Approx(two_pi).epsilon(1e-13));
  CHECK(number(rows[1][5]) == Approx(2.0 * std::cosh(two_pi)).epsilon(1e-13));
  CHECK(number(rows[1][6]) == Approx(1.0 - std::cosh(two_pi)).epsilon(1e-13));
  CHECK(number(rows[3][4]) == Approx(1.0).epsilon(1e-13));
  CHECK(number(rows[3][5]) == Approx(2.0).epsilon(1e-13));
  for (std::size_t i = 1; i < 4; ++i) CHECK(rows[i][7] == "converged");
}

TEST_CASE("x runs fastest, both ends are exact and ranges may be reversed", "[apps][chart]") {
  const Result result = strutt(chart("2.3:1.1:3", "0.1:0.7:4", {"--layers", "growth", "--tolerance", "1e-6"}),
                               {.input = "[mathieu]\n"});
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 13);
  for (std::size_t j = 0; j < 4; ++j) {
    CHECK(rows[1 + 3 * j][0] == "2.3");
    CHECK(rows[3 + 3 * j][0] == "1.1");
    for (std::size_t i = 0; i < 3; ++i) CHECK(rows[1 + 3 * j + i][1] == rows[1 + 3 * j][1]);
  }
  CHECK(rows[1][1] == "0.1");
  CHECK(rows[12][1] == "0.7");
}

TEST_CASE("flags beat the file, units work in flags", "[apps][chart]") {
  const std::string scene =
      "[pendulum]\nlength = 1\n[support]\nfrequency = 12\namplitude = 0.1\n[chart]\nlayers = [\"growth\"]\n"
      "x = { parameter = \"support.frequency\", from = 1, to = 2, points = 9 }\n"
      "y = { parameter = \"support.amplitude\", from = 0, to = 0.1, points = 9 }\ntolerance = 1e-4\n";
  const Result result = strutt({"chart", "-", "--x", "support.frequency=60 rpm:2 Hz:2", "--y",
                                "support.amplitude=7 cm:7 cm:1", "--tolerance", "1e-5"},
                               {.input = scene});
  CHECK(csv_comment(result.out, "tolerance") == "1e-05");
  CHECK(csv_comment(result.out, "units") == "rad/s,m,1");
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 3);
  CHECK(number(rows[1][0]) == Approx(2.0 * std::numbers::pi).epsilon(1e-15));
  CHECK(number(rows[2][0]) == Approx(4.0 * std::numbers::pi).epsilon(1e-15));
  CHECK(rows[1][1] == "0.07");
}

TEST_CASE("numbers in CSV and JSON read back to the bits of the binary file", "[apps][chart]") {
  const ScratchDirectory directory;
  const Words axes = chart("-1:5:6", "0:6:5", {"--layers", "discriminant", "--tolerance", "1e-6"});
  const auto write = [&](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    CHECK(strutt(words, in(directory)).code == 0);
  };
  write(axes, {"-o", "c.npy"});
  write(axes, {"-o", "c.csv"});
  write(axes, {"-o", "c.json", "--json"});
  const std::string binary = content_of(directory / "c.npy");
  const auto rows = csv_rows(content_of(directory / "c.csv"));
  const auto json = nlohmann::json::parse(content_of(directory / "c.json"));
  CHECK(json["schema_version"] == 1);
  CHECK(json["provenance"]["program"] == "strutt");
  REQUIRE(rows.size() == 31);
  REQUIRE(json["rows"].size() == 30);
  const std::size_t head = binary.size() - 8 * 30;
  for (std::size_t cell = 0; cell < 30; ++cell) {
    const double value = bits_at(binary, head + 8 * cell);
    CHECK(number(rows[cell + 1][2]) == value);
    CHECK(json["rows"][cell]["discriminant"].get<double>() == value);
    CHECK(json["rows"][cell]["mathieu.delta"].get<double>() == number(rows[cell + 1][0]));
  }
}

TEST_CASE("every format has the same bytes for any number of threads", "[apps][chart][extreme][N48]") {
  const ScratchDirectory directory;
  for (const std::string ending : {".csv", ".npy", ".npz", ".h5", ".json"}) {
    std::vector<std::string> contents;
    for (const std::string threads : {"1", "2", "5"}) {
      const std::string name = threads + ending;
      Words words = chart("-1:5:13", "0:6:11",
                          {"--layers", ending == ".npy" ? "margin" : kAll, "--tolerance", "1e-6", "--threads",
                           threads, "-o", name});
      if (ending == ".json") words.emplace_back("--json");
      const Result result = strutt(words, in(directory));
      CHECK(result.code == 0);
      CHECK(result.err.empty());
      contents.push_back(content_of(directory / name));
    }
    INFO(ending);
    CHECK(contents[0].size() > 1000);
    CHECK((contents[1] == contents[0]));  // in parentheses: binary bytes are not printed
    CHECK((contents[2] == contents[0]));
  }
}

TEST_CASE("a chart with cells that fail is done with exit code 1", "[apps][chart]") {
  const Words words{"chart", "-", "--quiet", "--layers", "verdict,growth,outcome"};
  const Result csv = strutt(words, {.input = kFailing});
  CHECK(csv.code == 1);
  const auto rows = csv_rows(csv.out);
  REQUIRE(rows.size() == 7);
  CHECK(rows[2] == Words{"0", "1", "unresolved", "nan", "failed"});
  CHECK(rows[3][2] == "stable");

  Words json_words = words;
  json_words.emplace_back("--json");
  const Result json = strutt(json_words, {.input = kFailing});
  CHECK(json.code == 1);
  const auto cell = nlohmann::json::parse(json.out)["rows"][1];
  CHECK(cell["growth"] == "nan");
  CHECK(cell["verdict"] == "unresolved");
}

TEST_CASE("exit code 1 for an unresolved verdict only where a verdict was asked for", "[apps][chart]") {
  // At delta = 1/4 and epsilon = 0 both multipliers are -1: an integration cannot tell the side.
  const Words point = chart("0.25:0.25:1", "0:0:1", {"--method", "arkode"});
  const auto code = [&](const std::string& layers) {
    Words words = point;
    words.insert(words.end(), {"--layers", layers});
    return strutt(words, {.input = "[mathieu]\n"}).code;
  };
  const Result result = strutt(point, {.input = "[mathieu]\n"});
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 2);
  CHECK(code("verdict") == (rows[1][2] == "unresolved" ? 1 : 0));
  CHECK(code("growth,margin,outcome") == 0);
}

TEST_CASE("endings of data and figures are taken in any case", "[apps][chart][figure]") {
  const ScratchDirectory directory;
  const Result result = strutt({"chart", "-", "--x", "mathieu.delta=0:2:10", "--y", "mathieu.epsilon=0:1:8",
                                "--tolerance", "1e-5", "--figure", "c.PNG", "-o", "c.CSV"},
                               {.input = "[mathieu]\n", .directory = directory.path()});
  INFO(result.err);
  CHECK(result.code <= 1);
  CHECK(content_of(directory / "c.PNG").starts_with("\x89PNG\r\n\x1A\n"));
  CHECK(csv_rows(content_of(directory / "c.CSV")).size() == 81);
}

TEST_CASE("a figure comes as PNG, SVG and PDF", "[apps][chart][figure]") {
  const ScratchDirectory directory;
  const std::string scene = "[pendulum]\nlength = 1\n[support]\nfrequency = 12\n";
  for (const std::string ending : {"png", "svg", "pdf"}) {
    const Result result =
        strutt({"chart", "-", "--x", "support.frequency=2:14:30", "--y", "support.amplitude=0:0.5:20",
                "--tolerance", "1e-5", "--figure", "c." + ending, "-o", ending + ".csv"},
               {.input = scene, .directory = directory.path()});
    INFO(ending << " " << result.err);
    CHECK(result.code == 0);
    CHECK_THAT(result.err,
               Catch::Matchers::Contains("wrote " + ending + ".csv and c." + ending + ": 600 cells"));
    // The layers a figure needs besides do not get into the data.
    CHECK(csv_rows(content_of(directory / (ending + ".csv"))).at(0).size() == 4);
  }
  const std::string png = content_of(directory / "c.png"), svg = content_of(directory / "c.svg"),
                    pdf = content_of(directory / "c.pdf");
  REQUIRE(png.size() > 10'000);
  CHECK(png.starts_with("\x89PNG\r\n\x1A\n"));
  CHECK(png.ends_with(std::string("IEND\xAE\x42\x60\x82")));
  const auto big_endian = [&](std::size_t at) {
    return (static_cast<unsigned char>(png[at + 2]) << 8) + static_cast<unsigned char>(png[at + 3]);
  };
  CHECK(big_endian(16) >= 500);
  CHECK(big_endian(20) >= 400);
  CHECK(svg.size() > 10'000);
  CHECK_THAT(svg, Catch::Matchers::Contains("</svg>") && Catch::Matchers::Contains("support frequency") &&
                      Catch::Matchers::Contains("rad/s") && Catch::Matchers::Contains("unstable"));
  CHECK(pdf.size() > 5000);
  CHECK(pdf.starts_with("%PDF-"));
}

TEST_CASE("every format says by which methods its cells came about", "[apps][chart]") {
  const ScratchDirectory directory;
  // delta = 0 and 1/4 are edges where epsilon = 0, which only the closed form proves
  const Words words = chart("0:0.5:201", "0:1:200", {"--layers", "verdict"});
  for (const std::string ending : {".csv", ".npy", ".npz", ".h5", ".json"}) {
    Words all = words;
    all.insert(all.end(), {"-o", "c" + ending});
    if (ending == ".json") all.emplace_back("--json");
    CHECK(strutt(all, in(directory)).code == 0);
    const std::string text = content_of(directory / (ending == ".npy" ? "c.npy.json" : "c" + ending));
    INFO(ending);
    CHECK((text.find("surrogate 40198, exact 2") != std::string::npos));
    CHECK((text.find("1 box, degrees up to ") != std::string::npos));
  }
  const auto json = nlohmann::json::parse(content_of(directory / "c.json"));
  CHECK(json["done"]["cells by method"] == "surrogate 40198, exact 2");
  CHECK(json["provenance"]["method"] == "surrogate");
  CHECK(csv_comment(content_of(directory / "c.csv"), "method") == "surrogate");
  CHECK(number(csv_comment(content_of(directory / "c.csv"), "largest error")) <= 1e-9);
}

TEST_CASE("the dry run of a chart shows the plan that auto makes", "[apps][chart][plan]") {
  const auto plan = [](const std::string& points, const Words& more) {
    Words words = chart("-1:5:" + points, "0:6:" + points, {"--dry-run"});
    words.insert(words.end(), more.begin(), more.end());
    return strutt(words, {.input = "[mathieu]\n"}).out;
  };
  const std::string big = plan("1000", {}), small = plan("20", {}),
                    arkode = plan("1000", {"--method", "arkode"});
  CHECK_THAT(big, Catch::Matchers::Contains("# method: surrogate\n"));
  CHECK(std::regex_search(big, std::regex("# surrogate: about 1 box, degrees up to [0-9]+, [0-9]+ nodes, "
                                          "100 % of the cells\n")));
  CHECK_THAT(big, Catch::Matchers::Contains("# point by point: propagator, order ") &&
                      Catch::Matchers::Contains(" steps, ") &&
                      Catch::Matchers::Contains("# expected time: ") &&
                      Catch::Matchers::Contains("# memory: "));
  CHECK(plan("1000", {}) == big);
  CHECK_THAT(small, Catch::Matchers::Contains("# method: propagator\n") &&
                        Catch::Matchers::Contains("# surrogate: not used, the chart is small\n"));
  CHECK_THAT(arkode,
             Catch::Matchers::Contains("# method: arkode\n") && !Catch::Matchers::Contains("# surrogate"));
}

TEST_CASE("a chart by surrogate is the one point by point, and what cannot have one says why",
          "[apps][chart]") {
  const ScratchDirectory directory;
  const Words words = chart("-1:5:60", "0.1:6:50", {"--tolerance", "1e-9", "--layers", "verdict"});
  Words by_points = words;
  by_points.insert(by_points.end(), {"--method", "propagator"});
  const Result points = strutt(by_points, in(directory));
  Words interpolated = words;
  interpolated.insert(interpolated.end(), {"--method", "surrogate"});
  const Result surrogate = strutt(interpolated, in(directory));
  CHECK(surrogate.code == 0);
  CHECK(csv_comment(surrogate.out, "method") == "surrogate");
  CHECK(csv_rows(surrogate.out) == csv_rows(points.out));

  interpolated.push_back("--dry-run");
  CHECK_THAT(strutt(interpolated, in(directory)).out,
             Catch::Matchers::Contains("# method: surrogate") &&
                 Catch::Matchers::Contains("# surrogate: about 1 box, degrees up to "));

  const std::string square = "[hill]\nperiod = 1\nwaveform = \"square\"\namplitude = 0.5\n";
  const Result refused = strutt({"chart", "-", "--method", "surrogate", "--x", "hill.mean=0:1:3", "--y",
                                 "hill.period=1:2:3", "--layers", "growth"},
                                {.input = square});
  CHECK(refused.code == 0);
  CHECK_THAT(refused.err, Catch::Matchers::Contains("no surrogate: the coefficient is not smooth"));
  CHECK(csv_comment(refused.out, "method") == "exact");
}

}  // namespace strutt::test::chart_test
