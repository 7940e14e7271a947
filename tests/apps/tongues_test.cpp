// The command `strutt tongues`: columns, JSON, files, exit codes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/scene_command.hpp"

namespace strutt::test::tongues_test {
namespace {

using Words = std::vector<std::string>;

class Command : public SceneCommand {
 public:
  explicit Command(const std::string& scene = "[mathieu]\nepsilon = 0.01\n")
      : SceneCommand("tongues", scene) {}
  Result run(const std::string& along, const Words& more = {}) const {
    Words words{"--along", along};
    words.insert(words.end(), more.begin(), more.end());
    return SceneCommand::run(words);
  }
};

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

}  // namespace

TEST_CASE("tongues writes the rows of the contract", "[apps][tongues]") {
  const Result result = Command().run("mathieu.delta=-1:40");
  CHECK(result.code == 0);
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() == 26);
  CHECK(rows[0] ==
        Words{"n", "edge", "position", "width", "width_relative_error", "error", "method", "outcome"});
  CHECK(csv_comment(result.out, "units") == "1,,1,1,1,1,,");
  CHECK(rows[1][0] == "0");
  CHECK(rows[1][1] == "upper");
  CHECK(rows[1][3].empty());
  CHECK(rows[1][4].empty());
  CHECK(rows[24][0] == "12");
  CHECK(rows[24][1] == "lower");
  CHECK(rows[25][1] == "upper");
  CHECK(number(rows[25][3]) == Approx(3.0644926e-43).epsilon(1e-7).margin(0));
  CHECK(rows[25][6] == "fourier");
  CHECK(rows[25][7] == "converged");
}

TEST_CASE("tongues takes a line for each row of a table", "[apps][tongues]") {
  const Command command;
  const auto table = command.write("at.csv", "mathieu.epsilon\n0.5\n0\n");
  const auto rows = csv_rows(command.run("mathieu.delta=-1:0.9", {"--at", table}).out);
  REQUIRE(rows.size() == 7);
  CHECK(rows[0][2] == "mathieu.epsilon");
  CHECK(rows[1][2] == "0.5");
  CHECK(rows[4][2] == "0");
  CHECK(rows[4][0] == "0");
  CHECK(rows[5][4] == "0");  // closed: without excitation there are no tongues
  CHECK(rows[5][3] == "0.25");
  const auto one = csv_rows(command.run("mathieu.delta=-1:0.9", {"--at", table, "--threads", "1"}).out);
  CHECK(one == rows);
}

TEST_CASE("tongues numbers the crossings where there are several", "[apps][tongues]") {
  const auto rows =
      csv_rows(Command("[mathieu]\ndelta = 0.35\n").run("mathieu.epsilon=-1:1", {"--count", "2"}).out);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].back() == "crossing");
  CHECK(rows[1].back() == "0");
  CHECK(rows[2].back() == "1");
}

TEST_CASE("tongues adds growth if asked for", "[apps][tongues]") {
  const auto rows = csv_rows(Command().run("mathieu.delta=0.1:0.5", {"--growth"}).out);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0][8] == "growth");
  CHECK(rows[0][9] == "growth_position");
  CHECK(number(rows[1][8]) == Approx(3.14159e-2).epsilon(1e-4));
  CHECK(number(rows[1][9]) == Approx(0.25).epsilon(1e-3));
  CHECK(rows[2][8] == rows[1][8]);
}

TEST_CASE("tongues writes JSON, with units in the scene's parameters", "[apps][tongues]") {
  const Command command("[pendulum]\nlength = 1\n[support]\nfrequency = 12\namplitude = 0.05\n");
  const auto result = command.run("support.frequency=1 Hz:2 Hz", {"--json"});
  CHECK(result.code == 0);
  const auto json = nlohmann::json::parse(result.out);
  REQUIRE(json["rows"].size() == 2);
  CHECK(json["rows"][0]["n"] == 1);
  CHECK(json["rows"][1]["edge"] == "upper");
  CHECK(json["provenance"]["method"] == "fourier");
  const double width = json["rows"][1]["width"];
  CHECK(width ==
        Approx(double(json["rows"][1]["position"]) - double(json["rows"][0]["position"])).epsilon(1e-12));
}

TEST_CASE("tongues of damped scenes, square waves and systems", "[apps][tongues]") {
  const Command damped("[mathieu]\nepsilon = 0.5\ndamping = 0.02\n");
  auto rows = csv_rows(damped.run("mathieu.delta=-1:40").out);
  REQUIRE(rows.size() == 6);  // the tongues from 3 on are closed
  CHECK(rows[5][0] == "2");
  CHECK(rows[5][6] == "propagator");
  CHECK(damped.run("mathieu.delta=-1:40", {"--method", "propagator"}).code == 0);
  CHECK(damped.run("mathieu.delta=-1:40", {"--method", "fourier"}).code == 2);

  const Command square("[hill]\nperiod = 6.283185307179586\nwaveform = 'square'\namplitude = 4\n");
  rows = csv_rows(square.run("hill.mean=4.9:5.1").out);
  REQUIRE(rows.size() == 3);
  CHECK(rows[1][0] == "4");  // closed: both pieces turn by whole half turns at mean = 5
  CHECK(rows[1][4] == "1");
  CHECK(rows[1][6] == "exact");

  const Command coupled(
      "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\n"
      "stiffness = { mean = [[1.3, -0.3], [-0.3, 2.3]], "
      "harmonics = [{ order = 1, cos = [[0.4, 0], [0, 0]] }] }\n");
  const Result result = coupled.run("linear.period=1.8:3.4", {"--tolerance", "1e-10"});
  CHECK(result.code == 0);
  rows = csv_rows(result.out);
  REQUIRE(rows.size() == 7);
  CHECK(rows[0] == Words{"n", "edge", "position", "width", "width_relative_error", "error", "method",
                         "outcome", "mechanism", "crossing"});
  for (std::size_t i = 1; i < 7; ++i) {
    CHECK(rows[i][0].empty());
    CHECK(rows[i][8] == (i == 3 || i == 4 ? "complex" : "-1"));
  }
  CHECK(coupled.run("linear.period=1.8:3.4", {"--count", "2"}).code == 2);
}

TEST_CASE("tongues --over writes curves, and draws them", "[apps][tongues]") {
  const Command command("[mathieu]\nepsilon = 0.5\ndamping = 0.1\n");
  const auto picture = command.write("curves.svg", "");
  const Result result = command.run(
      "mathieu.delta=-1:2", {"--over", "mathieu.epsilon=0:2", "--tolerance", "1e-11", "--figure", picture});
  CHECK(result.code == 0);  // beside a tip 2e-12 is what rounding leaves
  const auto rows = csv_rows(result.out);
  REQUIRE(rows.size() > 50);
  CHECK(rows[0] ==
        Words{"n", "curve", "edge", "mathieu.delta", "mathieu.epsilon", "error", "method", "outcome"});
  CHECK(csv_comment(result.out, "units") == "1,1,,1,1,1,,");
  CHECK(std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row[2] == "tip"; }) == 2);
  std::ifstream file(picture);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CHECK_THAT(text, Catch::Matchers::Contains("</svg>"));
  CHECK_THAT(text, Catch::Matchers::Contains("n = 2"));
  CHECK(command.run("mathieu.delta=-1:2", {"--over", "mathieu.delta=0:2"}).code == 2);
  CHECK(command.run("mathieu.delta=-1:2", {"--over", "mathieu.epsilon=2"}).code == 2);
  CHECK(command.run("mathieu.delta=-1:2", {"--over", "mathieu.epsilon=0:1", "--chord", "1"}).code == 2);
  CHECK(command.run("mathieu.delta=-1:2", {"--over", "mathieu.epsilon=0:1", "--growth"}).code == 2);
  CHECK(command.run("mathieu.delta=-1:2", {"--figure", picture}).code == 2);
}

TEST_CASE("the figure of a chart has the edges of its tongues, or does without", "[apps][tongues][figure]") {
  const ScratchDirectory directory;
  const auto picture_of = [&](const std::string& scene, const Words& axes) {
    const auto path = (directory.path() / "scene.toml").string();
    const auto figure = (directory.path() / "figure.svg").string();
    std::ofstream(path) << scene;
    Words words{"chart", path, "-o", (directory.path() / "chart.npz").string(), "--figure", figure};
    words.insert(words.end(), axes.begin(), axes.end());
    CHECK(strutt(words).code == 0);
    std::ifstream file(figure);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(picture_of("[mathieu]\ndelta = 1\n",
                        {"--x", "mathieu.delta=-1.03:5:21", "--y", "mathieu.epsilon=0.1:5:11"}),
             Contains("tongue edges"));
  const auto system = picture_of(
      "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\nstiffness = { mean = [[1.3, -0.3], [-0.3, 2.3]], "
      "harmonics = [{ order = 1, cos = [[0.4, 0], [0, 0]] }] }\n",
      {"--x", "linear.period=2.61:3.07:11", "--y", "linear.stiffness.harmonics.1.cos.0.0=0.31:0.83:9"});
  CHECK_THAT(system, Contains("edge -1 (min. stroke)") && !Contains("complex") &&
                         !Contains("edge of stability") && !Contains("tongue edges"));
}

TEST_CASE("tongues that every cell of a chart misses are drawn on its figure",
          "[apps][tongues][figure][extreme][N52]") {
  const ScratchDirectory directory;
  const auto check = [&](const std::string& scene, const Words& axes, const std::string& key) {
    const auto path = (directory.path() / "scene.toml").string();
    const auto figure = (directory.path() / "figure.svg").string();
    std::ofstream(path) << scene;
    Words words{"chart", path, "--layers", "verdict", "--figure", figure};
    words.insert(words.end(), axes.begin(), axes.end());
    const Result result = strutt(words);
    CHECK(result.code == 0);
    const auto rows = csv_rows(result.out);
    REQUIRE(rows.size() > 30);
    CHECK(std::all_of(rows.begin() + 1, rows.end(), [](const Words& row) { return row[2] == "stable"; }));
    std::ifstream file(figure);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK_THAT(text, Catch::Matchers::Contains(key));
  };
  check("[mathieu]\n", {"--x", "mathieu.delta=3.6:5.9:12", "--y", "mathieu.epsilon=0.05:0.4:7"},
        "tongue edges (min. stroke)");
  check(
      "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\nstiffness = { mean = [[1.3, -0.3], [-0.3, 2.3]], "
      "harmonics = [{ order = 1, cos = [[0.4, 0], [0, 0]] }] }\n",
      {"--x", "linear.period=2.2:2.5:6", "--y", "linear.stiffness.harmonics.1.cos.0.0=0.01:0.05:5"},
      "complex (min. stroke)");
}

TEST_CASE("a figure without the edges of tongues says why", "[apps][tongues][figure]") {
  const ScratchDirectory directory;
  const Setup setup{.input = "[mathieu]\n", .directory = directory.path()};
  Words words{"chart", "-",        "--x",  "mathieu.delta=0:4000:3", "--y", "mathieu.epsilon=0:1:2", "-o",
              "c.csv", "--figure", "c.svg"};
  const Result result = strutt(words, setup);
  CHECK(result.code == 0);
  CHECK_THAT(result.err, Catch::Matchers::Contains("no tongue edges in the figure") &&
                             Catch::Matchers::Contains("tongues, more than 100"));
  words.emplace_back("--quiet");
  CHECK(strutt(words, setup).err.empty());
}

TEST_CASE("a scene that has no tongues at all is a mistake of the file", "[apps][tongues]") {
  const Command command("[hill]\nperiod = 1\nharmonics = [{ order = 1, cos = 1e9 }]\n");
  CHECK(command.run("hill.mean=0:1").code == 3);
  CHECK(Command("[mathieu]\ndamping = -1\n").run("mathieu.delta=0:1").code == 3);
  CHECK(Command().run("mathieu.epsilon=0:1e9").code == 2);  // the line is to blame
}

TEST_CASE("tongues names the flag or the cell that is wrong", "[apps][tongues]") {
  const Command command;
  for (const char* along : {"mathieu.delta", "mathieu.delta=1", "mathieu.delta=2:1", "mathieu.delta=0:1:3",
                            "delta=0:1", "mathieu.delta=0:x", "=0:1"}) {
    CAPTURE(along);
    const Result result = command.run(along);
    CHECK(result.code == 2);
    CHECK_THAT(result.err, Catch::Matchers::Contains("--along"));
  }
  CHECK(command.run("mathieu.delta=0:1", {"--count", "0"}).code == 2);
  CHECK(command.run("mathieu.delta=0:1", {"--tolerance", "1e-14"}).code == 2);
  CHECK(command.run("mathieu.delta=0:1", {"--method", "cvode"}).code == 2);
  CHECK(command.run("mathieu.delta=0:1", {"--at", command.write("a.csv", "mathieu.epsilon\nnan\n")}).code ==
        3);
  CHECK(command.run("mathieu.delta=0:1", {"--at", command.write("b.csv", "mathieu.delta\n1\n")}).code == 3);
}

}  // namespace strutt::test::tongues_test
