#include "io/gnuplot.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include "io/text.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/figure.hpp"
#include "strutt/io/output_file.hpp"

extern char** environ;

namespace strutt {
namespace {

constexpr const char* kLog = "gnuplot.log";
constexpr std::size_t kLongestLog = 2000;

/// What the child has as standard input, output and error, and where it works.
class SpawnActions {
 public:
  explicit SpawnActions(const std::filesystem::path& directory) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, directory.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, kLog, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// The exit status; a signal to this process that is handled (and not restarted) ends the child as well.
int wait_for(pid_t child, bool& interrupted) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
    interrupted = true;
    ::kill(child, SIGTERM);
  }
  return status;
}

[[noreturn]] void fail_without_gnuplot(const std::filesystem::path& figure) {
  throw InputOutputError("cannot draw '" + printable(figure.string()) +
                             "': the program gnuplot is not installed or not in the PATH",
                         0);
}

}  // namespace

void require_gnuplot(const std::filesystem::path& figure) {
  const char* const variable = std::getenv("PATH");
  const std::string path =
      variable == nullptr ? "/bin:/usr/bin" : variable;  // what posix_spawnp falls back to
  for (std::size_t begin = 0; begin <= path.size();) {
    const auto end = std::min(path.find(':', begin), path.size());
    const std::filesystem::path directory = path.substr(begin, end - begin);
    if (::access((directory / "gnuplot").c_str(), X_OK) == 0) return;
    begin = end + 1;
  }
  fail_without_gnuplot(figure);
}

std::string gnuplot_string(std::string_view text) {
  std::string result = "'";
  for (const char c : printable(text)) {
    result += c;
    if (c == '\'') result += c;
  }
  return result + "'";
}

GnuplotRun::GnuplotRun() {
  std::error_code error;
  const auto parent = std::filesystem::temp_directory_path(error);
  if (error) throw InputOutputError("there is no directory for temporary files", error.value());
  std::string pattern = (parent / "strutt-figure-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {
    throw InputOutputError("cannot write in the directory '" + printable(parent.string()) + "'", errno);
  }
  directory_ = pattern;
}

GnuplotRun::~GnuplotRun() {
  std::error_code ignored;
  std::filesystem::remove_all(directory_, ignored);
}

void GnuplotRun::write(std::string_view name, std::string_view bytes) const {
  OutputFile file(directory_ / name);
  file.write(bytes);
  file.commit();
}

void GnuplotRun::run(const std::string& script, const std::filesystem::path& figure) const {
  const SpawnActions actions(directory_);
  std::string program = "gnuplot", defaults = "-d", file = script;  // -d: no start-up files of the user
  char* const arguments[] = {program.data(), defaults.data(), file.data(), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, program.c_str(), actions.get(), nullptr, arguments, environ);
  const std::string what = "cannot draw '" + printable(figure.string()) + "'";
  if (error == ENOENT) fail_without_gnuplot(figure);
  if (error != 0) throw InputOutputError(what + ": gnuplot does not start", error);
  bool interrupted = false;
  const int status = wait_for(child, interrupted);
  if (interrupted) throw InputOutputError(what, EINTR);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw InputOutputError(what + ": gnuplot failed: " + printable(read_file(directory_ / kLog, kLongestLog)),
                         0);
}

}  // namespace strutt
