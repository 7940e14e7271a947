// Scenes and tables the program must refuse (exit 3) or accept, through the program itself.
#include <catch2/catch.hpp>

#include "io/scratch.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"

namespace strutt::test::bad_input_test {
namespace {

constexpr int kFileError = 3;
const std::string kMathieu = "[mathieu]\nepsilon = 0.5\n";

/// A directory with a scene, a table and an old result.
class Room {
 public:
  Room(const std::string& scene, const std::string& table) {
    directory_.with("scene.toml", scene);
    directory_.with("in.csv", table);
    directory_.with("out.csv", kOld);
  }

  /// Runs the program, which must refuse its input, say why in one line and leave every file as it was.
  std::string refusal(const std::vector<std::string>& arguments, int code) const {
    const Result result = strutt(arguments, {.directory = directory_.path()});
    CHECK(result.code == code);
    CHECK(result.out.empty());
    CHECK(result.err.starts_with("strutt: error: "));
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK(directory_.names().size() == 3);
    CHECK(content_of(directory_ / "out.csv") == kOld);
    return result.err;
  }

  Result run(const std::vector<std::string>& arguments,
             const std::vector<std::string>& environment = {}) const {
    return strutt(arguments, {.environment = environment, .directory = directory_.path()});
  }

 private:
  static constexpr const char* kOld = "an old result\n";
  ScratchDirectory directory_;
};

struct Case {
  std::string text;
  std::vector<std::string> says;
};

void check_says(const std::string& message, const std::vector<std::string>& parts) {
  for (const auto& part : parts) CHECK_THAT(message, Catch::Matchers::Contains(part));
}

std::string pendulum(const std::string& lines, const std::string& support = "frequency = 12\n") {
  return "[pendulum]\n" + lines + "[support]\n" + support;
}

std::string with_chart(const std::string& x) {
  return kMathieu + "[chart]\nx = " + x +
         "\ny = { parameter = \"mathieu.epsilon\", from = 0, to = 1, points = 2 }\n";
}

}  // namespace

TEST_CASE("a scene that is wrong is refused with its place and the reason", "[apps][bad_input]") {
  const std::vector<Case> cases{
      {"[mathieu\ndelta = 1\n", {"scene.toml:1:"}},
      {"[mathieu]\ndelta = \n", {"scene.toml:2:"}},
      {"[mathieu]\ndelta = 1\ndelta = 2\n", {"scene.toml:3:"}},
      {"[mathieu]\ndleta = 1\n", {"scene.toml:2:1", "'dleta'", "did you mean 'delta'?"}},
      {"[mathiue]\n", {"scene.toml:1:", "[mathiue]", "did you mean [mathieu]?"}},
      {"[mathieu]\ndelta = \"one\"\n", {"scene.toml:2:9", "mathieu.delta"}},
      {"[mathieu]\ndelta = true\n", {"scene.toml:2:9", "mathieu.delta", "not a boolean"}},
      {"[mathieu]\ndelta = [1]\n", {"scene.toml:2:9", "not a list"}},
      {"[mathieu]\ndelta = 1979-05-27\n", {"scene.toml:2:9", "not a date"}},
      {"[mathieu]\ndelta = nan\n", {"scene.toml:2:9", "mathieu.delta", "finite"}},
      {"[mathieu]\ndelta = -inf\n", {"scene.toml:2:9", "mathieu.delta", "finite"}},
      {"[mathieu]\ndelta = 1e999\n", {"scene.toml:2:9", "mathieu.delta"}},
      {"[mathieu]\ndelta = 1,5\n", {"scene.toml:2:"}},
      {"[mathieu]\ndamping = -0.1\n", {"scene.toml:2:11", "mathieu.damping = -0.1", ">= 0"}},
      {"[mathieu]\na = 1\ndelta = 1\n", {"exclude each other"}},
      {pendulum("length = 0\n"), {"scene.toml:2:10", "pendulum.length = 0", "> 0"}},
      {pendulum("length = -1\n"), {"scene.toml:2:10", "pendulum.length = -1", "> 0"}},
      {pendulum("length = \"1 s\"\n"), {"scene.toml:2:10", "wrong dimension"}},
      {pendulum("shape = \"rod\"\n"), {"pendulum.length is missing"}},
      {pendulum("length = 1\ngravity = 0\n"), {"scene.toml:3:11", "pendulum.gravity = 0", "> 0"}},
      {pendulum("length = 1\ngravity = -9.81\n"), {"scene.toml:3:11", "pendulum.gravity"}},
      {pendulum("length = 1\nshape = \"rot\"\n"), {"scene.toml:3:9", "'rot'", "did you mean 'rod'?"}},
      {pendulum("length = 1\n", "frequency = 0\n"), {"scene.toml:4:13", "support.frequency = 0", "> 0"}},
      {pendulum("length = 1\n", "frequency = \"-2 Hz\"\n"), {"scene.toml:4:13", "support.frequency"}},
      {pendulum("length = 1\n", "amplitude = 0.1\n"), {"support.frequency is missing"}},
      {pendulum("length = 1\n", "frequency = 1\nsamples = \"none.csv\"\n"), {"none.csv"}},
      {"[hill]\nperiod = 0\n", {"scene.toml:2:10", "hill.period = 0", "> 0"}},
      {"[hill]\nmean = 1\n", {"hill.period is missing"}},
      {"[linear]\nperiod = -1\nstiffness = { mean = [[1]] }\n", {"scene.toml:2:10", "linear.period"}},
      {"[linear]\nperiod = 1\nstiffness = { mean = [[1, 2]] }\n", {"scene.toml:3:", "square"}},
      {"[linear]\nperiod = 1\nmass = [[0]]\nstiffness = { mean = [[1]] }\n", {"linear.mass", "invertible"}},
      // Not in anybody's list:
      {"", {"scene.toml:1:1", "no model"}},
      {"\n# nothing\n", {"no model"}},
      {"[mathieu]\n[hill]\nperiod = 1\n", {"scene.toml:2:", "[mathieu] and [hill]"}},
      {"[mathieu]\n[support]\nfrequency = 1\n", {"scene.toml:2:", "[support] goes with [pendulum] only"}},
      {"[mathieu]\ndelta = " + std::string(5000, '[') + "\n", {"scene.toml:2:", "nesting"}},
      {std::string("[mathieu]\ndel\0ta = 1\n", 22), {"scene.toml:2:4", "0x00"}},
      {"[mathieu]\n# \xFF\n", {"scene.toml:2:3"}},
      {"[mathieu]\n\x1B[31mdelta = 1\n", {"scene.toml:2:1", "0x1B"}},
      {std::string(2'000'000, '#'), {"larger than 1 MiB"}},
      {pendulum("length = 1\n", "frequency = 1e-300\n"), {"scene.toml:3:1: [support]", "finite"}},
      {pendulum("length = 1e-300\n"), {"scene.toml:1:1: [pendulum]", "inertia"}},
      {"mathieu = 3\n", {"scene.toml:1:", "mathieu must be a table"}},
      {"[hill]\nperiod = 1\nharmonics = [{ order = 0, cos = 1 }]\n", {"scene.toml:3:", "order", "from 1 to"}},
      {"[hill]\nperiod = 1\nharmonics = [{ order = 1 }, { order = 1 }]\n",
       {"scene.toml:3:", "order 1 twice"}},
  };
  for (const auto& [text, says] : cases) {
    INFO(text.substr(0, 200));
    const Room room(text, "");
    const bool missing_file = text.find("none.csv") != std::string::npos;
    check_says(room.refusal({"stability", "scene.toml", "-o", "out.csv"}, missing_file ? 5 : kFileError),
               says);
  }
}

TEST_CASE("a table [chart] that is wrong is refused as part of the scene", "[apps][bad_input]") {
  const std::vector<Case> cases{
      {with_chart("{ parameter = \"mathieu.delta\", from = 1, to = 1, points = 5 }"),
       {"scene.toml", "empty"}},
      {with_chart("{ parameter = \"mathieu.delta\", from = -1, to = 1, points = 5, scale = \"log\" }"),
       {"scene.toml", "logarithmic"}},
      {with_chart("{ parameter = \"mathieu.delta\", from = nan, to = 1, points = 5 }"),
       {"scene.toml:4:", "finite"}},
      {with_chart("{ parameter = \"mathieu.delta\", from = 0, to = 1, points = 0 }"),
       {"scene.toml:4:", "points"}},
      {with_chart("{ parameter = \"mathieu.delta\", from = 0, to = 1, points = 2.5 }"),
       {"scene.toml:4:", "integer"}},
      {with_chart("{ parameter = \"mathieu.dleta\", from = 0, to = 1, points = 5 }"),
       {"scene.toml:4:", "did you mean 'mathieu.delta'?"}},
      {with_chart("{ parameter = \"mathieu.epsilon\", from = 0, to = 1, points = 5 }"),
       {"scene.toml", "the same parameter"}},
      {with_chart("{ parameter = \"mathieu.damping\", from = -1, to = 1, points = 5 }"),
       {"scene.toml", ">= 0"}},
      {with_chart("{ parameter = \"mathieu.delta\", from = 0, to = 1, points = 5 }") +
           "layers = [\"grwth\"]\n",
       {"scene.toml:6:", "grwth", "growth"}},
      {with_chart("{ parameter = \"mathieu.delta\", from = 0, to = 1, points = 5 }") + "tolerance = 1\n",
       {"scene.toml:6:", "tolerance"}},
  };
  for (const auto& [text, says] : cases) {
    INFO(text);
    check_says(Room(text, "").refusal({"chart", "scene.toml", "-o", "out.csv"}, kFileError), says);
  }
}

TEST_CASE("a table of points that is wrong is refused with line and column", "[apps][bad_input]") {
  const std::string head = "mathieu.delta,mathieu.epsilon\n";
  const std::vector<Case> cases{
      {head + "1,2\n1\n", {"in.csv:3:", "1 cells", "the header 2"}},
      {head + "1,2,3\n", {"in.csv:2:5", "3 cells"}},
      {"mathieu.delta,mathieu.epislon\n1,2\n", {"in.csv:1:15", "did you mean 'mathieu.epsilon'?"}},
      {"mathieu.delta,mathieu.delta\n1,2\n", {"in.csv:1:15", "second time"}},
      {head + "1,\n", {"in.csv:2:3", "empty cell", "mathieu.epsilon"}},
      {head + "1,nan\n", {"in.csv:2:3", "'nan'"}},
      {head + "1,2\n-inf,1\n", {"in.csv:3:1", "'-inf'"}},
      {head + "1e999,1\n", {"in.csv:2:1", "'1e999'"}},
      {head + "0x10,1\n", {"in.csv:2:1", "'0x10'"}},
      {"mathieu.damping\n0\n-1\n", {"in.csv:3:1: mathieu.damping = -1", ">= 0"}},
      {"mathieu.delta,mathieu.damping\n1,0\n1, -1\n", {"in.csv:3:4: mathieu.damping = -1", ">= 0"}},
      // Not in anybody's list:
      {"", {"in.csv:1:1", "empty"}},
      {"\xEF\xBB\xBF", {"in.csv:1:1", "empty"}},
      {head, {"in.csv:1", "no rows"}},
      {head + "1,2\n\n3,4\n", {"in.csv:3:1", "blank line"}},
      {head + "1;5,2\n", {"in.csv:2:1", "'1;5'"}},
      {head + "\"1\",2\n", {"in.csv:2:1", "quotation marks"}},
      {head + "1,2 m\n", {"in.csv:2:3", "'2 m'"}},
      {head + std::string("1,\0\n", 4), {"in.csv:2:3", "0x00"}},
      {"mathieu.delta,\n1,2\n", {"in.csv:1:15", "no name"}},
      {"verdict\nstable\n", {"in.csv:1:1", "unknown column 'verdict'"}},
      {"pendulum.length\n1\n", {"in.csv:1:1", "unknown column"}},
      {head + "1,\xC3\x28\n", {"in.csv:2:3"}},
  };
  for (const auto& [text, says] : cases) {
    INFO(text);
    const Room room(kMathieu, text);
    check_says(room.refusal({"stability", "scene.toml", "--points", "in.csv", "-o", "out.csv"}, kFileError),
               says);
  }
}

TEST_CASE("a value that the model cannot have is refused with line and column", "[apps][bad_input]") {
  const std::string body = "[pendulum]\nshape = \"body\"\ncentroid = 0.5\ninertia = 0.4\n";
  const std::string linear =
      "[linear]\nperiod = 1\nmass = [[1, 0], [0, 1]]\nstiffness = { mean = [[1, 0], [0, 2]] }\n";
  struct Point {
    std::string scene, table, says;
  };
  const std::vector<Point> points{
      {pendulum("length = 1\n"), "pendulum.length,support.frequency\n1,12\n1.25,0\n",
       "in.csv:3:6: support.frequency = 0"},
      {pendulum("length = 1\n"), "support.frequency,pendulum.damping\n# a remark\n 12 , -0.5\n",
       "in.csv:3:7: pendulum.damping = -0.5"},
      {pendulum("length = 1\n"), "support.amplitude,pendulum.length [cm]\n0,-7\n",
       "in.csv:2:3: pendulum.length = -0.07"},
      {linear, "linear.period,linear.mass.1.1\n10,0\n", "in.csv:2:4: linear.mass = matrix"},
      // It is the inertia in the scene that is too small for the centroid of the row.
      {body, "pendulum.gravity,pendulum.centroid\n9,0.5\n9,2\n", "in.csv:3:1: pendulum.inertia"}};
  for (const auto& [scene, table, says] : points) {
    INFO(table);
    check_says(Room(scene, table)
                   .refusal({"stability", "scene.toml", "--points", "in.csv", "-o", "out.csv"}, kFileError),
               {says});
  }
}

TEST_CASE("a table of times that is wrong is refused with line and column", "[apps][bad_input]") {
  const std::vector<Case> cases{{"time\n1\n", {"in.csv:1:1", "unknown column 'time'"}},
                                {"t\n1\n  -1e-9\n", {"in.csv:3:3", "t = -1e-09", ">= 0"}},
                                {"t,t\n1,2\n", {"in.csv:1:3", "second time"}},
                                {"t [kg]\n1\n", {"in.csv:1:1", "wrong dimension"}},
                                {"t\n", {"no rows"}}};
  for (const auto& [text, says] : cases) {
    INFO(text);
    const Room room(pendulum("length = 1\n"), text);
    check_says(room.refusal({"motion", "scene.toml", "--angle", "1", "--velocity", "0", "--times", "in.csv",
                             "-o", "out.csv"},
                            kFileError),
               says);
  }
}

TEST_CASE("motion wants a pendulum", "[apps][bad_input]") {
  check_says(Room(kMathieu, "")
                 .refusal({"motion", "scene.toml", "--angle", "1", "--velocity", "0", "--duration", "1",
                           "--samples", "3"},
                          kFileError),
             {"scene.toml", "[pendulum]"});
}

TEST_CASE("harmless varieties of a scene mean the same", "[apps][bad_input]") {
  const auto answer = [](const std::string& scene, const std::vector<std::string>& environment = {}) {
    const Result result = Room(scene, "").run({"stability", "scene.toml"}, environment);
    CHECK(result.code == 0);
    CHECK(result.err == "");
    return csv_rows(result.out).at(1);
  };
  const auto plain = answer("[mathieu]\ndelta = 2.0\nepsilon = 0.5\n");
  CHECK(answer("\xEF\xBB\xBF[mathieu]\ndelta = 2.0\nepsilon = 0.5\n") == plain);
  CHECK(answer("[mathieu]\r\ndelta = 2.0\r\nepsilon = 0.5\r\n") == plain);
  CHECK(answer("[mathieu]\ndelta = 2.0\nepsilon = 0.5") == plain);
  CHECK(answer("[mathieu]\ndelta = 2\nepsilon = 5e-1\n") == plain);
  CHECK(answer("mathieu = { delta = 2, epsilon = 0.5 }") == plain);
  CHECK(answer("[mathieu]\ndelta = 2." + std::string(300, '0') + "1\nepsilon = 0.5\n") == plain);
  CHECK(answer("[mathieu]\ndelta = 1." + std::string(300, '9') + "\nepsilon = 0.5\n") == plain);
  CHECK(answer("[mathieu]\ndelta = 2.0\nepsilon = 0.5\n",
               {"LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8", "LOCPATH=" + locales_directory()}) == plain);
}

TEST_CASE("harmless varieties of a table mean the same", "[apps][bad_input]") {
  const auto answer = [](const std::string& table) {
    const Result result =
        Room(kMathieu, table).run({"stability", "scene.toml", "--points", "in.csv", "--quiet"});
    INFO(table << result.err);
    CHECK(result.code == 0);
    return csv_rows(result.out);
  };
  const auto plain = answer("mathieu.delta,mathieu.epsilon\n2,0.5\n3,0.25\n");
  REQUIRE(plain.size() == 3);
  for (const std::string table :
       {"\xEF\xBB\xBFmathieu.delta,mathieu.epsilon\n2,0.5\n3,0.25\n",
        "mathieu.delta,mathieu.epsilon\r\n2,0.5\r\n3,0.25\r\n",
        "mathieu.delta,mathieu.epsilon\n2,0.5\n3,0.25", "mathieu.delta,mathieu.epsilon\n2,0.5\n3,0.25\n\n",
        "mathieu.delta [1],mathieu.epsilon [1]\n2,0.5\n3,0.25\n",
        "# a remark\nmathieu.delta, mathieu.epsilon\n+2.0,5e-1\n# another\n 3 , .25\n"}) {
    CHECK(answer(table) == plain);
  }
  CHECK(answer("mathieu.delta,mathieu.epsilon\n1." + std::string(300, '9') + ",0.5" + std::string(300, '0') +
               "\n3,0.25\n") == plain);
}

TEST_CASE("the unit of a column is taken for what it says", "[apps][bad_input]") {
  const std::vector<std::string> command{"stability", "scene.toml", "--points", "in.csv", "--quiet"};
  const auto rows = [&](const std::string& table) {
    const Result result = Room(pendulum("length = 1\n"), table).run(command);
    CHECK(result.code == 0);
    return csv_rows(result.out);
  };
  CHECK(rows("pendulum.length [cm],support.frequency [rad/s]\n7,12\n") ==
        rows("pendulum.length [m],support.frequency\n0.07,12\n"));
  check_says(Room(pendulum("length = 1\n"), "pendulum.length [s]\n7\n").refusal(command, kFileError),
             {"in.csv:1:1", "pendulum.length", "wrong dimension"});
  check_says(Room(pendulum("length = 1\n"), "pendulum.length [parsec]\n7\n").refusal(command, kFileError),
             {"in.csv:1:1", "pendulum.length", "unknown unit 'parsec'"});
}

}  // namespace strutt::test::bad_input_test
