// `strutt stability`: columns, rows and JSON.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test::stability_test {
namespace {

using Words = std::vector<std::string>;
const std::string kHarmonic = "[mathieu]\ndelta = 0.3\nepsilon = 0\n";

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

/// The value in the column of this name.
std::string value(const std::vector<Words>& rows, std::size_t row, const std::string& column) {
  for (std::size_t i = 0; i < rows[0].size(); ++i) {
    if (rows[0][i] == column) return rows.at(row).at(i);
  }
  FAIL("no column " << column);
  return {};
}

}  // namespace

TEST_CASE("the columns of one point of a Hill equation", "[apps][stability]") {
  const Result result = strutt({"stability", "-"}, {.input = kHarmonic});
  CHECK(result.code == 0);
  CHECK(result.err.empty());
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0] == Words{"verdict", "margin", "margin_error", "growth", "growth_per_time", "winding",
                         "discriminant", "m11", "m12", "m21", "m22", "log_scale", "multiplier1_re",
                         "multiplier1_im", "multiplier2_re", "multiplier2_im", "error", "method", "outcome"});
  CHECK(csv_comment(result.out, "units") == ",1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,,");
  // x'' + w^2 x over T = 2 pi: M = [[cos wT, sin(wT)/w], [-w sin wT, cos wT]].
  const double w = std::sqrt(0.3), phase = 2.0 * std::numbers::pi * w;
  const std::vector<std::pair<std::string, double>> expected{{"m11", std::cos(phase)},
                                                             {"m12", std::sin(phase) / w},
                                                             {"m21", -w * std::sin(phase)},
                                                             {"m22", std::cos(phase)},
                                                             {"discriminant", 2.0 * std::cos(phase)},
                                                             {"margin", 1.0 - std::abs(std::cos(phase))},
                                                             {"winding", w},
                                                             {"growth", 0.0},
                                                             {"multiplier1_re", std::cos(phase)},
                                                             {"multiplier1_im", std::abs(std::sin(phase))},
                                                             {"multiplier2_im", -std::abs(std::sin(phase))},
                                                             {"log_scale", 0.0}};
  for (const auto& [column, exact] : expected) {
    INFO(column);
    CHECK(number(value(rows, 1, column)) == Approx(exact).epsilon(0.0).margin(2e-9));
  }
  CHECK(value(rows, 1, "verdict") == "stable");
  CHECK(value(rows, 1, "outcome") == "converged");
  const double error = number(value(rows, 1, "error"));
  CHECK(error >= 1.1e-16);
  CHECK(error <= 1e-9);
}

TEST_CASE("the units of a pendulum are SI", "[apps][stability]") {
  const Result result =
      strutt({"stability", "-"}, {.input = "[pendulum]\nlength = 1\n[support]\nfrequency = 12\n"});
  CHECK(csv_comment(result.out, "units") == ",1,1,1,1/s,1,1,1,s,1/s,1,1,1,1,1,1,1,,");
  const auto rows = csv_rows(result.out);
  CHECK(value(rows, 1, "verdict") == "stable");
}

TEST_CASE("the columns of more than two states", "[apps][stability]") {
  const auto columns_of = [](int degrees) {
    std::string mass, stiffness;
    for (int i = 0; i < degrees; ++i) {
      std::string row, diagonal;
      for (int j = 0; j < degrees; ++j) {
        row += (j > 0 ? "," : "") + std::string(i == j ? "1" : "0");
        diagonal += (j > 0 ? "," : "") + (i == j ? std::to_string(1 + i) : "0");
      }
      mass += (i > 0 ? ",[" : "[") + row + "]";
      stiffness += (i > 0 ? ",[" : "[") + diagonal + "]";
    }
    const Result result =
        strutt({"stability", "-"}, {.input = "[linear]\nperiod = 1\nmass = [" + mass +
                                             "]\nstiffness = { mean = [" + stiffness + "] }\n"});
    CHECK(result.code == 0);
    return csv_rows(result.out);
  };
  const auto four = columns_of(2);
  CHECK(four[0].size() == 7 + 16 + 1 + 8 + 3);
  CHECK(value(four, 1, "winding").empty());
  CHECK(number(value(four, 1, "m44")) == Approx(std::cos(std::sqrt(2.0))).epsilon(1e-9));
  CHECK(number(value(four, 1, "m13")) == Approx(std::sin(1.0)).epsilon(1e-9));
  // Ten states: no matrix, but all multipliers.
  const auto ten = columns_of(5);
  CHECK(ten[0].size() == 7 + 1 + 20 + 3);
  CHECK(ten[0][7] == "log_scale");
  CHECK(std::hypot(number(value(ten, 1, "multiplier10_re")), number(value(ten, 1, "multiplier10_im"))) ==
        Approx(1.0).epsilon(1e-9));
}

TEST_CASE("a row of points is what --set says for one point", "[apps][stability]") {
  const ScratchDirectory directory;
  directory.with("scene.toml", kHarmonic);
  directory.with("in.csv", "mathieu.epsilon,mathieu.delta\n0.5,1\n0.25,0.3\n");
  const Setup here{.directory = directory.path()};
  const Result points = strutt({"stability", "scene.toml", "--points", "in.csv", "-o", "out.csv"}, here);
  CHECK(points.code == 0);
  CHECK(points.out.empty());
  CHECK_THAT(points.err, Catch::Matchers::Contains("2 rows"));
  const std::string written = content_of(directory / "out.csv");
  CHECK(csv_comment(written, "units").starts_with("1,1,,1,"));
  const auto rows = csv_rows(written);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0][0] == "mathieu.epsilon");
  CHECK(rows[1][0] == "0.5");
  CHECK(number(value(rows, 1, "discriminant")) == Approx(2.021314397416841636).epsilon(1e-9));
  CHECK(value(rows, 1, "verdict") == "unstable");

  const Result one =
      strutt({"stability", "scene.toml", "--set", "mathieu.delta=1", "--set", "mathieu.epsilon=0.5"}, here);
  const auto alone = csv_rows(one.out);
  CHECK(Words(rows[1].begin() + 2, rows[1].end()) == alone[1]);
}

TEST_CASE("rows keep their order and bits for any number of threads", "[apps][stability]") {
  const ScratchDirectory directory;
  directory.with("scene.toml", kHarmonic);
  std::string table = "mathieu.delta\n";
  for (int i = 0; i < 300; ++i) table += std::to_string((i * 137 % 300) * 0.01) + "\n";
  directory.with("in.csv", table);
  const auto run = [&](const std::string& threads) {
    return strutt({"stability", "scene.toml", "--points", "in.csv", "--threads", threads, "--quiet",
                   "--tolerance", "1e-6", "--set", "mathieu.epsilon=0.5"},
                  {.environment = {"SOURCE_DATE_EPOCH=1"}, .directory = directory.path()})
        .out;
  };
  const std::string one = run("1");
  CHECK(csv_rows(one).size() == 301);
  CHECK(number(csv_rows(one)[2][0]) == 1.37);
  CHECK(run("2") == one);
  CHECK(run("5") == one);
}

TEST_CASE("points come through standard input and leave through standard output", "[apps][stability]") {
  const ScratchDirectory directory;
  directory.with("scene.toml", kHarmonic);
  const Result result = strutt({"stability", "scene.toml", "--points", "-", "-o", "-", "--quiet"},
                               {.input = "mathieu.delta\n2\n", .directory = directory.path()});
  CHECK(result.code == 0);
  CHECK(csv_rows(result.out).size() == 2);
}

TEST_CASE("JSON has the columns of CSV with the same bits", "[apps][stability]") {
  const auto rows = csv_rows(strutt({"stability", "-"}, {.input = kHarmonic}).out);
  const Result result = strutt({"stability", "-", "--json"}, {.input = kHarmonic});
  CHECK(result.code == 0);
  const auto json = nlohmann::ordered_json::parse(result.out);
  CHECK(json["schema_version"] == 1);
  CHECK_THAT(json["provenance"]["scene"].get<std::string>(), Catch::Matchers::Contains("delta = 0.3"));
  REQUIRE(json["rows"].size() == 1);
  std::size_t i = 0;
  for (const auto& [column, cell] : json["rows"][0].items()) {
    INFO(column);
    REQUIRE(i < rows[0].size());
    CHECK(column == rows[0][i]);
    if (cell.is_number())
      CHECK(cell.get<double>() == number(rows[1][i]));
    else
      CHECK(cell == rows[1][i]);
    ++i;
  }
  CHECK(i == rows[0].size());
}

TEST_CASE("infinite growth of numbers stays finite in files", "[apps][stability]") {
  // growth is 2 pi 1000, exp of it is beyond double: everything is given divided by exp(log_scale).
  const Result result = strutt({"stability", "-"}, {.input = "[mathieu]\ndelta = -1e6\nepsilon = 0\n"});
  CHECK(result.code == 0);
  const auto rows = csv_rows(result.out);
  const double growth = number(value(rows, 1, "growth"));
  CHECK(growth == Approx(2000.0 * std::numbers::pi).epsilon(1e-15));
  const double trace = number(value(rows, 1, "discriminant")),
               log_scale = number(value(rows, 1, "log_scale"));
  CHECK(std::isfinite(trace));
  CHECK(std::log(trace) + log_scale == Approx(growth).epsilon(1e-15));
  CHECK(value(rows, 1, "margin") == "-1e+300");
  CHECK(value(rows, 1, "margin_error") == "0");
}

TEST_CASE("the plan of a table tells its size and its cost", "[apps][stability]") {
  std::string table = "mathieu.delta\n";
  for (int i = 0; i < 2000; ++i) table += std::to_string(i) + "\n";
  const ScratchDirectory directory;
  directory.with("points.csv", table);
  const auto plan = [&](const std::string& method) {
    const Result result = strutt(
        {"stability", "-", "--points", "points.csv", "--threads", "1", "--method", method, "--dry-run"},
        {.input = "[mathieu]\n", .directory = directory.path()});
    CHECK(result.code == 0);
    CHECK_THAT(result.out, Catch::Matchers::Contains("# points: 2000\n"));
    const auto begin = result.out.find("# expected time: ");
    REQUIRE(begin != std::string::npos);
    return std::stod(result.out.substr(begin + 17));
  };
  CHECK(plan("auto") > 0.0);
  CHECK(plan("cvode") > 5.0 * plan("auto"));
}

TEST_CASE("the flag beats the tolerance of the scene, which beats the default", "[apps][stability]") {
  const auto method = std::vector<std::string>{"stability", "-", "--method", "arkode"};
  const auto tolerance_in = [&](std::vector<std::string> flags, const std::string& chart) {
    flags.insert(flags.begin(), method.begin(), method.end());
    const Result result = strutt(flags, {.input = "[mathieu]\n" + chart});
    CHECK(result.code == 0);
    const auto begin = result.out.find("# tolerance: ") + 13;
    return result.out.substr(begin, result.out.find('\n', begin) - begin);
  };
  CHECK(tolerance_in({}, "") == "1e-09");
  CHECK(tolerance_in({}, "[chart]\ntolerance = 1e-6\n") == "1e-06");
  CHECK(tolerance_in({"--tolerance", "1e-7"}, "[chart]\ntolerance = 1e-6\n") == "1e-07");
}

TEST_CASE("a tolerance that is not reached is exit code 1 and said in the row", "[apps][stability]") {
  const Result result = strutt({"stability", "-", "--tolerance", "1e-13"},
                               {.input = "[mathieu]\ndelta = 1e4\nepsilon = 1e3\n"});
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 2);
  const double error = number(value(rows, 1, "error"));
  const bool reached = error <= 1e-13;
  CHECK(value(rows, 1, "outcome") == (reached ? "converged" : "tolerance_not_reached"));
  const bool unresolved = value(rows, 1, "verdict") == "unresolved";
  CHECK(result.code == (reached && !unresolved ? 0 : 1));
}

}  // namespace strutt::test::stability_test
