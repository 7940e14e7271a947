// What is wrong in a scene is refused with its place and the reason.
#include <catch2/catch.hpp>

#include "io/scene_text.hpp"

namespace strutt::test::scene_mistakes_test {

namespace {

using test::complaint;
using test::contains;
using test::kRod;
using test::kShaken;

}  // namespace

TEST_CASE("mistakes in a chart table are located", "[io][scene_file]") {
  const auto chart = [](const std::string& rest) { return complaint("[mathieu]\n[chart]\n" + rest + "\n"); };
  const std::string delta = "x = { parameter = \"mathieu.delta\", from = 0, to = 1";
  CHECK(contains(
      chart("x = { parameter = \"mathieu.delt\", from = 0, to = 1 }"),
      "s.toml:3:19: unknown parameter 'mathieu.delt' for this scene; did you mean 'mathieu.delta'?"));
  CHECK(contains(chart(delta + ", points = 0 }"), "s.toml:3:63: chart.x.points = 0 is not allowed"));
  CHECK(contains(chart(delta + ", points = 1.5 }"), "chart.x.points must be an integer"));
  CHECK(contains(chart(delta + ", scale = \"log\" }"), "s.toml:3:43: "));
  CHECK(contains(chart(delta + ", scale = \"lag\" }"), "did you mean 'log'?"));
  CHECK(contains(chart(delta + ", steps = 3 }"), "unknown key 'steps' in [chart.x]"));
  CHECK(contains(chart("x = { parameter = \"mathieu.delta\", from = 0 }"),
                 "s.toml:3:5: chart.x.to is missing"));
  CHECK(contains(chart("x = { parameter = \"mathieu.damping\", from = -1, to = 1 }"),
                 "s.toml:3:45: mathieu.damping = -1 is not allowed"));
  CHECK(contains(chart("x = { parameter = \"mathieu.delta\", from = \"1 m\", to = 1 }"), "takes no unit"));
  CHECK(contains(chart("layers = [\"verdict\", \"verdict\"]"),
                 "s.toml:3:22: chart.layers has 'verdict' twice"));
  CHECK(contains(chart("layers = [\"verdcit\"]"), "s.toml:3:11: "));
  CHECK(contains(chart("layers = []"), "chart.layers is empty"));
  CHECK(contains(chart("layers = \"verdict\""), "chart.layers must be a list, not a text"));
  CHECK(contains(chart("tolerance = 1e-14"), "s.toml:3:13: chart.tolerance = 1e-14 is not allowed"));
  CHECK(contains(chart(delta + " }\ny" + delta.substr(1) + " }"), "are the same parameter 'mathieu.delta'"));
}

TEST_CASE("unknown keys and tables are named with the nearest known one", "[io][scene_file][F1]") {
  CHECK(complaint("[pendulum]\nlenght = 1\n") ==
        "s.toml:2:1: unknown key 'lenght' in [pendulum]; did you mean 'length'?");
  CHECK(complaint("[pendulm]\nlength = 1\n") ==
        "s.toml:1:2: unknown table [pendulm]; did you mean [pendulum]?");
  CHECK(complaint("length = 1\n" + kRod) ==
        "s.toml:1:1: unknown key 'length' outside the tables; the tables are 'pendulum', 'support', "
        "'moment', 'mathieu', "
        "'hill', 'linear', 'chart'");
  CHECK(complaint(kRod + "[support]\nfrequency = 1\nharmonics = [{ ordr = 1 }]\n") ==
        "s.toml:5:16: unknown key 'ordr' in [support.harmonics]; did you mean 'order'?");
  CHECK(complaint("[pendulum]\nshape = \"rodd\"\n") ==
        "s.toml:2:9: pendulum.shape = 'rodd' is not known; did you mean 'rod'?");
  CHECK(complaint("[pendulum]\nlength = 1\n\"a\\u001b[31m\" = 1\n") ==
        "s.toml:3:1: unknown key 'a\\x1B[31m' in [pendulum]; known are 'shape', 'mass', 'length', 'inertia', "
        "'centroid', "
        "'gravity', 'damping', 'about'");
}

TEST_CASE("values out of range are named with the range", "[io][scene_file]") {
  CHECK(complaint("[pendulum]\nlength = -1\n") ==
        "s.toml:2:10: pendulum.length = -1 is not allowed: it must be a finite number > 0");
  CHECK(contains(complaint("[pendulum]\nlength = 0\n"), "s.toml:2:10: "));
  CHECK(contains(complaint(kRod + "mass = 0\n"), "s.toml:3:8: pendulum.mass = 0"));
  CHECK(contains(complaint(kRod + "gravity = 0.0\n"), "s.toml:3:11: pendulum.gravity = 0"));
  CHECK(contains(complaint(kRod + "damping = -1e-9\n"), "s.toml:3:11: pendulum.damping = -1e-09"));
  CHECK(contains(complaint(kRod + "[support]\nfrequency = 0\n"), "s.toml:4:13: support.frequency = 0"));
  CHECK(contains(complaint("[hill]\nperiod = -2\n"), "s.toml:2:10: hill.period = -2"));
  CHECK(contains(complaint("[mathieu]\ndamping = -2\n"), "s.toml:2:11: mathieu.damping = -2"));
  CHECK(contains(complaint("[pendulum]\nshape = \"body\"\ncentroid = 1\ninertia = 0.1\n"),
                 "s.toml:4:11: pendulum.inertia = 0.1 is not allowed"));
}

TEST_CASE("values that make no equation together are named with their table", "[io][scene_file]") {
  CHECK(contains(complaint("[pendulum]\nlength = 1e-300\n"),
                 "s.toml:1:1: [pendulum]: inertia = 0 is not allowed"));
  CHECK(contains(complaint("[pendulum]\nlength = 1\n\n[support]\nfrequency = 1e-300\n"),
                 "s.toml:4:1: [support]: "));
  CHECK(contains(complaint("# slow\n[hill]\nperiod = 1e-320\n"),
                 "s.toml:2:1: [hill]: angular frequency = inf"));
}

TEST_CASE("numbers that are none are refused", "[io][scene_file]") {
  const auto length = [](const std::string& value) {
    return complaint("[pendulum]\nlength = " + value + "\n");
  };
  CHECK(contains(length("nan"), "s.toml:2:10: pendulum.length = nan is not allowed"));
  CHECK(contains(length("-inf"), "s.toml:2:10: pendulum.length = -inf is not allowed"));
  CHECK(length("1e999") == "s.toml:2:10: pendulum.length is beyond the range of double");
  CHECK(length("true") ==
        "s.toml:2:10: pendulum.length must be a number or a text with a unit, not a boolean");
  CHECK(contains(length("[1]"), "not a list"));
  CHECK(contains(length("1979-05-27"), "not a date or time"));
  CHECK(contains(length("\"nan\""), "'nan' is not a finite decimal number"));
  CHECK(contains(length("\"1 s\""),
                 "s.toml:2:10: pendulum.length: '1 s': the unit 's' has the wrong dimension"));
  CHECK(contains(length("1,5"), "s.toml:2:"));
  CHECK(contains(length("0x1p3"), "s.toml:2:"));
}

TEST_CASE("what is missing or does not go together is located", "[io][scene_file]") {
  CHECK(complaint("[pendulum]\n") == "s.toml:1:1: pendulum.length is missing");
  CHECK(complaint("[pendulum]\nshape = \"body\"\ninertia = 1\n") ==
        "s.toml:1:1: pendulum.centroid is missing");
  CHECK(complaint(kRod + "[support]\n") == "s.toml:3:1: support.frequency is missing");
  CHECK(complaint("[hill]\n") == "s.toml:1:1: hill.period is missing");
  CHECK(complaint(kRod + "inertia = 1\n") == "s.toml:3:11: pendulum.inertia goes with shape = \"body\" only");
  CHECK(complaint("") == "s.toml:1:1: there is no model: one of [pendulum], [mathieu], [hill], [linear]");
  CHECK(contains(complaint("[hill]\nperiod = 1\n[mathieu]\n"), "exclude each other: a scene has one model"));
  CHECK(complaint("[mathieu]\n[support]\nfrequency = 1\n") ==
        "s.toml:2:1: [support] goes with [pendulum] only");
  CHECK(complaint("pendulum = 3\n") == "s.toml:1:12: pendulum must be a table, not a number");
  for (const std::string form : {"harmonics = [{ order = 1 }]", "samples = [0.1]"}) {
    for (const std::string key : {"amplitude = 1", "phase = 1", "waveform = \"square_acceleration\""}) {
      CHECK(contains(complaint(kShaken + form + "\n" + key + "\n"), "s.toml:6:"));
    }
  }
  CHECK(contains(complaint(kShaken + "samples = [1]\nharmonics = []\n"), "exclude each other"));
}

TEST_CASE("harmonic orders are integers from 1, each once", "[io][scene_file]") {
  const auto harmonics = [](const std::string& list) {
    return complaint(kShaken + "harmonics = [" + list + "]\n");
  };
  CHECK(harmonics("{ order = 1 }, { order = 1 }") == "s.toml:5:39: support.harmonics has order 1 twice");
  CHECK(contains(harmonics("{ order = 0 }"), "support.harmonics.order = 0 is not allowed"));
  CHECK(contains(harmonics("{ order = 10001 }"), "an integer from 1 to 10000"));
  CHECK(contains(harmonics("{ order = 1.0 }"), "must be an integer"));
  CHECK(contains(harmonics("{ cos = 1.0 }"), "support.harmonics.order is missing"));
  CHECK(contains(harmonics("1"), "support.harmonics must be a table, not a number"));
}

TEST_CASE("malformed TOML is located", "[io][scene_file][F1]") {
  const std::string text = GENERATE(
      "[pendulum\nlength = 1\n", "[pendulum]\nlength = \n", "[pendulum]\nlength 1\n",
      "[pendulum]\nlength = \"1 m\n", "[pendulum]\nlength = 1\nlength = 2\n",
      "[pendulum]\nlength = 1\n[pendulum]\n", "[pendulum]\nlength = 01.5\n", "[pendulum]\nlength = .5\n",
      "[pendulum]\nlength = 1.\n", "[", "\"", "[pendulum]\nlength = [1, \n");
  const auto message = complaint(text);
  CHECK(message.starts_with("s.toml:"));
  CHECK(message.find_first_of("0123456789") == 7);
}

TEST_CASE("hostile texts are refused before they are parsed", "[io][scene_file][F2]") {
  const std::string deep(100'000, '[');
  CHECK(contains(complaint("a = " + deep), "s.toml:1:37: nesting is deeper than 32 levels"));
  CHECK(contains(complaint(deep), "nesting is deeper than 32 levels"));
  std::string dotted = "a";
  for (int i = 0; i < 100'000; ++i) dotted += ".a";
  CHECK(contains(complaint(dotted + " = 1\n"), "nesting is deeper"));
  CHECK(contains(complaint("[" + dotted + "]\n"), "nesting is deeper"));
  CHECK(contains(complaint("x = { " + dotted + " = 1 }\n"), "nesting is deeper"));
  std::string braces = "x = ";
  for (int i = 0; i < 100'000; ++i) braces += "{a=";
  CHECK(contains(complaint(braces), "nesting is deeper"));
  CHECK(contains(complaint(kRod + "#" + std::string(1 << 20, ' ')), "larger than 1 MiB"));
  CHECK(contains(complaint("[\x01"), "s.toml:1:2: the control character 0x01"));
  CHECK(contains(complaint("# \xff\n"), "s.toml:1:3: the byte 0xFF"));
  CHECK(contains(complaint(std::string("a\0b", 3)), "s.toml:1:2: the control character 0x00"));
  CHECK(contains(complaint("a = 1\rb = 2"), "s.toml:1:6: the control character 0x0D"));
}

TEST_CASE("positions after long numbers and wide characters are right", "[io][scene_file]") {
  const std::string text = "[hill]\nmean = 0." + std::string(300, '1') +
                           " # \xC3\xA9\xC3\xA9\nperiod = { a = 0.25, \"\xC3\xA9\" = 0.5 }\n";
  CHECK(contains(complaint(text), "s.toml:3:10: "));
  CHECK(contains(
      complaint("[hill]\nperiod = 1\nharmonics = [{ order = 1, cos = 0.12345678901234567890, sin = nan }]\n"),
      "s.toml:3:63: hill.harmonics.1.sin = nan"));
}

}  // namespace strutt::test::scene_mistakes_test
