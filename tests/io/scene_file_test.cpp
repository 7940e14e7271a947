#include "strutt/io/scene_file.hpp"

#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <numbers>

#include "io/scene_text.hpp"
#include "io/scratch.hpp"

namespace strutt::test::scene_file_test {

namespace {

using test::complaint;
using test::contains;
using test::kRod;
using test::kShaken;
using test::message_of;
using test::scene_of;
using test::ScratchDirectory;

/// to_toml of what was read, read and written again, must be the same text.
std::string written(const std::string& text) {
  const auto once = to_toml(parse_scene(text, "s.toml"));
  CHECK(to_toml(parse_scene(once, "s.toml")) == once);
  return once;
}

}  // namespace

TEST_CASE("a pendulum scene has the documented defaults", "[io][scene_file]") {
  const auto scene = scene_of(kShaken);
  REQUIRE(scene.pendulum);
  CHECK(scene.pendulum->shape == PendulumTable::Shape::rod);
  CHECK(scene.pendulum->mass == 1.0);
  CHECK(scene.pendulum->gravity == 9.81);
  CHECK(scene.pendulum->damping == 0.0);
  CHECK(scene.pendulum->about == Equilibrium::hanging);
  REQUIRE(scene.support);
  CHECK(scene.support->waveform == Waveform::sine);
  CHECK(scene.support->amplitude == 0.05);
  CHECK(scene.support->phase == 0.0);
  CHECK_FALSE(scene.moment);
  CHECK_FALSE(scene_of(kRod).support);
}

TEST_CASE("all shapes, equilibria and forms of a support", "[io][scene_file]") {
  const auto body =
      scene_of("[pendulum]\nshape = \"body\"\ninertia = 0.4\ncentroid = 0.5\nabout = \"inverted\"\n");
  CHECK(body.pendulum->shape == PendulumTable::Shape::body);
  CHECK(body.pendulum->about == Equilibrium::inverted);
  CHECK(scene_of("[pendulum]\nshape = \"point_mass\"\nlength = 2\n").pendulum->length == 2.0);
  const auto harmonics =
      scene_of(kRod +
               "[support]\nfrequency = 3\nharmonics = [{ order = 1, cos = 0.0, sin = 0.05 }, "
               "{ order = 3, sin = 0.01 }]\n");
  REQUIRE(harmonics.support->harmonics.size() == 2);
  CHECK(harmonics.support->harmonics[1].order == 3);
  CHECK(harmonics.support->harmonics[1].cosine == 0.0);
  CHECK(harmonics.support->harmonics[1].sine == 0.01);
  const auto square = scene_of(
      kRod + "[support]\nfrequency = 3\nwaveform = \"square_acceleration\"\namplitude = 0\nphase = 1\n");
  CHECK(square.support->waveform == Waveform::square);
  CHECK(square.support->amplitude == 0.0);
  const auto listed =
      scene_of(kRod + "[[support.harmonics]]\norder = 2\ncos = 0.1\n[support]\nfrequency = 3\n");
  CHECK(listed.support->harmonics[0].order == 2);
}

TEST_CASE("sample files are looked for beside the scene", "[io][scene_file]") {
  const ScratchDirectory directory;
  directory.with("r.csv", "\xEF\xBB\xBFr [m]\r\n0.0\r\n0.1\r\n-0.1\r\n");
  const auto path = directory.with("s.toml", kRod + "[support]\nfrequency = 3\nsamples = \"r.csv\"\n");
  const auto file = read_scene(path);
  CHECK(file.scene.support->samples == std::vector<double>{0.0, 0.1, -0.1});
  CHECK(to_toml(parse_scene(to_toml(file), "elsewhere/s.toml")) == to_toml(file));
  const auto bad = directory.with("bad.toml", kRod + "[support]\nfrequency = 3\nsamples = \"r2.csv\"\n");
  CHECK_THROWS_AS(read_scene(bad), InputOutputError);
  directory.with("r2.csv", "r\n0.0\nnan\n");
  CHECK(contains(message_of<FileError>([&] { read_scene(bad); }), "r2.csv:3:1: 'nan'"));
  directory.with("r2.csv", "x\n0.0\n");
  CHECK(contains(message_of<FileError>([&] { read_scene(bad); }), "r2.csv:1:1: unknown column 'x'"));
}

TEST_CASE("the moment takes its frequency from the support", "[io][scene_file]") {
  const std::string moment = "[moment]\nharmonics = [{ order = 1, sin = 0.2 }]\n";
  CHECK_FALSE(scene_of(kShaken + moment).moment->frequency);
  CHECK_FALSE(scene_of(kShaken + moment + "frequency = 12\n").moment->frequency);
  CHECK(scene_of(kRod + moment + "frequency = 7\n").moment->frequency == 7.0);
  CHECK(scene_of(kRod + "[moment]\nconstant = 0.1\n").moment->constant == 0.1);
  CHECK(complaint(kShaken + moment + "frequency = 13\n") ==
        "s.toml:7:13: moment.frequency = 13 must equal support.frequency = 12, or be left out");
  CHECK(complaint(kRod + moment) ==
        "s.toml:3:1: moment.frequency is missing: there are harmonics and no [support]");
}

TEST_CASE("Mathieu's equation in both forms", "[io][scene_file]") {
  const auto standard = scene_of("[mathieu]\n");
  CHECK(standard.mathieu->delta == 1.0);
  CHECK(standard.mathieu->epsilon == 0.5);
  CHECK_FALSE(standard.mathieu->mathieu_form);
  const auto other = scene_of("[mathieu]\na = 2\nq = -3\ndamping = 0.1\n");
  CHECK(other.mathieu->mathieu_form);
  CHECK(parameter(other, "mathieu.a") == 2.0);
  CHECK(parameter(other, "mathieu.q") == -3.0);
  CHECK(complaint("[mathieu]\ndelta = 1\nq = 2\n") ==
        "s.toml:3:5: mathieu.delta and mathieu.q exclude each other");
  CHECK(complaint("[mathieu]\na = 1\n") == "s.toml:1:1: mathieu.q is missing");
}

TEST_CASE("Hill's equation with harmonics or as a square wave", "[io][scene_file]") {
  const auto hill = scene_of("[hill]\nperiod = 2\nharmonics = [{ order = 1, cos = 0.5 }]\n");
  CHECK(hill.hill->mean == 1.0);
  CHECK(parameter(hill, "hill.harmonics.1.cos") == 0.5);
  CHECK(parameter(hill, "hill.harmonics.1.sin") == 0.0);
  const auto square = scene_of("[hill]\nperiod = 2\nmean = 0\nwaveform = \"square\"\n");
  CHECK(square.hill->amplitude == 0.5);
  CHECK(square.hill->waveform == Waveform::square);
  CHECK(complaint("[hill]\nperiod = 2\namplitude = 1\n") ==
        "s.toml:3:13: hill.amplitude goes with waveform = \"square\" only");
  CHECK(contains(complaint("[hill]\nperiod = 2\nwaveform = \"square\"\nharmonics = []\n"),
                 "exclude each other"));
}

TEST_CASE("a linear system with matrices", "[io][scene_file]") {
  const std::string head = "[linear]\nperiod = 6.283185307179586\nmass = [[1,0],[0,1]]\n";
  const auto scene =
      scene_of(head +
               "stiffness = { mean = [[1,0],[0,2]], harmonics = [{ order = 1, cos = [[0.1,0.2],"
               "[0.2,0.1]] }] }\ndamping = { mean = [[0,0],[0,0]] }\n");
  CHECK(scene.linear->degrees_of_freedom() == 2);
  CHECK(parameter(scene, "linear.stiffness.harmonics.1.cos.0.1") == 0.2);
  CHECK(parameter(scene, "linear.stiffness.harmonics.1.sin.0.1") == 0.0);
  CHECK(scene_of(head + "stiffness = { mean = [[1,0],[0,2]] }\n").linear->damping.mean.size() == 0);
  CHECK(complaint(head + "stiffness = { mean = [[1]] }\n") ==
        "s.toml:3:8: linear.mass has 2 rows, the other matrices have 1");
  CHECK(complaint(head + "stiffness = { mean = [[1,0],[0]] }\n") ==
        "s.toml:4:29: linear.stiffness.mean must be square: it has 2 rows, but row 1 has 1 entries");
  CHECK(complaint(head + "stiffness = { mean = [] }\n") ==
        "s.toml:4:22: linear.stiffness.mean is empty: it must be a square matrix, a list of rows");
  CHECK(complaint(head + "stiffness = { mean = [[1,0],[0,true]] }\n") ==
        "s.toml:4:32: linear.stiffness.mean.1.1 must be a number, not a boolean");
  CHECK(complaint(head + "stiffness = [[1,0],[0,1]]\n") ==
        "s.toml:4:13: linear.stiffness must be a table, not a list");
  CHECK(complaint(head) == "s.toml:1:1: linear.stiffness is missing");
  CHECK(contains(complaint("[linear]\nperiod = 1\nmass = [[0]]\nstiffness = { mean = [[1]] }\n"),
                 "linear.mass"));
}

TEST_CASE("a chart table", "[io][scene_file]") {
  const auto file =
      parse_scene(kShaken +
                      "[chart]\nx = { parameter = \"support.frequency\", from = \"1 Hz\", to = 30, points = "
                      "12, scale = \"log\" }\ny = { parameter = \"support.amplitude\", from = \"5 mm\", to = "
                      "0 }\nlayers = [\"verdict\", \"margin\"]\ntolerance = 1e-6\n",
                  "s.toml");
  REQUIRE(file.chart.x);
  CHECK(file.chart.x->from == 2 * std::numbers::pi);
  CHECK(file.chart.x->points == 12);
  CHECK(file.chart.x->scale == AxisScale::logarithmic);
  CHECK(file.chart.y->from == 0.005);
  CHECK(file.chart.y->points == 800);
  CHECK(file.chart.layers == std::vector<Layer>{Layer::verdict, Layer::margin});
  CHECK(file.chart.tolerance == 1e-6);
  CHECK_FALSE(parse_scene(kShaken + "[chart]\n", "s.toml").chart.x);
}

TEST_CASE("harmless varieties of TOML", "[io][scene_file]") {
  CHECK(scene_of("\xEF\xBB\xBF[pendulum]\r\nlength = 2 # m\r\n").pendulum->length == 2.0);
  CHECK(scene_of("pendulum.length = 2").pendulum->length == 2.0);
  CHECK(scene_of("pendulum = { length = 1_0.2_5 }").pendulum->length == 10.25);
  CHECK(scene_of("[pendulum]\nlength = +2e0\n").pendulum->length == 2.0);
  CHECK(scene_of("# [[[[ \"\"\" é 0.1\n[pendulum]\n\"length\" = 2\n").pendulum->length == 2.0);
  CHECK(scene_of("[pendulum]\nabout = '''hanging'''\nlength = \"\"\"2 m\"\"\"\n").pendulum->length == 2.0);
  CHECK(scene_of("[hill]\nperiod = 1\nmean = 100000000000000000000000\n").hill->mean == 1e23);
}

TEST_CASE("decimals of any length in a scene are correctly rounded", "[io][scene_file][number]") {
  const auto mean = [](const std::string& text) {
    return scene_of("[hill]\nperiod = 1\nmean = " + text + "\n").hill->mean;
  };
  CHECK(mean("0." + std::string(300, '3')) == 1.0 / 3.0);
  const std::string half = "1.00000000000000011102230246251565404236316680908203125";
  CHECK(mean(half) == 1.0);
  CHECK(mean(half + std::string(300, '0') + "1") == std::nextafter(1.0, 2.0));
  CHECK(mean("9007199254740993") == 9007199254740992.0);
  CHECK(mean("5e-324") == 5e-324);
  CHECK(mean("1e-400") == 0.0);
  CHECK(mean("\"0." + std::string(300, '3') + "\"") == 1.0 / 3.0);
}

TEST_CASE("a scene does not depend on the locale", "[io][scene_file][F4]") {
  const std::string old = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::setlocale(LC_ALL, "de_DE.utf8") == nullptr) {
    WARN("no locale with a decimal comma is installed");
    return;
  }
  CHECK(scene_of("[pendulum]\nlength = 2.5\n").pendulum->length == 2.5);
  CHECK(contains(written("[pendulum]\nlength = 2.5\n"), "length = 2.5\n"));
  std::setlocale(LC_ALL, old.c_str());
}

TEST_CASE("a scene written is the scene read", "[io][scene_file]") {
  written(kShaken + "[moment]\nconstant = 1\nharmonics = [{ order = 2, cos = 1e-300 }]\n");
  written(kRod + "[moment]\nconstant = 1\nfrequency = 3\n");
  written("[pendulum]\nshape = \"body\"\ninertia = 1.4\ncentroid = 0.5\nabout = \"inverted\"\n");
  written(kRod +
          "[support]\nfrequency = 3\nharmonics = [{ order = 7, sin = 0.1 }, { order = 2, cos = 1 }]\n");
  written(kRod + "[support]\nfrequency = 3\nsamples = [0.1, 0.2, 1e25]\n");
  written(kRod + "[support]\nfrequency = 3\nwaveform = \"square_acceleration\"\nphase = \"30 deg\"\n");
  written("[mathieu]\na = 0.1\nq = 1e22\n");
  written("[hill]\nperiod = 3.3\nwaveform = \"square\"\namplitude = -1\n");
  written("[hill]\nperiod = 3.3\n");
  written(
      "[linear]\nperiod = 2\nmass = [[2]]\nstiffness = { mean = [[1]], harmonics = [{ order = 1, cos = "
      "[[0.1]] }] }\n"
      "damping = { mean = [[-0.5]] }\n");
  CHECK(contains(
      written(kShaken + "[chart]\nx = { parameter = \"support.frequency\", from = 0.1, to = 30, points = 5, "
                        "scale = \"log\" }\nlayers = [\"growth\"]\ntolerance = 1e-7\n"),
      "x = { parameter = \"support.frequency\", from = 0.1, to = 30.0, points = 5, scale = \"log\" }\n"));
}

TEST_CASE("a scene file that cannot be read is an input/output error", "[io][scene_file]") {
  const ScratchDirectory directory;
  CHECK_THROWS_AS(read_scene(directory / "missing.toml"), InputOutputError);
  CHECK_THROWS_AS(read_scene(directory.path()), InputOutputError);
  const auto large = directory.with("large.toml", std::string((1 << 20) + 1, '#'));
  CHECK(contains(message_of<FileError>([&] { read_scene(large); }),
                 "large.toml: the file is larger than 1 MiB"));
}

}  // namespace strutt::test::scene_file_test
