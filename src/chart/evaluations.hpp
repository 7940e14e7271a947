#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "strutt/base/error.hpp"

namespace strutt {

/// Work of a search by all its threads, counted: whether it is too much does not depend on the machine.
class Evaluations {
 public:
  explicit Evaluations(std::int64_t most) : most_(most) {}

  /// Throws NumericalFailure when there are more than allowed.
  void add(std::int64_t count) {
    if (count > most_ - count_.fetch_add(count, std::memory_order_relaxed))
      throw NumericalFailure("more than " + std::to_string(most_) + " evaluations");
  }

 private:
  std::int64_t most_;
  std::atomic<std::int64_t> count_{0};
};

}  // namespace strutt
