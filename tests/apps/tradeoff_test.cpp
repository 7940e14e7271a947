// The subcommand `tradeoff`, end to end. No test looks at the times.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test::tradeoff_test {

namespace {

using test::content_of;
using test::csv_comment;
using test::csv_rows;
using test::ScratchDirectory;
using test::Setup;

constexpr const char* kMathieu = "[mathieu]\ndelta = 1.0\nepsilon = 0.5\n";
constexpr const char* kChart =
    "[mathieu]\ndelta = 1.0\n[chart]\nx = { parameter = \"mathieu.delta\", from = 0.0, to = 2.0, points = 3 "
    "}\n"
    "y = { parameter = \"mathieu.epsilon\", from = 0.0, to = 1.0, points = 3 }\n";

test::Result tradeoff(const std::string& scene, std::vector<std::string> flags) {
  std::vector<std::string> arguments{"tradeoff", "-"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  return test::strutt(arguments, {.input = scene});
}

double number(const std::string& text) { return std::stod(text); }

}  // namespace

TEST_CASE("tradeoff writes the columns of docs/files.md", "[apps][tradeoff]") {
  const auto done = tradeoff(kMathieu, {"--tolerance", "1e-6", "--quiet"});
  CHECK(done.code == 0);
  CHECK(done.err.empty());
  CHECK(csv_comment(done.out, "command") == "strutt tradeoff - --tolerance 1e-6");
  CHECK(csv_comment(done.out, "model") == "Mathieu's equation (delta, epsilon)");
  CHECK(csv_comment(done.out, "units") == ",1,,1,1,1,1,1,1,1/s,1,1,1,1,1");
  const auto rows = csv_rows(done.out);
  REQUIRE(rows.size() == 5);
  CHECK(rows[0] == std::vector<std::string>{"method", "tolerance", "used", "points", "converged", "exceeded",
                                            "error", "true_error", "median_true_error", "points_per_second",
                                            "spread", "steps", "right_hand_sides",
                                            "estimate_right_hand_sides", "pareto"});
  std::set<std::string> methods;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& row = rows[i];
    methods.insert(row[0]);
    CHECK(row[1] == "1e-06");
    CHECK((row[3] == "1" && row[4] == "1" && row[5] == "0"));
    CHECK(number(row[7]) <= number(row[6]));
    CHECK(number(row[6]) <= 1e-6);
    CHECK(number(row[9]) > 0.0);
  }
  CHECK(methods == std::set<std::string>{"auto", "propagator", "arkode", "cvode"});
  CHECK((rows[1][0] == "auto" && rows[1][2] == "propagator"));
}

TEST_CASE("tradeoff takes its points from the box of the chart", "[apps][tradeoff]") {
  const auto points = [](std::vector<std::string> flags) {
    flags.insert(flags.end(), {"--method", "propagator", "--tolerance", "1e-3", "--quiet"});
    const auto done = tradeoff(kChart, flags);
    CHECK(done.code == 0);
    return csv_rows(done.out).at(1).at(3);
  };
  CHECK(points({}) == "64");
  CHECK(points({"--samples", "7"}) == "7");
  CHECK(points({"--samples", "0"}) == "1");
  CHECK(points({"--set", "mathieu.damping=0.1", "--samples", "2"}) == "2");
}

TEST_CASE("tradeoff writes JSON and a figure", "[apps][tradeoff]") {
  const ScratchDirectory scratch;
  const auto done = tradeoff(kMathieu, {"--json", "-o", (scratch / "a.json").string(), "--figure",
                                        (scratch / "a.svg").string(), "--method", "arkode", "--quiet"});
  CHECK(done.code == 0);
  CHECK(done.out.empty());
  const auto document = nlohmann::json::parse(content_of(scratch / "a.json"));
  CHECK(document["schema_version"] == 1);
  REQUIRE(document["rows"].size() == 12);
  CHECK(document["rows"][0]["method"] == "arkode");
  CHECK(document["rows"][0]["tolerance"] == 0.01);
  CHECK(document["rows"][11]["tolerance"] == 1e-13);
  const std::string svg = content_of(scratch / "a.svg");
  CHECK(svg.find("mathieu.delta = 1, mathieu.epsilon = 0.5, mathieu.damping = 0") != std::string::npos);
  CHECK(svg.find("arkode") != std::string::npos);
}

TEST_CASE("tradeoff says what it would do", "[apps][tradeoff]") {
  const auto done = tradeoff(kChart, {"--dry-run"});
  CHECK(done.code == 0);
  CHECK(done.out.find(
            "# points: 64\n# methods: auto surrogate propagator arkode cvode\n# tolerances: 0.01 0.001") !=
        std::string::npos);
  CHECK(done.out.find("[mathieu]") != std::string::npos);
}

TEST_CASE("tradeoff refuses what it cannot measure", "[apps][tradeoff][misuse]") {
  const auto refused = [](const std::string& scene, const std::vector<std::string>& flags,
                          const std::string& why) {
    const auto done = tradeoff(scene, flags);
    INFO(done.err);
    CHECK(done.code == 2);
    CHECK(done.out.empty());
    CHECK(done.err.find(why) != std::string::npos);
  };
  refused(kMathieu, {"--samples", "5"}, "[chart]");
  refused(kChart, {"--samples", "-1"}, "--samples");
  refused(kMathieu, {"--method", "exact"}, "--method exact");
  refused(kMathieu, {"--method", "fourier"},
          "available are auto, surrogate, propagator, cvode, arkode, exact");
  refused(kMathieu, {"--tolerance", "1e-14"}, "--tolerance");
  refused(kMathieu, {"-o", "a.csv", "--figure", "a.csv"}, "the same file");
  refused(kMathieu, {"-o", "a.npy"}, "CSV");
  refused(kMathieu, {"--figure", "a.gif"}, ".png, .svg or .pdf");
  CHECK(tradeoff("[mathieu]\ndelta = x\n", {}).code == 3);
}

}  // namespace strutt::test::tradeoff_test
