#include "signals.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include "exit_code.hpp"

namespace strutt::app {
namespace {

std::atomic<bool> cancel{false};
std::atomic<int> signal_number{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void strutt_on_signal(int number) {
  int none = 0;
  if (!signal_number.compare_exchange_strong(none, number)) _exit(128 + number);
  cancel = true;
}

}  // namespace

void prepare_process() {
  ::signal(SIGPIPE, SIG_IGN);
  for (int fd = 0; fd <= 2; ++fd) {
    if (::fcntl(fd, F_GETFD) >= 0) continue;
    // Standard input and output in the wrong direction: using them must fail, not read or write nothing.
    const int opened = ::open("/dev/null", fd == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
    if (opened >= 0 && opened != fd) ::close(opened);
  }
}

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = strutt_on_signal;
  ::sigemptyset(&action.sa_mask);
  // Also where the parent ignores them (jobs in the background of a script): who sends one means it.
  for (const int number : {SIGINT, SIGTERM}) ::sigaction(number, &action, nullptr);
}

const std::atomic<bool>& cancel_flag() { return cancel; }

int received_signal() { return signal_number; }

void throw_if_interrupted() {
  if (received_signal() != 0) throw Interrupted();
}

}  // namespace strutt::app
