// From an exception to an exit code; 6 and 7 are for failures that no input is known to bring about.
#include "strutt/exit_code.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <new>

#include "strutt/base/error.hpp"
#include "strutt/io/table.hpp"

namespace strutt::app {
namespace {

template <typename Thrown>
Failure failure_of(const Thrown& thrown) {
  try {
    throw thrown;
  } catch (...) {
    return describe_current_exception();
  }
}

template <typename Thrown>
void check(const Thrown& thrown, int code, const std::string& message) {
  const Failure failure = failure_of(thrown);
  CHECK(static_cast<int>(failure.code) == code);
  CHECK(failure.message == message);
}

}  // namespace

TEST_CASE("what the user got wrong has the exit codes 2 and 3", "[apps][exit_code]") {
  check(UsageError("unknown flag"), 2, "unknown flag");
  check(InvalidInput("the tolerance is 0"), 2, "the tolerance is 0");
  check(FileError("in.csv", 3, 4, "no number"), 3, "in.csv:3:4: no number");
}

TEST_CASE("what the machine cannot give has the exit codes 4 and 5", "[apps][exit_code]") {
  check(MemoryBudgetExceeded("3 GiB of 2 GiB"), 4, "3 GiB of 2 GiB");
  check(std::bad_alloc(), 4, "out of memory");
  check(InputOutputError("cannot write", 0), 5, "cannot write");
  CHECK(failure_of(InputOutputError("cannot write", ENOSPC)).code == ExitCode::input_output);
  // 128 + SIGPIPE, as if the signal had ended the program.
  CHECK(static_cast<int>(failure_of(InputOutputError("cannot write", EPIPE)).code) == 141);
}

TEST_CASE("a numerical failure of the whole run has the exit code 6", "[apps][exit_code]") {
  check(NumericalFailure("the QR iteration failed"), 6, "the QR iteration failed");
}

TEST_CASE("whatever else is thrown has the exit code 7", "[apps][exit_code]") {
  check(std::logic_error("strips out of order"), 7, "internal error: strips out of order");
  check(std::runtime_error("no reason"), 7, "internal error: no reason");
  check(1, 7, "internal error");
}

}  // namespace strutt::app
