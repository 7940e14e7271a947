#include "strutt/base/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

#include "strutt/base/floating_point.hpp"

#ifdef __SANITIZE_THREAD__
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace strutt {
namespace {

/// Show the thread sanitizer, which cannot see into TBB, what happens before what.
void begins_after([[maybe_unused]] void* event) {
#ifdef __SANITIZE_THREAD__
  __tsan_acquire(event);
#endif
}
void ends_before([[maybe_unused]] void* event) {
#ifdef __SANITIZE_THREAD__
  __tsan_release(event);
#endif
}

/// One task, and all of them, also when a body throws.
struct Task {
  explicit Task(void* shared) : event(shared) { begins_after(event); }
  ~Task() { ends_before(event); }
  void* event;
};
struct AllTasks {
  ~AllTasks() { begins_after(event); }
  void* event;
};

using Indices = tbb::blocked_range<std::size_t>;
using Work = std::function<void(std::size_t first, std::size_t last, int slot)>;

/// What TBB copies into its tasks. Nothing of the copy may be read under the eyes of the sanitizer before the
/// task has begun: TBB hands it from thread to thread.
struct Body {
  const Work* work;
  void* event;

  __attribute__((no_sanitize_thread)) void operator()(const Indices& range) const {
    carry_out(*work, event, range.begin(), range.end());
  }

 private:
  [[gnu::noinline]] static void carry_out(const Work& work, void* event, std::size_t first,
                                          std::size_t last) {
    const Task task{event};
    work(first, last, tbb::this_task_arena::current_thread_index());
  }
};

bool is_cancelled(const ParallelOptions& options) {
  return options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed);
}

}  // namespace

int thread_count(const ParallelOptions& options) {
  return options.threads > 0 ? options.threads : std::max(1, tbb::this_task_arena::max_concurrency());
}

bool parallel_for(std::size_t count, const ParallelOptions& options,
                  const std::function<void(std::size_t, int)>& body) {
  std::atomic<std::size_t> done{0};
  const Work run = [&](std::size_t first, std::size_t last, int slot) {
    const DefaultFloatingPoint environment;  // the threads of TBB have what they were started with
    for (std::size_t index = first; index < last && !is_cancelled(options); ++index) {
      body(index, slot);
      done.fetch_add(1, std::memory_order_relaxed);
    }
  };
  const int threads = thread_count(options);
  if (threads == 1) {
    run(0, count, 0);
  } else {
    // Unless told otherwise TBB has no more threads than the machine has cores, and complains when asked for
    // more.
    std::optional<tbb::global_control> more;
    if (threads > tbb::this_task_arena::max_concurrency())
      more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    ends_before(&arena);
    const AllTasks all{&arena};
    arena.execute([&] { tbb::parallel_for(Indices(0, count), Body{&run, &arena}); });
  }
  return done == count;
}

bool parallel_for_ranges(std::size_t count, std::size_t most, const ParallelOptions& options,
                         const std::function<void(std::size_t, std::size_t, int)>& body) {
  return parallel_for((count + most - 1) / most, options, [&](std::size_t range, int slot) {
    body(range * most, std::min((range + 1) * most, count), slot);
  });
}

}  // namespace strutt
