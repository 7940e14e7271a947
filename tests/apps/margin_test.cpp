// The command `strutt margin`: columns, JSON, files, exit codes.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/scene_command.hpp"

namespace strutt::test::margin_test {
namespace {

using Words = std::vector<std::string>;

const char* const kRod = "[pendulum]\nlength = 1\n[support]\nfrequency = 12\namplitude = 0.05\n";

class Command : public SceneCommand {
 public:
  explicit Command(const std::string& scene = kRod) : SceneCommand("margin", scene) {}
  Result run(const Words& more = {}) const { return SceneCommand::run(more); }
};

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

}  // namespace

TEST_CASE("margin writes the rows of the contract", "[apps][margin]") {
  const Result result = Command().run();
  CHECK(result.code == 0);
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 7);
  CHECK(rows[0] == Words{"parameter", "value", "lower_edge", "upper_edge", "distance", "relative_distance",
                         "tongue", "error", "method"});
  CHECK(rows[1][0] == "pendulum.length");
  CHECK(rows[3] == Words{"pendulum.damping", "0", "", "", "inf", "", "", "", ""});
  CHECK(rows[5][0] == "support.frequency");
  CHECK(rows[5][1] == "12");
  CHECK(number(rows[5][2]) == Approx(8.3350255046).epsilon(1e-11));
  CHECK(rows[5][3].empty());
  CHECK(number(rows[5][4]) == Approx(12.0 - 8.3350255046).epsilon(1e-11));
  CHECK(number(rows[5][5]) == Approx(1.0 - 8.3350255046 / 12.0).epsilon(1e-11));
  CHECK(rows[5][6] == "1");
  CHECK(number(rows[5][7]) < 1e-14);
  CHECK(rows[5][8] == "fourier");
  CHECK(rows[6][0] == "joint");
  CHECK(rows[6][1].empty());
  CHECK(rows[6][4] == rows[6][5]);
  CHECK(number(rows[6][5]) < number(rows[5][5]));
}

TEST_CASE("margin takes the parameters asked for, in their order", "[apps][margin]") {
  const auto rows =
      csv_rows(Command().run({"--parameters", "support.frequency,support.amplitude", "--threads", "1"}).out);
  REQUIRE(rows.size() == 4);
  CHECK(rows[1][0] == "support.frequency");
  CHECK(rows[2][0] == "support.amplitude");
  CHECK(rows[3][0] == "joint");
}

TEST_CASE("margin writes JSON with null for what there is not", "[apps][margin]") {
  const Result result = Command().run({"--json", "--set", "support.frequency=2 Hz"});
  CHECK(result.code == 0);
  const auto json = nlohmann::json::parse(result.out);
  const auto& rows = json["rows"];
  REQUIRE(rows.size() == 6);
  CHECK(rows[2]["parameter"] == "pendulum.damping");
  CHECK(rows[2]["distance"] == "inf");
  CHECK(rows[2]["method"].is_null());
  CHECK(rows[5]["parameter"] == "joint");
  CHECK(rows[5]["value"].is_null());
  CHECK(double(rows[5]["error"]) < 1e-12);
  CHECK(json["provenance"]["tolerance"] == "1e-12");
}

TEST_CASE("margin of an unstable design is negative, on the edge 0 and exit code 1 unless it is proved",
          "[apps][margin]") {
  const auto rows = csv_rows(Command("[mathieu]\ndelta = 0.27\nepsilon = 0.2\ndamping = 0.1\n").run().out);
  REQUIRE(rows.size() == 5);
  for (std::size_t i = 1; i <= 4; ++i) CHECK(number(rows[i][4]) < 0.0);
  CHECK(rows[3][8] == "propagator");
  const Result boundary = Command("[mathieu]\ndelta = 0\nepsilon = 0\n").run();
  CHECK(boundary.code == 0);
  CHECK(csv_rows(boundary.out)[1][4] == "0");
  const Result unresolved = Command("[mathieu]\ndelta = 0.4279634012900369\nepsilon = 0.4\n").run();
  CHECK(unresolved.code == 1);
  CHECK(csv_rows(unresolved.out)[1][4] == "0");
}

TEST_CASE("margin --bands lists the safe frequencies", "[apps][margin]") {
  const Result result = Command().run({"--bands", "support.frequency=2:30"});
  CHECK(result.code == 0);
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 8);
  CHECK(rows[0] ==
        Words{"parameter", "from", "to", "verdict", "tongue", "from_error", "to_error", "method", "outcome"});
  CHECK(csv_comment(result.out, "units") == ",rad/s,rad/s,,1,1,1,,");
  CHECK(rows[1][1] == "2");
  CHECK(rows[1][3] == "stable");
  CHECK(rows[1][4].empty());
  CHECK(rows[6][3] == "unstable");
  CHECK(rows[6][4] == "1");
  CHECK(number(rows[6][1]) == Approx(7.1631321909).epsilon(1e-11));
  CHECK(rows[7][2] == "30");
  const auto units = csv_rows(Command().run({"--bands", "support.frequency=1 Hz:2 Hz"}).out);
  CHECK(number(units[1][1]) == Approx(6.283185307).epsilon(1e-9));
}

TEST_CASE("margin --closing-damping tells the damping of each tongue", "[apps][margin]") {
  const Result result =
      Command("[mathieu]\nepsilon = 0.001\n").run({"--closing-damping", "mathieu.delta=0.1:2"});
  CHECK(result.code == 0);
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == Words{"tongue", "crossing", "damping", "error", "position", "method", "outcome"});
  CHECK(number(rows[1][2]) == Approx(0.001).epsilon(1e-5));
  CHECK(number(rows[2][2]) == Approx(0.5 * 0.001 * 0.001 / 2.0).epsilon(1e-5));
  const Command rod;
  CHECK(csv_comment(rod.run({"--closing-damping", "support.frequency=5:30"}).out, "units") ==
        "1,1,1/s,1,rad/s,,");
  CHECK(csv_rows(rod.run({"--closing-damping", "support.frequency=2:30", "--count", "3"}).out).size() == 3);
}

TEST_CASE("margin --box bounds the worst growth", "[apps][margin][slow]") {
  const Result result = Command().run(
      {"--box", "support.frequency=7:9,pendulum.length=0.9:1.1", "--tolerance", "1e-2", "--json"});
  CHECK(result.code == 0);
  const auto row = nlohmann::json::parse(result.out)["rows"][0];
  CHECK(double(row["growth"]) > 0.2);
  CHECK(double(row["error"]) <= 1e-2);
  CHECK(row["error_kind"] == "bound");
  CHECK(double(row["support.frequency"]) >= 7.0);
  CHECK(double(row["pendulum.length"]) <= 1.1);
  CHECK(row["outcome"] == "converged");
  const Result hard = Command("[mathieu]\ndelta = 3\nepsilon = 5\n")
                          .run({"--box", "mathieu.delta=1:5,mathieu.epsilon=3:8", "--tolerance", "1e-6"});
  CHECK(hard.code == 1);  // the evaluations run out, and the error says so
}

TEST_CASE("margin --sensitivities tells slopes, of an edge too", "[apps][margin]") {
  const Command command("[mathieu]\ndelta = 0.27\nepsilon = 0.2\n");
  const auto rows = csv_rows(command.run({"--sensitivities", "--edge", "mathieu.delta"}).out);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0] == Words{"parameter", "value", "growth_slope", "growth_error", "growth_per_time_slope",
                         "growth_per_time_error", "winding_slope", "winding_error", "margin_slope",
                         "margin_error", "edge", "edge_slope", "edge_error", "outcome"});
  CHECK(number(rows[1][10]) == Approx(0.344746684).epsilon(2e-9));
  CHECK(rows[1][11] == "0");
  CHECK(number(rows[2][11]) == Approx(0.5 - 0.25 * 0.2).epsilon(0.02));  // a_1/4 = 1/4 + e/2 - e^2/8 - ...
  CHECK(number(rows[1][4]) == Approx(number(rows[1][2]) / 6.283185307179586).epsilon(1e-15));
  CHECK(rows[1][6] == "0");
  const auto chosen = csv_rows(command.run({"--sensitivities", "--parameters", "mathieu.epsilon"}).out);
  REQUIRE(chosen.size() == 2);
  CHECK(chosen[0].size() == 11);
}

TEST_CASE("margin answers one question at a time, and names what is wrong with it", "[apps][margin]") {
  const Command command;
  const std::vector<Words> wrong{{"--bands", "support.frequency=2:30", "--sensitivities"},
                                 {"--bands", "support.frequency=2:30", "--parameters", "support.frequency"},
                                 {"--bands", "support.frequency=30:2"},
                                 {"--bands", "support.frequency=0:2"},
                                 {"--bands", "support.frequency"},
                                 {"--bands", "support.frequncy=1:2"},
                                 {"--bands", "support.frequency=1:nan"},
                                 {"--bands", "support.frequency=1:2 m"},
                                 {"--count", "3"},
                                 {"--edge", "support.frequency"},
                                 {"--sensitivities", "--edge", "support.frequncy"},
                                 {"--sensitivities", "--edge", "pendulum.mass"},
                                 {"--closing-damping", "support.frequency=2:1"},
                                 {"--closing-damping", "pendulum.damping=0:1"},
                                 {"--closing-damping", "support.frequency=2:30", "--count", "1"},
                                 {"--box", "support.frequency=2:1"},
                                 {"--box", "support.phase=0:1"},
                                 {"--box", ""},
                                 {"--box", "support.frequency=2:3", "--tolerance", "1"}};
  for (const Words& words : wrong) {
    CAPTURE(words);
    const Result result = command.run(words);
    CHECK(result.code == 2);
    CHECK_THAT(result.err, Catch::Matchers::Contains("--"));
    CHECK(result.out.empty());
  }
  for (const Words& words : std::vector<Words>{{"--bands", "support.frequency=2:30"},
                                               {"--closing-damping", "support.frequency=2:30"},
                                               {"--box", "support.frequency=2:30"},
                                               {"--sensitivities"}}) {
    Words dry = words;
    dry.push_back("--dry-run");
    const Result result = command.run(dry);
    CHECK(result.code == 0);
    CHECK_THAT(result.out, Catch::Matchers::Contains("# model: pendulum, hanging"));
  }
}

TEST_CASE("margin names the flag or the scene that is wrong", "[apps][margin]") {
  const Command command;
  const Result unknown = command.run({"--parameters", "support.frequncy"});
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Catch::Matchers::Contains("support.frequency"));
  CHECK(command.run({"--parameters", ""}).code == 2);
  CHECK(command.run({"--parameters", "support.frequency,support.frequency"}).code == 2);
  CHECK(command.run({"--tolerance", "1e-14"}).code == 2);
  CHECK(command.run({"--tolerance", "nan"}).code == 2);
  CHECK(command.run({"--method", "cvode"}).code == 2);
  CHECK(command.run({"--set", "support.frequency=nan"}).code == 2);
  CHECK(command.run({"--set", "support.frequency=0"}).code == 2);
  CHECK(command.run({"-o", command.path("a.npz")}).code == 2);
  CHECK(Command("[mathieu]\ndelta = nan\n").run().code == 3);
  CHECK(Command("[mathieu]\ndetla = 1\n").run().code == 3);
}

TEST_CASE("margin tells its plan and writes its file", "[apps][margin]") {
  const Command command;
  const Result plan = command.run({"--dry-run"});
  CHECK(plan.code == 0);
  CHECK_THAT(plan.out, Catch::Matchers::Contains("# parameters: pendulum.length, pendulum.gravity"));
  CHECK(command.run({"-o", command.path("margin.csv"), "--parameters", "support.frequency"}).code == 0);
  std::ifstream file(command.path("margin.csv"));
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  CHECK(csv_rows(text).size() == 3);
  CHECK_THAT(command.run({"--help"}).out, Catch::Matchers::Contains("strutt margin scene.toml"));
}

}  // namespace strutt::test::margin_test
