// Flags the program must refuse (exit 2), its help, and the plan it prints.
#include <catch2/catch.hpp>
#include <fstream>
#include <regex>

#include "io/scratch.hpp"
#include "support/paths.hpp"
#include "support/program.hpp"

namespace strutt::test::command_line_test {
namespace {

using Words = std::vector<std::string>;
const std::string kPendulum = "[pendulum]\nlength = 1\n[support]\nfrequency = 12\n";

/// A directory with scenes of two kinds and an old result.
struct Room {
  ScratchDirectory directory;

  Room() {
    directory.with("m.toml", "[mathieu]\nepsilon = 0.5\n");
    directory.with("p.toml", kPendulum);
    directory.with("out.csv", "an old result\n");
    std::filesystem::create_directory(directory / "dir.csv");
  }

  Result run(const Words& arguments) const { return strutt(arguments, {.directory = directory.path()}); }

  /// The command must end with `code` and one line of `says`, and touch nothing.
  void refuses(const Words& arguments, int code, const Words& says) const {
    std::string command;
    for (const auto& word : arguments) command += " " + word;
    INFO(command);
    const Result result = run(arguments);
    CHECK(result.code == code);
    CHECK(result.out.empty());
    CHECK(result.err.starts_with("strutt: error: "));
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    for (const auto& part : says) CHECK_THAT(result.err, Catch::Matchers::Contains(part));
    CHECK(directory.names().size() == 4);
    CHECK(content_of(directory / "out.csv") == "an old result\n");
  }
};

const Words kAxes{"--x", "mathieu.delta=-1:5:3", "--y", "mathieu.epsilon=0:6:2"};

Words chart(const Words& more) {
  Words words{"chart", "m.toml", "-o", "out.csv"};
  words.insert(words.end(), kAxes.begin(), kAxes.end());
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Words with_x(const std::string& x) {
  return {"chart", "m.toml", "-o", "out.csv", "--x", x, "--y", "mathieu.epsilon=0:6:2"};
}

Words motion(const Words& more) {
  Words words{"motion", "p.toml", "-o", "out.csv", "--angle", "1", "--velocity", "0"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_CASE("commands and flags that do not exist are refused with the nearest one", "[apps][command_line]") {
  const Room room;
  room.refuses({}, 2, {"no command", "chart, stability, motion"});
  room.refuses({"chrat"}, 2, {"'chrat'", "did you mean 'chart'?"});
  room.refuses({"xyzzy"}, 2, {"the commands are"});
  room.refuses({"--chart"}, 2, {"unknown flag '--chart'"});
  room.refuses({"chart"}, 2, {"scene"});
  room.refuses(chart({"--laysers", "growth"}), 2, {"did you mean '--layers'?"});
  room.refuses(chart({"--points", "in.csv"}), 2, {"'--points'"});
  room.refuses(chart({"another.toml"}), 2, {"'another.toml'"});
  room.refuses(chart({"--threads"}), 2, {"--threads"});
  room.refuses(chart({"--threads", "2", "--threads", "3"}), 2, {"--threads"});
}

TEST_CASE("axes of flags that make no sense are refused", "[apps][command_line]") {
  const Room room;
  room.refuses({"chart", "m.toml"}, 2, {"the x axis is missing"});
  room.refuses(with_x("mathieu.delta"), 2, {"P=FROM:TO:N"});
  room.refuses(with_x("mathieu.delta=1:2"), 2, {"P=FROM:TO:N"});
  room.refuses(with_x("mathieu.delta=1:2:3:cube"), 2, {"P=FROM:TO:N"});
  room.refuses(with_x("mathieu.dleta=1:2:3"), 2, {"--x", "did you mean 'mathieu.delta'?"});
  room.refuses(with_x("pendulum.length=1:2:3"), 2, {"--x", "pendulum.length"});
  room.refuses(with_x("mathieu.epsilon=1:2:3"), 2, {"different from that of the x axis"});
  room.refuses(with_x("mathieu.delta=1:1:3"), 2, {"empty"});
  room.refuses(with_x("mathieu.delta=1:2:1"), 2, {"one point"});
  room.refuses(with_x("mathieu.delta=1:2:0"), 2, {"--x: ", "'0'", "from 1"});
  room.refuses(with_x("mathieu.delta=1:2:-3"), 2, {"'-3'"});
  room.refuses(with_x("mathieu.delta=1:2:1e3"), 2, {"'1e3'"});
  room.refuses(with_x("mathieu.delta=nan:2:3"), 2, {"'nan'"});
  room.refuses(with_x("mathieu.delta=1:inf:3"), 2, {"'inf'"});
  room.refuses(with_x("mathieu.delta=1:1e999:3"), 2, {"'1e999'"});
  room.refuses(with_x("mathieu.delta=1,5:2:3"), 2, {"'1,5'"});
  room.refuses(with_x("mathieu.delta=-1:1:3:log"), 2, {"logarithmic"});
  room.refuses(with_x("mathieu.delta=0:1:3:log"), 2, {"logarithmic"});
  room.refuses(with_x("mathieu.delta=1 m:2 m:3"), 2, {"no dimension"});
  room.refuses(with_x("mathieu.damping=-1:1:3"), 2, {"mathieu.damping = -1", ">= 0"});
}

TEST_CASE("values of the common flags outside their range are refused", "[apps][command_line]") {
  const Room room;
  room.refuses(chart({"--threads", "0"}), 2, {"--threads", "from 1 to"});
  room.refuses(chart({"--threads", "two"}), 2, {"'two'"});
  room.refuses(chart({"--threads", "99999999999999999999"}), 2, {"--threads"});
  for (const char* wrong : {"0", "9e-14", "0.011", "-1e-9", "nan", "inf", "1e-9x", ""})
    room.refuses(chart({"--tolerance=" + std::string(wrong)}), 2, {"--tolerance"});
  room.refuses({"stability", "m.toml", "--tolerance", "1"}, 2, {"1e-13 to 0.01"});
  room.refuses(motion({"--duration", "1", "--samples", "2", "--tolerance", "1"}), 2, {"1e-13 to 0.01"});
  room.refuses(chart({"--method", "euler"}), 2, {"euler", "arkode"});
  room.refuses(chart({"--method", "fourier"}), 2, {"not available for chart"});
  room.refuses(chart({"--method", "exact"}), 2, {"piecewise-constant"});
  room.refuses({"stability", "m.toml", "--method", "exact"}, 2, {"--method exact"});
  room.refuses(chart({"--layers", "growth,growth"}), 2, {"growth", "only once"});
  room.refuses(chart({"--layers", "grwth"}), 2, {"--layers", "grwth", "growth"});
  room.refuses(chart({"--layers", "growth,"}), 2, {"--layers"});
}

TEST_CASE("a --set of what is not there or cannot be is refused", "[apps][command_line]") {
  const Room room;
  room.refuses(chart({"--set", "mathieu.dampin=1"}), 2, {"did you mean 'mathieu.damping'?"});
  room.refuses(chart({"--set", "support.frequency=1"}), 2, {"support.frequency"});
  room.refuses(chart({"--set", "mathieu.damping"}), 2, {"PATH=VALUE"});
  room.refuses(chart({"--set", "mathieu.damping=-1"}), 2, {"mathieu.damping = -1", ">= 0"});
  room.refuses(chart({"--set", "mathieu.damping=nan"}), 2, {"'nan'"});
  room.refuses(chart({"--set", "mathieu.damping="}), 2, {"''"});
  room.refuses({"stability", "p.toml", "--set", "support.frequency=1e-300"}, 2, {"--set", "finite"});
  room.refuses(motion({"--duration", "1", "--samples", "2", "--set", "pendulum.length=0 m"}), 2, {"> 0"});
  room.refuses(motion({"--duration", "1", "--samples", "2", "--set", "pendulum.length=3 s"}), 2,
               {"wrong dimension"});
}

TEST_CASE("times and starts of a motion that make no sense are refused", "[apps][command_line]") {
  const Room room;
  room.refuses(motion({}), 2, {"--duration and --samples, or --times"});
  room.refuses(motion({"--duration", "1"}), 2, {"--samples"});
  room.refuses(motion({"--duration", "1", "--samples", "0"}), 2, {"--samples", "'0'"});
  room.refuses(motion({"--duration", "1", "--samples", "1"}), 2, {"--samples = 1"});
  room.refuses(motion({"--duration", "0", "--samples", "2"}), 2, {"--duration = 0"});
  room.refuses(motion({"--duration", "-1", "--samples", "2"}), 2, {"--duration", ">= 0"});
  room.refuses(motion({"--duration", "1e400", "--samples", "2"}), 2, {"--duration"});
  room.refuses(motion({"--duration", "1", "--samples", "2", "--times", "t.csv"}), 2, {"--times excludes"});
  room.refuses({"motion", "p.toml", "--velocity", "0", "--duration", "1", "--samples", "2"}, 2, {"--angle"});
  room.refuses({"motion", "p.toml", "--angle", "1 m", "--velocity", "0", "--duration", "1", "--samples", "2"},
               2, {"--angle", "wrong dimension"});
  room.refuses({"motion", "p.toml", "--angle", "nan", "--velocity", "0", "--duration", "1", "--samples", "2"},
               2, {"--angle", "'nan'"});
  room.refuses({"motion", "p.toml", "--angle", "2e9", "--velocity", "0", "--duration", "1", "--samples", "2"},
               2, {"angle = 2e+09", "-1e9"});
  room.refuses({"motion", "p.toml", "--angle", "1", "--velocity", "inf", "--duration", "1", "--samples", "2"},
               2, {"--velocity", "'inf'"});
}

TEST_CASE("outputs that do not fit are refused", "[apps][command_line]") {
  const Room room;
  room.refuses({"chart", "m.toml", "-o", "c.xyz", kAxes[0], kAxes[1], kAxes[2], kAxes[3]}, 2,
               {"'c.xyz'", ".csv"});
  room.refuses({"chart", "m.toml", "-o", "c.npy", kAxes[0], kAxes[1], kAxes[2], kAxes[3]}, 2,
               {".npy", ".npz"});
  room.refuses({"chart", "m.toml", "-o", "c.h5", "--json", kAxes[0], kAxes[1], kAxes[2], kAxes[3]}, 2,
               {".json"});
  room.refuses(chart({"--figure", "c.jpg"}), 2, {"'c.jpg'", ".png"});
  room.refuses(chart({"--figure", "out.csv"}), 2, {"same file"});
  room.refuses({"chart", "m.toml", "-o", "dir.csv", kAxes[0], kAxes[1], kAxes[2], kAxes[3]}, 5,
               {"'dir.csv'", "Is a directory"});
  room.refuses({"stability", "m.toml", "-o", "dir.csv"}, 5, {"Is a directory"});
  room.refuses({"chart", "m.toml", "-o", ".", kAxes[0], kAxes[1], kAxes[2], kAxes[3]}, 2, {"format"});
  room.refuses({"stability", "m.toml", "-o", "s.h5"}, 2, {"'s.h5'", "CSV"});
  room.refuses({"stability", "m.toml", "-o", "s.json"}, 2, {"--json"});
  room.refuses({"period", "--amplitude", "1", "-o", "s.h5"}, 2, {"'s.h5'", "CSV"});
  room.refuses({"stability", "m.toml", "--json", "-o", "out.csv"}, 2, {"--json"});
  room.refuses({"stability", "-", "--points", "-"}, 2, {"--points", "standard input"});
  room.refuses({"motion", "-", "--angle", "1", "--velocity", "0", "--times", "-"}, 2,
               {"--times", "standard input"});
  room.refuses({"portrait", "-", "--starts", "-"}, 2, {"--starts", "standard input"});
  room.refuses({"period", "--scene", "-", "--points", "-"}, 2, {"--points", "standard input"});
}

TEST_CASE("a chart over the memory budget is refused before it begins", "[apps][command_line]") {
  const Room room;
  Words words{"chart", "m.toml",
              "-o",    "out.csv",
              "--x",   "mathieu.delta=-1:5:1000000",
              "--y",   "mathieu.epsilon=0:6:1000000"};
  room.refuses(words, 4, {"1000000 x 1000000", "budget", "--force"});
  room.refuses(motion({"--duration", "1", "--samples", "999999999999"}), 4, {"budget", "--force"});
  words.insert(words.end(), {"--force", "--dry-run"});
  CHECK(room.run(words).code == 0);
}

TEST_CASE("the plan is a scene that says the same again", "[apps][command_line]") {
  const Room room;
  const Result plan = room.run(chart({"--dry-run", "--set", "mathieu.damping=0.125", "--tolerance", "1e-7",
                                      "--layers", "margin", "--threads", "1"}));
  REQUIRE(plan.code == 0);
  for (const char* part :
       {"# model: Mathieu", "# cells: 6 (3 x 2)", "# memory: ", "# expected time: ", "# method: propagator",
        "# tolerance: 1e-07", "damping = 0.125", "layers = [\"margin\"]"}) {
    CHECK_THAT(plan.out, Catch::Matchers::Contains(part));
  }
  const Result again = strutt({"chart", "-", "--dry-run", "--threads", "1"}, {.input = plan.out});
  CHECK(again.out == plan.out);
  CHECK(content_of(room.directory / "out.csv") == "an old result\n");
  CHECK(strutt({"chart", "-"}, {.input = plan.out}).code == 0);
}

TEST_CASE("help and version go to standard output", "[apps][command_line]") {
  for (const Words& words :
       {Words{"--help"}, {"chart", "--help"}, {"stability", "-h"}, {"motion", "--help"}}) {
    const Result help = strutt(words);
    CHECK(help.code == 0);
    CHECK(help.err.empty());
    CHECK_THAT(help.out, Catch::Matchers::Contains("Exit codes: 0 done"));
  }
  const Result version = strutt({"--version"});
  CHECK(version.code == 0);
  CHECK(std::regex_match(version.out, std::regex("strutt [0-9]+\\.[0-9]+\\.[0-9]+ \\(SUNDIALS .*\\)\n")));
  CHECK(strutt({"chart", "--version"}).out == version.out);
}

TEST_CASE("the example in the help of every command works", "[apps][command_line]") {
  for (const std::string command : {"chart", "stability", "motion"}) {
    const std::string help = strutt({command, "--help"}).out;
    const auto begin = help.find("Example:\n");
    REQUIRE(begin != std::string::npos);
    const auto end = help.find("\n\n", begin);
    const ScratchDirectory directory;
    directory.with("example.sh", "set -e\nstrutt() { '" + program_path() + "' \"$@\"; }\n" +
                                     help.substr(begin + 9, end - begin - 9) + "\n");
    const std::string run = "cd '" + directory.path().string() + "' && sh example.sh > out.txt 2> err.txt";
    INFO(content_of(directory / "example.sh"));
    CHECK(std::system(run.c_str()) == 0);
    const auto rows = csv_rows(content_of(directory / (command == "chart" ? "chart.csv" : "out.txt")));
    CHECK(rows.size() == (command == "chart" ? 2401 : command == "stability" ? 3 : 22));
  }
}

}  // namespace strutt::test::command_line_test
