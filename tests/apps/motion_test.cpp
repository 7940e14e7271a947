// `strutt motion`: time series, orders of times, the linearised equation.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test::motion_test {
namespace {

using Words = std::vector<std::string>;
const std::string kFree = "[pendulum]\nlength = 1\n";
const double kAlpha = std::sqrt(1.5 * 9.81);  // of a rod of 1 m

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

Words motion(const std::string& angle, const std::string& velocity, const Words& more) {
  Words words{"motion", "-", "--quiet", "--angle", angle, "--velocity", velocity};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_CASE("a motion has the documented columns, times by lerp with both ends", "[apps][motion]") {
  const Result result =
      strutt(motion("30 deg", "0", {"--duration", "0.7", "--samples", "4"}), {.input = kFree});
  CHECK(result.code == 0);
  CHECK(result.err.empty());
  CHECK(csv_comment(result.out, "units") == "s,rad,rad/s,1,rad,");
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 5);
  CHECK(rows[0] == Words{"t", "angle", "velocity", "energy", "error", "outcome"});
  CHECK(rows[1][0] == "0");
  CHECK(rows[4][0] == "0.7");
  CHECK(number(rows[1][1]) == Approx(std::acos(-1.0) / 6.0).epsilon(1e-15));
  CHECK(rows[1][2] == "0");
  for (std::size_t i = 1; i < 5; ++i) {
    CHECK(rows[i][5] == "converged");
    CHECK(number(rows[i][4]) <= 1e-9);
    // C1 - 2 = (phi'/alpha)^2 - 4 cos^2(phi/2), constant without excitation and damping.
    const double angle = number(rows[i][1]), velocity = number(rows[i][2]);
    CHECK(number(rows[i][3]) ==
          Approx(std::pow(velocity / kAlpha, 2) - 4.0 * std::pow(std::cos(angle / 2.0), 2)).epsilon(1e-14));
    CHECK(number(rows[i][3]) == Approx(number(rows[1][3])).epsilon(1e-14));
  }
}

TEST_CASE("motion --linear about both equilibria is the closed form", "[apps][motion]") {
  const Words times{"--duration", "1", "--samples", "6", "--linear"};
  for (const auto& row : csv_rows(strutt(motion("0.4", "0.3", times), {.input = kFree}).out)) {
    if (row[0] == "t") continue;
    const double t = number(row[0]);
    CHECK(number(row[1]) ==
          Approx(0.4 * std::cos(kAlpha * t) + 0.3 / kAlpha * std::sin(kAlpha * t)).epsilon(0.0).margin(2e-9));
  }
  const double pi = std::acos(-1.0);
  const Result inverted = strutt(motion("3", "0", times), {.input = kFree + "about = \"inverted\"\n"});
  const auto rows = csv_rows(inverted.out);
  REQUIRE(rows.size() == 7);
  for (std::size_t i = 1; i < 7; ++i) {
    const double t = number(rows[i][0]);
    CHECK(number(rows[i][1]) == Approx(pi + (3.0 - pi) * std::cosh(kAlpha * t)).epsilon(0.0).margin(1e-8));
  }
}

TEST_CASE("rows come back in the order of --times, equal times too", "[apps][motion]") {
  const ScratchDirectory directory;
  directory.with("t.csv", "t [s]\n3\n1\n2\n0\n1\n100 \n");
  directory.with("ms.csv", "t [ms]\n3000\n1000\n2000\n0\n1000\n100000\n");
  directory.with("scene.toml", kFree + "damping = 1\n[support]\nfrequency = 12\n");
  const auto run = [&](const std::string& times) {
    Words words = motion("1", "0", {"--times", times});
    words[1] = "scene.toml";
    const Result result = strutt(words, {.directory = directory.path()});
    CHECK(result.code == 0);
    return csv_rows(result.out);
  };
  const auto rows = run("t.csv");
  REQUIRE(rows.size() == 7);
  Words times;
  for (std::size_t i = 1; i < 7; ++i) times.push_back(rows[i][0]);
  CHECK(times == Words{"3", "1", "2", "0", "1", "100"});
  CHECK(rows[2] == rows[5]);
  CHECK(rows[4][1] == "1");
  CHECK(std::abs(number(rows[6][1])) < 1e-8);  // damped out
  CHECK(run("ms.csv") == rows);
}

TEST_CASE("an excited motion at one time does not depend on the others asked for", "[apps][motion]") {
  const std::string scene = kFree + "[support]\nfrequency = 12\namplitude = 0.1\n";
  const auto many =
      csv_rows(strutt(motion("1", "0", {"--duration", "2", "--samples", "9"}), {.input = scene}).out);
  const auto two =
      csv_rows(strutt(motion("1", "0", {"--duration", "2", "--samples", "2"}), {.input = scene}).out);
  REQUIRE(many.size() == 10);
  REQUIRE(two.size() == 3);
  const double bound = number(many[9][4]) + number(two[2][4]);
  CHECK(std::abs(number(many[9][1]) - number(two[2][1])) <= bound);
  CHECK(bound <= 2e-9);
}

TEST_CASE("a full turn is unwrapped", "[apps][motion]") {
  const auto rows =
      csv_rows(strutt(motion("0", "-20", {"--duration", "3", "--samples", "2"}), {.input = kFree}).out);
  REQUIRE(rows.size() == 3);
  CHECK(number(rows[2][1]) < -40.0);
}

TEST_CASE("a motion as JSON", "[apps][motion]") {
  const Result result =
      strutt(motion("0.5", "-0.25", {"--duration", "0", "--samples", "1", "--json"}), {.input = kFree});
  CHECK(result.code == 0);
  const auto json = nlohmann::ordered_json::parse(result.out);
  REQUIRE(json["rows"].size() == 1);
  CHECK(json["rows"][0]["t"] == 0.0);
  CHECK(json["rows"][0]["angle"] == 0.5);
  CHECK(json["rows"][0]["velocity"] == -0.25);
  CHECK(json["rows"][0]["outcome"] == "converged");
}

}  // namespace strutt::test::motion_test
