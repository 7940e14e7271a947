#include "exit_code.hpp"

#include <cerrno>
#include <new>

#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/table.hpp"
#include "terminal.hpp"

namespace strutt::app {

Failure describe_current_exception() {
  try {
    throw;
  } catch (const UsageError& error) {
    return {ExitCode::usage, error.what()};
  } catch (const FileError& error) {
    return {ExitCode::file, error.what()};
  } catch (const InvalidInput& error) {
    return {ExitCode::usage, error.what()};
  } catch (const MemoryBudgetExceeded& error) {
    return {ExitCode::memory, error.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::memory, "out of memory"};
  } catch (const InputOutputError& error) {
    return {error.error_number() == EPIPE ? ExitCode::closed_pipe : ExitCode::input_output, error.what()};
  } catch (const NumericalFailure& error) {
    return {ExitCode::numerical, error.what()};
  } catch (const std::exception& error) {
    return {ExitCode::internal, std::string("internal error: ") + error.what()};
  } catch (...) {
    return {ExitCode::internal, "internal error"};
  }
}

int report_current_exception() {
  // After a signal, whatever failed failed because of it.
  if (received_signal() != 0) return 128 + received_signal();
  const Failure failure = describe_current_exception();
  if (failure.code != ExitCode::closed_pipe) print_error(failure.message);
  return static_cast<int>(failure.code);
}

}  // namespace strutt::app
