// `strutt period`, and `strutt motion` where the closed form fits.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test::period_test {
namespace {

using Words = std::vector<std::string>;
const std::string kFree = "[pendulum]\nlength = 1\n";

Result period(const Words& more, const Setup& setup = {}) {
  Words words{"period"};
  words.insert(words.end(), more.begin(), more.end());
  return strutt(words, setup);
}

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

/// The only row of a result, which must have succeeded.
Words row_of(const Result& result) {
  INFO(result.err);
  REQUIRE(result.code == 0);
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 2);
  return rows[1];
}

}  // namespace

TEST_CASE("a period has the documented columns and digits", "[apps][period]") {
  const Result result = period({"--amplitude", "1.5707963267948966"});
  CHECK(csv_rows(result.out).at(0) == Words{"amplitude", "period", "ratio", "error", "method", "outcome"});
  CHECK(csv_comment(result.out, "units") == "rad,s,1,1,,");
  const Words row = row_of(result);
  CHECK(number(row[2]) == 1.18034059901609622604533794);
  CHECK(number(row[1]) == Approx(2.0 * std::acos(-1.0) * 1.18034059901609622604533794).epsilon(1e-15));
  CHECK(number(row[3]) <= 3.5e-16);
  CHECK(row[4] == "elliptic");
  CHECK(row[5] == "converged");
  CHECK(row_of(period({"--amplitude", "90 deg"}))[2] == row[2]);
  CHECK(number(row_of(period({"--amplitude", "3.0"}))[2]) == 2.571233949432142049257416);
}

TEST_CASE("the ends of the range of periods", "[apps][period]") {
  CHECK(row_of(period({"--amplitude", "0"}))[2] == "1");
  CHECK(row_of(period({"--separatrix-excess", "-4"}))[2] == "1");
  CHECK(number(row_of(period({"--amplitude", "3.141592653589793"}))[2]) == Approx(24.65).epsilon(1e-4));
  // What is meant for pi is told what it is; pi itself is from_top 0.
  CHECK(period({"--amplitude", "180 deg"}).err.find("below pi") != std::string::npos);
  CHECK(period({"--points", "-"}, {.input = "amplitude\n3.141592653589793\n"}).err.find("from_top 0") !=
        std::string::npos);
  CHECK(period({"--amplitude", "180 deg", "--quiet"}).err.empty());
  CHECK(period({"--from-top", "3.141592653589793"}).err.empty());
  for (const Words& flags : {Words{"--from-top", "0"}, Words{"--separatrix-excess", "0"}}) {
    const Words row = row_of(period(flags));
    CHECK(row[1] == "inf");
    CHECK(row[4] == "separatrix");
  }
  // Excess -E inside is from_top = sqrt(E); a rotation takes half the time next to the separatrix.
  const double inside = number(row_of(period({"--separatrix-excess", "-1e-300"}))[2]);
  CHECK(inside == Approx(number(row_of(period({"--from-top", "1e-150"}))[2])).epsilon(1e-15));
  CHECK(number(row_of(period({"--separatrix-excess", "1e-300"}))[2]) == Approx(0.5 * inside).epsilon(1e-15));
}

TEST_CASE("periods of a file keep their columns and their order", "[apps][period]") {
  const Result result = period({"--points", "-"}, {.input = "alpha,from_top\n2,1e-300\n1,0.1\n"});
  REQUIRE(result.code == 0);
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == Words{"alpha", "from_top", "period", "ratio", "error", "method", "outcome"});
  CHECK(rows[1][0] == "2");
  CHECK(rows[1][1] == "1e-300");
  CHECK(number(rows[1][2]) == Approx(std::acos(-1.0) * number(rows[1][3])).epsilon(1e-15));
  const auto json = nlohmann::json::parse(period({"--amplitude", "1", "--json"}).out);
  CHECK(json.at("rows").at(0).at("method") == "elliptic");
  CHECK(json.at("rows").at(0).at("ratio").get<double>() == Approx(1.0663342455799631).epsilon(1e-15));
}

TEST_CASE("the unit in a header of periods is converted, or refused", "[apps][period]") {
  const auto in_file = [](const char* text) { return period({"--points", "-"}, {.input = text}); };
  const Words row = row_of(in_file("amplitude [deg],alpha [Hz]\n90,1\n"));
  CHECK(number(row[2]) == Approx(1.18034059901609622604533794).epsilon(1e-15));
  CHECK(number(row[3]) == 1.18034059901609622604533794);
  const Result wrong = in_file("amplitude [m]\n1\n");
  CHECK(wrong.code == 3);
  CHECK(wrong.err.find("dimension") != std::string::npos);
}

TEST_CASE("periods beyond the doubles are no silent numbers", "[apps][period]") {
  const Result result =
      period({"--points", "-"}, {.input = "separatrix_excess,alpha\n1e308,1e300\n-3,1e-320\n"});
  CHECK(result.code == 1);
  const auto rows = csv_rows(result.out);
  CHECK(rows.at(1).at(6) == "tolerance_not_reached");
  CHECK(number(rows.at(1).at(4)) >= 1.0);
  CHECK(rows.at(2).at(2) == "inf");
  CHECK(rows.at(2).at(6) == "non_finite");
}

TEST_CASE("a scene gives alpha", "[apps][period]") {
  const Words row = row_of(period({"--amplitude", "1", "--scene", "-"}, {.input = kFree}));
  const double alpha = std::sqrt(1.5 * 9.81);
  CHECK(number(row[1]) == Approx(2.0 * std::acos(-1.0) / alpha * number(row[2])).epsilon(1e-15));
  const Words shorter =
      row_of(period({"--amplitude", "1", "--scene", "-", "--set", "pendulum.length=0.25"}, {.input = kFree}));
  CHECK(number(shorter[1]) == Approx(0.5 * number(row[1])).epsilon(1e-15));
}

TEST_CASE("period --compare shows every formula with its true error", "[apps][period][paper]") {
  const Result result = period({"--points", "-", "--compare"}, {.input = "amplitude\n1\n2\n2.7\n2.9\n0\n"});
  REQUIRE(result.code == 0);
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 6);
  CHECK(rows[0] == Words{"amplitude", "period", "ratio", "error", "method", "outcome", "normal_form",
                         "normal_form_error", "krylov", "krylov_error", "krylov_squared",
                         "krylov_squared_error"});
  const double errors[] = {3.1e-4, 3.3e-3, -1.5e-2, -5.7e-2};
  for (std::size_t i = 0; i < 4; ++i) {
    const Words& row = rows[i + 1];
    CHECK(number(row[9]) == Approx(errors[i]).epsilon(0.04));
    CHECK(row[7] == row[9]);  // (22) and (31) are one function of the amplitude
    const double own = number(row[0]);
    CHECK(number(row[8]) == Approx(1.0 / (1.0 - own * own / 16.0)).epsilon(1e-15));
    CHECK(number(row[8]) / number(row[2]) - 1.0 == Approx(number(row[9])).epsilon(1e-12));
  }
  CHECK(number(rows[1][2]) == Approx(1.0663342455799631).epsilon(1e-15));
  CHECK(number(rows[1][11]) == Approx(2.5e-3).epsilon(0.02));
  CHECK(rows[4][10].empty());  // beyond sqrt(8)
  CHECK(rows[4][11].empty());
  const Words small = row_of(period({"--amplitude", "1e-4", "--compare"}));
  CHECK(number(small[9]) == Approx(1e-16 / 3072).epsilon(1e-8));  // nothing cancels
  CHECK(rows[5][6] == "1");
  CHECK(rows[5][11] == "0");
  // No formula for rotations and the separatrix.
  for (const auto* excess : {"0", "3"}) {
    const Words row = row_of(period({"--separatrix-excess", excess, "--compare"}));
    CHECK(std::all_of(row.begin() + 6, row.end(), [](const std::string& cell) { return cell.empty(); }));
  }
  const auto json = nlohmann::json::parse(period({"--from-top", "0", "--compare", "--json"}).out);
  CHECK(json.at("rows").at(0).at("krylov").is_null());
}

TEST_CASE("period --compare --figure draws librations told in any way", "[apps][period][figure]") {
  const ScratchDirectory scratch;
  for (const char* table : {"amplitude\n0\n1\n3.141592653589793\n", "from_top\n0\n1e-300\n1\n",
                            "separatrix_excess\n3\n-4\n-1\n0\n"}) {
    const Words flags{"--points", "-", "--compare", "--quiet"};
    Words drawing = flags;
    drawing.insert(drawing.end(), {"--figure", (scratch / "a.svg").string()});
    const Result result = period(drawing, {.input = table});
    INFO(table << result.err);
    CHECK(result.code == 0);
    CHECK(csv_rows(result.out) == csv_rows(period(flags, {.input = table}).out));  // the data are the same
    CHECK(content_of(scratch / "a.svg").find("(31) and (22)") != std::string::npos);
    std::filesystem::remove(scratch / "a.svg");
  }
  CHECK(scratch.names().empty());
}

TEST_CASE("the tolerance of a period picks the cheapest formula that is good enough", "[apps][period]") {
  const auto chosen = [](const char* amplitude, const char* tolerance, const char* method = "auto") {
    const Words row =
        row_of(period({"--amplitude", amplitude, "--tolerance", tolerance, "--method", method}));
    CHECK(number(row[3]) <= number(tolerance));
    CHECK(std::abs(number(row[2]) / number(row_of(period({"--amplitude", amplitude}))[2]) - 1.0) <=
          number(row[3]));
    return row[4];
  };
  CHECK(chosen("1", "1e-3") == "normal_form");
  CHECK(chosen("1", "1e-7") == "series");
  CHECK(chosen("1", "1e-12") == "elliptic");
  CHECK(chosen("3", "1e-3") == "elliptic");
  CHECK(chosen("1", "1e-3", "exact") == "elliptic");
  CHECK(row_of(period({"--separatrix-excess", "-3", "--tolerance", "1e-2"}))[4] == "normal_form");
  CHECK(row_of(period({"--separatrix-excess", "3", "--tolerance", "1e-2"}))[4] == "elliptic");
}

TEST_CASE("periods refuse what has none", "[apps][period][error]") {
  const auto fails = [](const Words& flags, int code, const std::string& why, const Setup& setup = {}) {
    const Result result = period(flags, setup);
    INFO(result.err);
    CHECK(result.code == code);
    CHECK(result.out.empty());
    CHECK(result.err.find(why) != std::string::npos);
  };
  fails({"--amplitude", "3.15"}, 2, "amplitude = 3.15");
  fails({"--amplitude", "-1"}, 2, "amplitude = -1");
  fails({"--amplitude", "nan"}, 2, "nan");
  fails({"--from-top", "4"}, 2, "from_top = 4");
  fails({"--separatrix-excess", "-4.1"}, 2, ">= -4");
  fails({}, 2, "exactly one of");
  fails({"--amplitude", "1", "--from-top", "1"}, 2, "exactly one of");
  fails({"--amplitude", "1", "--tolerance", "1e-16"}, 2, "5e-16");
  fails({"--amplitude", "1", "--set", "pendulum.length=1"}, 2, "--scene");
  fails({"--amplitude", "1", "--method", "cvode"}, 2, "available are auto, exact");
  const std::string two = "amplitude\n1\n2\n";
  fails({"--points", "-", "--figure", "a.png"}, 2, "--compare", {.input = two});
  fails({"--amplitude", "1", "--compare", "--figure", "a.png"}, 2, "--points");
  fails({"--points", "-", "--compare", "--figure", "a.gif"}, 2, ".png", {.input = two});
  fails({"--points", "-", "--compare", "--figure", "a.svg", "-o", "a.svg"}, 2, "same file", {.input = two});
  fails({"--points", "-", "--compare", "--figure", "/none/a.png"}, 5, "/none/a.png", {.input = two});
  fails({"--points", "-", "--compare", "--figure", "a.png"}, 3, "two amplitudes",
        {.input = "amplitude\n1\n"});
  fails({"--points", "-", "--compare", "--figure", "a.png"}, 3, "two amplitudes",
        {.input = "separatrix_excess\n1\n2\n"});
  fails({"--points", "-"}, 3, ":3", {.input = "amplitude\n1\n4\n"});
  fails({"--points", "-"}, 3, "exclude each other", {.input = "amplitude,from_top\n1,1\n"});
  fails({"--points", "-"}, 3, "wanted is a column", {.input = "alpha\n1\n"});
  fails({"--points", "-"}, 3, ":2:3: alpha = 0", {.input = "amplitude,alpha\n1,0\n"});
  fails({"--points", "-"}, 3, ":3:1: amplitude = 4", {.input = "amplitude,alpha\n1,1\n4,1\n"});
  const auto scene_fails = [&](const std::string& text, const std::string& why) {
    fails({"--amplitude", "1", "--scene", "-"}, 3, why, {.input = text});
  };
  scene_fails(kFree + "damping = 0.1\n", "damping");
  scene_fails(kFree + "[support]\nfrequency = 1\n", "[support]");
  scene_fails(kFree + "[moment]\nconstant = 1\n", "[moment]");
  scene_fails("[mathieu]\n", "[pendulum]");
}

TEST_CASE("the motion of a free pendulum is in closed form", "[apps][motion][free]") {
  const Words flags{"motion", "-",          "--quiet", "--angle",   "3", "--velocity",
                    "0",      "--duration", "1e8",     "--samples", "2"};
  const Result result = strutt(flags, {.input = kFree});
  REQUIRE(result.code == 0);
  CHECK(csv_comment(result.out, "method") == "exact");
  CHECK(number(csv_rows(result.out).at(2).at(4)) < 1e-14);
  Words exact = flags;
  exact.insert(exact.end(), {"--method", "exact"});
  CHECK(strutt(exact, {.input = kFree}).out.substr(0, 5) == "# pro");
  for (const std::string& scene : {kFree + "damping = 0.1\n", kFree + "[support]\nfrequency = 1\n"}) {
    const Result refused = strutt(exact, {.input = scene});
    CHECK(refused.code == 2);
    CHECK(refused.err.find("free pendulum") != std::string::npos);
  }
  exact.push_back("--linear");
  CHECK(strutt(exact, {.input = kFree}).code == 2);
}

TEST_CASE("N28: a phase that is not resolved ends with exit code 1", "[apps][motion][free]") {
  const Result result = strutt(
      {"motion", "-", "--quiet", "--angle", "1", "--velocity", "0", "--duration", "1e308", "--samples", "2"},
      {.input = kFree});
  CHECK(result.code == 1);
  const Words lost = csv_rows(result.out).at(2);
  CHECK(lost == Words{"1e+308", "nan", "nan", lost[3], "inf", "tolerance_not_reached"});
}

}  // namespace strutt::test::period_test
