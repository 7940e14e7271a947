#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "strutt/base/parallel.hpp"

namespace strutt::test::parallel_test {

namespace {

constexpr std::size_t kCount = 3000;
constexpr int kThreads = 4;

struct Stop {
  std::size_t index;
};

}  // namespace

TEST_CASE("parallel_for calls every index once", "[base][threads]") {
  for (const int threads : {0, 1, 2, kThreads}) {
    std::vector<std::atomic<int>> calls(kCount);
    CHECK(parallel_for(kCount, {.threads = threads}, [&](std::size_t i, int) { ++calls[i]; }));
    int wrong = 0;
    for (const auto& n : calls) wrong += n != 1;
    CHECK(wrong == 0);
  }
  CHECK(parallel_for(0, {.threads = kThreads}, [](std::size_t, int) { throw Stop{}; }));
}

TEST_CASE("parallel_for_ranges cuts the indices into ranges of the same length", "[base][threads]") {
  for (const int threads : {1, kThreads}) {
    for (const std::size_t most : {std::size_t{1}, std::size_t{7}, kCount, kCount + 1}) {
      std::vector<std::atomic<int>> calls(kCount);
      std::atomic<int> wrong{0};
      CHECK(parallel_for_ranges(kCount, most, {.threads = threads},
                                [&](std::size_t first, std::size_t last, int slot) {
                                  const bool full = last - first == most || last == kCount;
                                  wrong += first % most != 0 || last - first > most || !full || slot < 0;
                                  for (std::size_t i = first; i < last; ++i) ++calls.at(i);
                                }));
      for (const auto& n : calls) wrong += n != 1;
      INFO(threads << " threads, ranges of " << most);
      CHECK(wrong == 0);
    }
  }
  CHECK(
      parallel_for_ranges(0, 3, {.threads = kThreads}, [](std::size_t, std::size_t, int) { throw Stop{}; }));
}

TEST_CASE("a slot is never shared at the same time", "[base][threads]") {
  const ParallelOptions options{.threads = kThreads};
  std::vector<std::atomic<bool>> busy(static_cast<std::size_t>(thread_count(options)));
  std::vector<long> plain(busy.size());  // not atomic: the thread sanitizer sees a shared slot too
  std::atomic<int> collisions{0}, out_of_range{0};
  parallel_for(kCount, options, [&](std::size_t, int slot) {
    const auto k = static_cast<std::size_t>(slot);
    if (slot < 0 || k >= busy.size()) {
      ++out_of_range;
      return;
    }
    if (busy[k].exchange(true)) ++collisions;
    ++plain[k];
    std::this_thread::yield();
    busy[k] = false;
  });
  CHECK(out_of_range == 0);
  CHECK(collisions == 0);
  long total = 0;
  for (const long n : plain) total += n;
  CHECK(total == static_cast<long>(kCount));
}

TEST_CASE("an exception of a body comes out of parallel_for", "[base][threads]") {
  for (const int threads : {1, kThreads}) {
    std::atomic<std::size_t> done{0};
    try {
      parallel_for(kCount, {.threads = threads}, [&](std::size_t i, int) {
        if (i == 7) throw Stop{i};
        std::this_thread::sleep_for(std::chrono::microseconds(20));
        ++done;
      });
      FAIL("nothing thrown");
    } catch (const Stop& stop) {
      CHECK(stop.index == 7);
    }
    CHECK(done < kCount - 1);  // and stops the loop
    if (threads == 1) CHECK(done == 7);
  }
}

TEST_CASE("cancellation stops the loop and is reported", "[base][threads]") {
  for (const int threads : {1, kThreads}) {
    std::atomic<bool> cancel{false};
    std::atomic<std::size_t> done{0};
    const ParallelOptions options{.threads = threads, .cancel = &cancel};
    CHECK_FALSE(parallel_for(kCount, options, [&](std::size_t, int) {
      if (++done == 11) cancel = true;
      std::this_thread::sleep_for(std::chrono::microseconds(20));
    }));
    CHECK(done >= 11);
    CHECK(done < 11 + static_cast<std::size_t>(threads));  // those that had begun
    done = 0;
    CHECK_FALSE(parallel_for(kCount, options, [&](std::size_t, int) { ++done; }));
    CHECK(done == 0);
    CHECK(parallel_for(0, options, [](std::size_t, int) {}));  // nothing was left undone
  }
}

TEST_CASE("a cancellation that comes with the last body leaves nothing undone", "[base][threads]") {
  std::atomic<bool> cancel{false};
  CHECK(parallel_for(5, {.threads = 1, .cancel = &cancel}, [&](std::size_t i, int) { cancel = i == 4; }));
}

TEST_CASE("one thread is a plain loop on the caller", "[base][threads]") {
  std::vector<std::size_t> order;
  bool elsewhere = false;
  const auto caller = std::this_thread::get_id();
  parallel_for(100, {.threads = 1}, [&](std::size_t i, int slot) {
    order.push_back(i);
    elsewhere = elsewhere || slot != 0 || std::this_thread::get_id() != caller;
  });
  CHECK_FALSE(elsewhere);
  REQUIRE(order.size() == 100);
  CHECK(std::is_sorted(order.begin(), order.end()));
}

TEST_CASE("results do not depend on the number of threads", "[base][threads][extreme][N48]") {
  const auto compute = [](int threads) {
    std::vector<double> result(kCount);
    const ParallelOptions options{.threads = threads};
    std::vector<double> workspace(static_cast<std::size_t>(thread_count(options)));
    parallel_for(kCount, options, [&](std::size_t i, int slot) {
      double& x = workspace[static_cast<std::size_t>(slot)];
      x = 0.0;
      for (std::size_t k = 1; k < 50; ++k) x += std::sin(static_cast<double>(i * k));
      result[i] = x;
    });
    return result;
  };
  const auto one = compute(1);
  CHECK(compute(2) == one);
  CHECK(compute(kThreads) == one);
}

TEST_CASE("thread_count", "[base][threads]") {
  CHECK(thread_count({.threads = 3}) == 3);
  CHECK(thread_count({.threads = 0}) >= 1);
}

}  // namespace strutt::test::parallel_test
