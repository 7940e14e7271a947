#pragma once

#include <atomic>

namespace strutt::app {

/// Writing into a closed pipe becomes an error of the write, and the descriptors 0 to 2 are taken even if the
/// caller closed them, so that no result file gets one of these numbers.
void prepare_process();

/// From now on SIGINT and SIGTERM set the flag below; the second one ends the process at once.
void install_signal_handlers();

/// Becomes true with the first signal; for the `cancel` options of the library.
const std::atomic<bool>& cancel_flag();

/// Number of the signal that arrived, 0 for none.
int received_signal();

/// Throws Interrupted if a signal arrived.
void throw_if_interrupted();

}  // namespace strutt::app
