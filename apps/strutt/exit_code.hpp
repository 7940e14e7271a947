#pragma once

#include <stdexcept>
#include <string>

namespace strutt::app {

/// What the program answers to the shell (docs/files.md).
enum class ExitCode : int {
  done = 0,
  unresolved = 1,  ///< done, but something asked for is unresolved or has not converged
  usage = 2,
  file = 3,
  memory = 4,
  input_output = 5,
  numerical = 6,
  internal = 7,
  closed_pipe = 141,
};

/// A flag is missing, unknown, wrong or out of range.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work was stopped by a signal; nothing was kept.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// A failure as the shell and the user are told of it.
struct Failure {
  ExitCode code;
  std::string message;
};

/// For the exception being handled: its exit code and its text.
Failure describe_current_exception();

/// For the exception being handled: its exit code, after one line on standard error (none for a closed pipe
/// and for signals).
int report_current_exception();

}  // namespace strutt::app
