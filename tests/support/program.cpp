#include "support/program.hpp"
#include "support/paths.hpp"

#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <sstream>
#include <thread>

extern char** environ;

namespace strutt::test {
namespace {

/// A file in memory, closed with the next exec.
int memory_file(const std::string& content = {}) {
  const int fd = ::memfd_create("strutt-test", MFD_CLOEXEC);
  REQUIRE(fd >= 0);
  REQUIRE(::pwrite(fd, content.data(), content.size(), 0) == static_cast<ssize_t>(content.size()));
  return fd;
}

std::string take(int& fd) {
  std::string content(static_cast<std::size_t>(::lseek(fd, 0, SEEK_END)), '\0');
  CHECK(::pread(fd, content.data(), content.size(), 0) == static_cast<ssize_t>(content.size()));
  ::close(fd);
  fd = -1;
  return content;
}

/// A vector of texts as execve wants it.
std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (auto& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::vector<std::string>& additions) {
  std::vector<std::string> result = additions;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const auto same_name = [&](const std::string& other) {
      return text.starts_with(other.substr(0, other.find('=') + 1));
    };
    if (std::none_of(additions.begin(), additions.end(), same_name)) result.push_back(text);
  }
  return result;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const Setup& setup)
    : out_(memory_file()), err_(memory_file()) {
  const int in = memory_file(setup.input);
  posix_spawn_file_actions_t actions;
  REQUIRE(::posix_spawn_file_actions_init(&actions) == 0);
  ::posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, setup.output >= 0 ? setup.output : out_, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, setup.error >= 0 ? setup.error : err_, STDERR_FILENO);
  for (const int fd : setup.closed) ::posix_spawn_file_actions_addclose(&actions, fd);
  if (!setup.directory.empty()) ::posix_spawn_file_actions_addchdir_np(&actions, setup.directory.c_str());

  const std::string path = program_path();
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  auto environment = environment_with(setup.environment);
  const int error = ::posix_spawn(&child_, path.c_str(), &actions, nullptr, pointers(words).data(),
                                  pointers(environment).data());
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(in);
  REQUIRE(error == 0);
}

Program::~Program() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  for (const int fd : {out_, err_}) {
    if (fd >= 0) ::close(fd);
  }
}

void Program::send(int signal) const { REQUIRE(::kill(child_, signal) == 0); }

Result Program::wait() {
  const auto last =
      std::chrono::steady_clock::now() + std::chrono::minutes(5);  // a sanitizer on a busy machine
  int status = 0;
  pid_t ended = 0;
  while ((ended = ::waitpid(child_, &status, WNOHANG)) == 0) {
    if (std::chrono::steady_clock::now() > last) FAIL("the program does not come to an end");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  REQUIRE(ended == child_);
  child_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), take(out_), take(err_)};
}

Result strutt(const std::vector<std::string>& arguments, const Setup& setup) {
  return Program(arguments, setup).wait();
}

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    auto& row = rows.emplace_back();
    for (std::size_t begin = 0;;) {
      const auto comma = line.find(',', begin);
      row.push_back(line.substr(begin, comma == std::string::npos ? comma : comma - begin));
      if (comma == std::string::npos) break;
      begin = comma + 1;
    }
  }
  return rows;
}

std::string csv_comment(const std::string& text, const std::string& name) {
  const std::string start = "# " + name + ": ";
  const auto at = text.find(start);
  REQUIRE(at != std::string::npos);
  const auto begin = at + start.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace strutt::test
