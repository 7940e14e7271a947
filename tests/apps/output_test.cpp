// Places that cannot be written, closed pipes, signals, the progress bar: nothing half written is left.
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test::output_test {
namespace {

using Words = std::vector<std::string>;
using Clock = std::chrono::steady_clock;
const std::string kOld = "an old result\n";

/// A chart of about an hour.
const Words kLongAxes{"--x",         "mathieu.delta=-1:5:2000",
                      "--y",         "mathieu.epsilon=0:6:2000",
                      "--tolerance", "1e-12",
                      "--method",    "propagator"};

/// A directory with a scene, tables and old results.
struct Room {
  ScratchDirectory directory;

  Room() {
    directory.with("m.toml", "[mathieu]\nepsilon = 0.5\n");
    directory.with("p.toml", "[pendulum]\nlength = 1\n[support]\nfrequency = 12\n");
    for (const char* name : {"old.csv", "old.h5", "old.npz", "old.npy", "old.npy.json", "old.png"})
      directory.with(name, kOld);
  }

  Words chart(const Words& more) const {
    Words words{"chart",    "m.toml", "--x", "mathieu.delta=-1:5:3", "--y", "mathieu.epsilon=0:6:2",
                "--layers", "margin"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  void check_untouched() const {
    CHECK(directory.names().size() == 8);
    for (const char* name : {"old.csv", "old.h5", "old.npz", "old.npy", "old.npy.json", "old.png"}) {
      INFO(name);
      CHECK(content_of(directory / name) == kOld);
    }
  }

  void fails(const Words& arguments, const Words& says, Setup setup = {}) const {
    setup.directory = directory.path();
    const Result result = strutt(arguments, setup);
    INFO(result.err);
    CHECK(result.code == 5);
    CHECK(result.err.starts_with("strutt: error: "));
    for (const auto& part : says) CHECK_THAT(result.err, Catch::Matchers::Contains(part));
    check_untouched();
  }

  /// A command that would go on for long is stopped within a second and leaves nothing.
  void stops(const Words& arguments, int signal) const {
    std::string command;
    for (const auto& word : arguments) command += " " + word;
    INFO(command);
    Program program(arguments, {.directory = directory.path()});
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const auto sent = Clock::now();
    program.send(signal);
    const Result result = program.wait();
    CHECK(Clock::now() - sent < std::chrono::seconds(1));
    CHECK(result.code == 128 + signal);
    CHECK(result.err.empty());
    check_untouched();
  }
};

}  // namespace

TEST_CASE("places that cannot be written are input/output errors", "[apps][output]") {
  const Room room;
  for (const std::string name : {"none/c.csv", "none/c.npy", "none/c.npz", "none/c.h5", "none/c.json"}) {
    Words words = room.chart({"-o", name});
    if (name.ends_with("json")) words.emplace_back("--json");
    room.fails(words, {"cannot write '" + name + "'", "No such file or directory"});
  }
  room.fails(room.chart({"-o", "m.toml/c.csv"}), {"Not a directory"});
  room.fails(room.chart({"-o", "old.csv", "--figure", "none/c.png"}), {"none/c.png"});
  room.fails({"stability", "m.toml", "-o", "none/c.csv"}, {"none/c.csv"});
  room.fails({"motion", "p.toml", "--angle", "1", "--velocity", "0", "--duration", "1", "--samples", "3",
              "-o", "none/c.csv"},
             {"none/c.csv"});
}

TEST_CASE("inputs that cannot be read are input/output errors", "[apps][output]") {
  const Room room;
  room.fails({"stability", "none.toml", "-o", "old.csv"}, {"cannot open 'none.toml'"});
  room.fails({"stability", ".", "-o", "old.csv"}, {"Is a directory"});
  room.fails({"stability", "m.toml", "--points", "none.csv", "-o", "old.csv"}, {"cannot open 'none.csv'"});
  room.fails({"stability", "m.toml", "--points", ".", "-o", "old.csv"}, {"Is a directory"});
  room.fails({"stability", "-"}, {"standard input", "Bad file descriptor"}, {.closed = {STDIN_FILENO}});
}

TEST_CASE("a full disk is an input/output error and leaves nothing", "[apps][output]") {
  const Room room;
  room.fails(room.chart({"-o", "/dev/full"}), {"/dev/full", "No space left on device"});
  room.fails(room.chart({"-o", "/dev/full", "--figure", "new.png"}), {"No space left on device"});
  room.fails(room.chart({"-o", "/dev/full", "--figure", "old.png"}), {"No space left on device"});
  room.fails({"stability", "m.toml", "-o", "/dev/full"}, {"No space left on device"});
  room.fails({"motion", "p.toml", "--angle", "1", "--velocity", "0", "--duration", "1", "--samples", "3",
              "-o", "/dev/full"},
             {"No space left on device"});
  room.fails({"period", "--amplitude", "1", "-o", "/dev/full"}, {"No space left on device"});
  room.fails({"portrait", "-o", "/dev/full"}, {"No space left on device"});
  room.fails({"normal-form", "--points", "-", "-o", "/dev/full"}, {"No space left on device"},
             {.input = "alpha\n1\n"});
  const int full = ::open("/dev/full", O_WRONLY);
  REQUIRE(full >= 0);
  for (const Words& words : {Words{"--version"},
                             {"chart", "--help"},
                             {"stability", "m.toml"},
                             room.chart({}),
                             {"period", "--amplitude", "1"},
                             {"portrait"}})
    room.fails(words, {"No space left on device"}, {.output = full});
  ::close(full);
}

TEST_CASE("a closed standard output is an input/output error", "[apps][output]") {
  const Room room;
  room.fails(room.chart({}), {"Bad file descriptor"}, {.closed = {STDOUT_FILENO}});
  room.fails({"--help"}, {"Bad file descriptor"}, {.closed = {STDOUT_FILENO}});
  // Its number must not go to the file.
  Setup closed{.directory = room.directory.path(), .closed = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}};
  CHECK(strutt(room.chart({"-o", "new.csv"}), closed).code == 0);
  CHECK(csv_rows(content_of(room.directory / "new.csv")).size() == 7);
}

TEST_CASE("a closed pipe ends the program silently", "[apps][output]") {
  const Room room;
  int ends[2];
  REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
  ::close(ends[0]);
  for (const Words& words : {Words{"--help"},
                             {"stability", "m.toml"},
                             room.chart({}),
                             room.chart({"--json"}),
                             {"period", "--amplitude", "1"},
                             {"portrait"},
                             {"portrait", "--json"}}) {
    const Result result = strutt(words, {.directory = room.directory.path(), .output = ends[1]});
    CHECK(result.code == 141);
    CHECK(result.err.empty());
  }
  ::close(ends[1]);
  room.check_untouched();
}

TEST_CASE("a figure without gnuplot fails before anything is computed", "[apps][output][figure]") {
  const Room room;
  const auto begin = Clock::now();
  Words words{"chart", "m.toml", "-o", "old.h5", "--figure", "old.png"};
  words.insert(words.end(), kLongAxes.begin(), kLongAxes.end());
  room.fails(words, {"old.png", "gnuplot is not installed"}, {.environment = {"PATH=/nonexistent"}});
  CHECK(Clock::now() - begin < std::chrono::seconds(10));
}

TEST_CASE("a gnuplot that fails leaves neither figure nor data", "[apps][output][figure]") {
  const Room room;
  const ScratchDirectory bin;
  bin.with("gnuplot", "#!/bin/sh\necho the font is gone >&2\nexit 3\n");
  std::filesystem::permissions(bin / "gnuplot", std::filesystem::perms::owner_all);
  room.fails(room.chart({"-o", "old.csv", "--figure", "old.png"}), {"old.png", "the font is gone"},
             {.environment = {"PATH=" + bin.path().string() + ":/usr/bin:/bin"}});
}

TEST_CASE("an interrupt ends every command within a second and leaves nothing", "[apps][output][signal]") {
  const Room room;
  std::string points = "mathieu.delta\n";
  for (int i = 0; i < 100'000; ++i) points += std::to_string(i) + "\n";
  const ScratchDirectory other;
  const std::string table = other.with("points.csv", points).string();
  for (const Words& place :
       {Words{"-o", "old.csv"}, {"-o", "old.h5", "--figure", "old.png"}, {"-o", "new.npz"}, {}}) {
    Words words{"chart", "m.toml"};
    words.insert(words.end(), kLongAxes.begin(), kLongAxes.end());
    words.insert(words.end(), place.begin(), place.end());
    room.stops(words, SIGINT);
  }
  room.stops({"stability", "m.toml", "--points", table, "--tolerance", "1e-12", "-o", "old.csv"}, SIGINT);
  room.stops({"motion", "p.toml", "--angle", "1", "--velocity", "0", "--duration", "2e5", "--samples", "3",
              "-o", "old.csv"},
             SIGINT);
  room.stops({"motion", "p.toml", "--angle", "1", "--velocity", "0", "--duration", "2e5", "--samples", "3",
              "-o", "old.csv"},
             SIGTERM);
}

TEST_CASE("an interrupt while the figure is drawn leaves nothing", "[apps][output][signal][figure]") {
  const Room room;
  const ScratchDirectory bin;
  bin.with("gnuplot", "#!/bin/sh\nexec sleep 60\n");
  std::filesystem::permissions(bin / "gnuplot", std::filesystem::perms::owner_all);
  Program program(room.chart({"-o", "old.csv", "--figure", "old.png"}),
                  {.environment = {"PATH=" + bin.path().string() + ":/usr/bin:/bin"},
                   .directory = room.directory.path()});
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const auto sent = Clock::now();
  program.send(SIGINT);
  CHECK(program.wait().code == 130);
  CHECK(Clock::now() - sent < std::chrono::seconds(1));
  room.check_untouched();
}

namespace {

/// A terminal that nobody looks at.
class Terminal {
 public:
  Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    REQUIRE(master_ >= 0);
    REQUIRE(::grantpt(master_) == 0);
    REQUIRE(::unlockpt(master_) == 0);
    slave_ = ::open(::ptsname(master_), O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(slave_ >= 0);
    ::fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    ::close(slave_);
    ::close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// What a program writes on it that is interrupted after some time, or (0) as soon as something is shown.
  std::string shown(const Words& words, const std::string& input, int milliseconds) const {
    Program program(words, {.input = input, .error = slave_});
    std::string text;
    if (milliseconds > 0) sleep(milliseconds);
    for (int i = 0; milliseconds == 0 && text.empty() && i < 300; ++i) {
      sleep(100);  // a loaded machine takes its time
      text += read();
    }
    program.send(SIGINT);
    CHECK(program.wait().code == 130);
    return text + read();
  }

 private:
  static void sleep(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
  std::string read() const {
    std::string text(4096, '\0');
    const auto size = ::read(master_, text.data(), text.size());
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }

  int master_, slave_ = -1;
};

}  // namespace

TEST_CASE("the progress bar of a chart shows on a terminal only, after a second",
          "[apps][output][progress]") {
  const Terminal terminal;
  const auto shown = [&](const Words& more, int milliseconds) {
    Words words{"chart", "-", "-o", "/dev/null"};
    words.insert(words.end(), kLongAxes.begin(), kLongAxes.end());
    words.insert(words.end(), more.begin(), more.end());
    return terminal.shown(words, "[mathieu]\n", milliseconds);
  };
  CHECK(shown({}, 300).empty());
  CHECK(shown({"--quiet"}, 1400).empty());
  const std::string bar = shown({}, 0);
  CHECK_THAT(bar, Catch::Matchers::Contains("cells/s") && Catch::Matchers::Contains(" left"));
  CHECK(bar.ends_with("\r\x1b[K"));  // wiped off at the end
}

TEST_CASE("an excited portrait has the bar, too", "[apps][output][progress]") {
  const Terminal terminal;
  const auto shown = [&](const Words& more, int milliseconds) {
    Words words{"portrait", "-", "-o", "/dev/null", "--curves", "100000"};
    words.insert(words.end(), more.begin(), more.end());
    const std::string scene = "[pendulum]\nlength = 1\n[support]\nfrequency = 12\namplitude = 0.02\n";
    return terminal.shown(words, scene, milliseconds);
  };
  CHECK(shown({}, 300).empty());
  CHECK(shown({"--quiet"}, 1400).empty());
  const std::string bar = shown({}, 0);
  CHECK_THAT(bar, Catch::Matchers::Contains("curves/s") && Catch::Matchers::Contains(" left"));
  CHECK(bar.ends_with("\r\x1b[K"));
}

}  // namespace strutt::test::output_test
