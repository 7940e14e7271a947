#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace strutt {

/// How many threads work, and how the caller watches and stops them.
struct ParallelOptions {
  int threads = 0;  ///< 0: all that the process may use; 1: a plain loop on the caller
  const std::atomic<bool>* cancel = nullptr;  ///< set to true to stop; bodies that have begun are finished
};

/// Number of threads that `parallel_for` uses for this option (>= 1).
int thread_count(const ParallelOptions& options);

/// Calls body(index, slot) once for every index in [0, count), in no fixed order.
/// `slot` is in [0, thread_count(options)) and no two bodies run at the same time with the same slot: keep
/// one workspace per slot. The results must depend on `index` only, never on `slot`. The first exception
/// thrown by a body stops the loop and is rethrown here. Returns false when cancelled before every index was
/// done.
bool parallel_for(std::size_t count, const ParallelOptions& options,
                  const std::function<void(std::size_t index, int slot)>& body);

/// The same for work that goes better side by side: body(first, last, slot) for the indices [first, last),
/// `most` >= 1 of them, fewer at the end of [0, count). The cuts do not depend on the number of threads.
bool parallel_for_ranges(std::size_t count, std::size_t most, const ParallelOptions& options,
                         const std::function<void(std::size_t first, std::size_t last, int slot)>& body);

}  // namespace strutt
