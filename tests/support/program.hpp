#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace strutt::test {

/// What a started program finds. The descriptors named here stay open in the caller.
struct Setup {
  std::string input = {};                     ///< all of standard input
  std::vector<std::string> environment = {};  ///< NAME=VALUE, besides what the test has
  std::filesystem::path directory = {};       ///< working directory, that of the test unless given
  int output = -1;               ///< descriptor that becomes standard output instead of a captured one
  int error = -1;                ///< the same for standard error
  std::vector<int> closed = {};  ///< of 0, 1, 2: closed when the program starts
};

/// How it ended, and what it said.
struct Result {
  int code = -1;  ///< exit code; 128 + n if signal n ended it
  std::string out;
  std::string err;
};

/// The program `strutt`, running. No shell is involved.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments, const Setup& setup = {});
  ~Program();  ///< kills it if it still runs
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) const;
  Result wait();  ///< for a minute; fails the test then

 private:
  pid_t child_ = -1;
  int out_ = -1;
  int err_ = -1;
};

/// Starts the program and waits for its end.
Result strutt(const std::vector<std::string>& arguments, const Setup& setup = {});

/// The lines of CSV text without comments, split into cells.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);

/// The text after `# name: ` in the comments of CSV text; fails the test if there is none.
std::string csv_comment(const std::string& text, const std::string& name);

}  // namespace strutt::test
