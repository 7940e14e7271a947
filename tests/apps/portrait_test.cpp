// The subcommand `portrait`, end to end.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/scratch.hpp"
#include "support/paths.hpp"

namespace strutt::test::portrait_test {

namespace {

using test::content_of;
using test::ScratchDirectory;

constexpr const char* kFree = "[pendulum]\nlength = 1.0\n";
constexpr const char* kExcited = "[pendulum]\nlength = 1.0\n[support]\nfrequency = 12.0\namplitude = 0.02\n";

struct Run {
  int code;
  std::string out, err;
};

/// Runs the program in the directory.
Run run(const ScratchDirectory& directory, const std::string& arguments) {
  const std::string command = "cd '" + directory.path().string() + "' && '" + test::program_path() + "' " +
                              arguments + " > .out 2> .err < /dev/null";
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), content_of(directory / ".out"), content_of(directory / ".err")};
}

/// Lines of a CSV text without those of the provenance.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("#")) lines.push_back(line);
  }
  return lines;
}

}  // namespace

TEST_CASE("portrait without a scene is that of alpha = 1", "[apps][portrait]") {
  const ScratchDirectory scratch;
  const Run done = run(scratch, "portrait --cells 1 --points 9 --curves 1 --quiet");
  CHECK(done.code == 0);
  CHECK(done.err.empty());
  CHECK(done.out.find("# units: 1,,1,rad,rad/s\n") != std::string::npos);
  CHECK(done.out.find("# command: strutt portrait --cells 1 --points 9 --curves 1\n") != std::string::npos);
  const auto lines = lines_of(done.out);
  CHECK(lines[0] == "curve,kind,separatrix_excess,angle,velocity");
  CHECK(lines[1] == "0,equilibrium,0,-3.141592653589793,0");
  CHECK(lines[2] == "1,equilibrium,-4,0,0");
  // 3 equilibria, 2 branches, 1 libration, 3 levels of rotations in two directions.
  CHECK(lines.size() == 1 + 3 + 2 * 9 + 9 + 6 * 9);
  CHECK(lines.back().starts_with("11,rotation,2.25,-3.14159265358979"));
}

TEST_CASE("portrait takes alpha from the scene, changed by --set", "[apps][portrait]") {
  const ScratchDirectory scratch;
  scratch.with("s.toml", kFree);
  const Run done =
      run(scratch, "portrait s.toml --set pendulum.length=14.715 --cells 1 --excesses 1 -o p.csv");
  CHECK(done.code == 0);  // 3 g/(2 l) = 1
  const auto lines = lines_of(content_of(scratch / "p.csv"));
  CHECK(done.err.find("wrote p.csv: 7 curves") != std::string::npos);
  CHECK(std::stod(lines.back().substr(lines.back().rfind(',') + 1)) == Approx(-1.0).epsilon(1e-14));
  CHECK(content_of(scratch / "p.csv").find("# scene: ") != std::string::npos);
}

TEST_CASE("portrait takes levels from the command line", "[apps][portrait]") {
  const ScratchDirectory scratch;
  const Run done =
      run(scratch, "portrait --cells 1 --amplitudes '90 deg,1e-9' --excesses=-0.5,3 --points 9 --json");
  CHECK(done.code == 0);
  const auto json = nlohmann::json::parse(done.out);
  CHECK(json["schema_version"] == 1);
  double largest = 0.0;
  int librations = 0, rotations = 0;
  for (const auto& row : json["rows"]) {
    librations += row["kind"] == "libration";
    rotations += row["kind"] == "rotation";
    if (row["kind"] == "libration" && row["separatrix_excess"] < -1.0)
      largest = std::max(largest, row["angle"].get<double>());
  }
  CHECK(librations == 3 * 9);
  CHECK(rotations == 2 * 9);
  CHECK(largest == Approx(std::acos(0.0)).epsilon(1e-15));
}

TEST_CASE("portrait of an excited pendulum holds sections, the same for any number of threads",
          "[apps][portrait]") {
  const ScratchDirectory scratch;
  scratch.with("s.toml", kExcited);
  scratch.with("starts.csv", "velocity,angle\n0,0.3\n12,0.5\n");
  const std::string common = "portrait s.toml --starts starts.csv --sections 6";
  const Run one = run(scratch, common + " --threads 1 -o one.csv");
  const Run two = run(scratch, common + " --threads 2 -o two.csv --method arkode");
  CHECK(one.code == 0);
  CHECK(two.code == 0);
  CHECK(one.err.find("12 of 12 sections, 0 curves end early") != std::string::npos);
  const auto lines = lines_of(content_of(scratch / "one.csv"));
  CHECK(lines == lines_of(content_of(scratch / "two.csv")));
  REQUIRE(lines.size() == 1 + 2 * 7);
  CHECK(lines[1].starts_with("0,section,-3.91"));
  CHECK(lines[1].ends_with(",0.3,0"));
  CHECK(lines[8].ends_with(",0.5,12"));
  CHECK(content_of(scratch / "one.csv").find("# section_tolerance: 1e-06 rad\n") != std::string::npos);
}

TEST_CASE("portrait says with its exit code that chaotic curves end early", "[apps][portrait]") {
  const ScratchDirectory scratch;
  scratch.with("s.toml", "[pendulum]\nlength = 1\n[support]\nfrequency = 6\namplitude = 0.2\n");
  scratch.with("starts.csv", "angle,velocity\n3,0\n");
  const Run done = run(scratch, "portrait s.toml --starts starts.csv --sections 150 -o s.csv");
  CHECK(done.code == 1);
  CHECK(done.err.find("1 curves end early") != std::string::npos);
  CHECK(lines_of(content_of(scratch / "s.csv")).size() < 152);
}

TEST_CASE("portrait writes every format and a figure", "[apps][portrait]") {
  const ScratchDirectory scratch;
  CHECK(run(scratch, "portrait -o a.npz --figure a.svg").code == 0);
  CHECK(content_of(scratch / "a.npz").starts_with("PK"));
  CHECK(content_of(scratch / "a.svg").find("separatrix") != std::string::npos);
  CHECK(run(scratch, "portrait -o a.h5").code == 0);
  CHECK(content_of(scratch / "a.h5").starts_with("\x89HDF"));
  CHECK(run(scratch, "portrait --json -o a.json").code == 0);
}

TEST_CASE("portrait shows its plan and its help without computing", "[apps][portrait]") {
  const ScratchDirectory scratch;
  scratch.with("s.toml", kExcited);
  const Run bare = run(scratch, "portrait --dry-run");
  CHECK(bare.code == 0);
  CHECK(bare.out.find("# model: free pendulum\n# portrait: 7 amplitudes, 3 excesses") != std::string::npos);
  const Run excited = run(scratch, "portrait s.toml --dry-run --sections 100000 -o none.csv");
  CHECK(excited.code == 0);
  CHECK(excited.out.find("# portrait: 60 starts, 100000 sections of each") != std::string::npos);
  CHECK(excited.out.find("frequency = 12") != std::string::npos);
  CHECK(!std::filesystem::exists(scratch / "none.csv"));
  const Run help = run(scratch, "portrait --help");
  CHECK(help.code == 0);
  for (const char* flag : {"--cells", "--curves", "--sections", "--figure", "Example"})
    CHECK(help.out.find(flag) != std::string::npos);
  CHECK(help.out.find("--tolerance") == std::string::npos);
}

TEST_CASE("portrait refuses wrong flags, scenes and places", "[apps][portrait][misuse]") {
  const ScratchDirectory scratch;
  scratch.with("free.toml", kFree);
  scratch.with("excited.toml", kExcited);
  scratch.with("mathieu.toml", "[mathieu]\ndelta = 1\n");
  scratch.with("bad.csv", "angle,velocity\n0,nan\n");
  scratch.with("far.csv", "angle,velocity\n1e10,0\n");
  struct Case {
    const char* arguments;
    int code;
    const char* message;
  };
  for (const Case& c : {Case{"portrait --tolerance 1e-9", 2, "--tolerance"},
                        Case{"portrait excited.toml --tolerance=1e-9", 2, "--tolerance"},
                        Case{"portrait --sections 5", 2, "--sections"},
                        Case{"portrait free.toml --starts bad.csv", 2, "--starts"},
                        Case{"portrait excited.toml --points 9", 2, "--points"},
                        Case{"portrait excited.toml --amplitudes 1", 2, "--amplitudes"},
                        Case{"portrait --amplitudes 3.2", 2, "amplitude = 3.2"},
                        Case{"portrait --amplitudes 1,nan", 2, "--amplitudes"},
                        Case{"portrait --excesses 0", 2, "separatrix excess = 0"},
                        Case{"portrait --excesses=-4", 2, "separatrix excess = -4"},
                        Case{"portrait --curves 3 --excesses 1", 2, "--curves"},
                        Case{"portrait --cells 0", 2, "--cells"},
                        Case{"portrait --points 8", 2, "--points"},
                        Case{"portrait --cels 2", 2, "--cells"},
                        Case{"portrait --method cvode", 2, "exact"},
                        Case{"portrait excited.toml --method exact", 2, "arkode"},
                        Case{"portrait --set pendulum.length=1", 2, "--set"},
                        Case{"portrait -o a.npy", 2, ".npz"},
                        Case{"portrait --json -o a.csv", 2, ".json"},
                        Case{"portrait -o a.csv --figure a.gif", 2, ".png"},
                        Case{"portrait -o a.svg --figure a.svg", 2, "same file"},
                        Case{"portrait mathieu.toml", 3, "[pendulum]"},
                        Case{"portrait excited.toml --starts bad.csv", 3, "bad.csv:2:3"},
                        Case{"portrait excited.toml --starts far.csv", 3, "far.csv:2"},
                        Case{"portrait --cells 1000 --points 1000000 -o a.csv", 4, "memory"},
                        Case{"portrait none.toml", 5, "none.toml"},
                        Case{"portrait -o none/a.csv", 5, "none/a.csv"}}) {
    const Run refused = run(scratch, c.arguments);
    INFO(c.arguments << ": " << refused.err);
    CHECK(refused.code == c.code);
    CHECK(refused.err.find(c.message) != std::string::npos);
    CHECK(refused.out.empty());
  }
  CHECK(scratch.names().size() == 7);  // the scenes and tables above, .out and .err
}

}  // namespace strutt::test::portrait_test
