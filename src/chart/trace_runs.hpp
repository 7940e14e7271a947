#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "chart/cell_row.hpp"

namespace strutt {

/// Neighbouring cells of a row.
struct CellRun {
  std::size_t first = 0, last = 0;  ///< last excluded
  TraceSide side = TraceSide::near;
};

/// The cells of a row in runs: near 2 or -2 they need their factors, elsewhere D alone tells them. Between
/// cells on the same side, by more than D can leave its chord by, lies no edge of stability, and the factors
/// keep their signs. A run begins on the side on which the cell before is, or it is near; the first run is
/// near, and so is the last.
class TraceRuns {
 public:
  static constexpr std::size_t kBlock = 48, kPart = 8;  ///< cells that are judged together
  static constexpr std::size_t kMostAdded = 10 * kBlock;

  /// A row of so many cells, D of which is at `trace`.
  void begin(const double* trace, std::size_t count);

  /// The next cells, up to kMostAdded. Near is what is within `least_gap`.
  void add(std::size_t count, double least_gap);

  /// All cells near.
  void set_near(std::size_t count) { runs_.assign(1, {0, count, TraceSide::near}); }

  const std::vector<CellRun>& runs() const { return runs_; }

 private:
  std::size_t last() const { return runs_.empty() ? 0 : runs_.back().last; }
  void add_parts(std::size_t end, double least_gap);
  TraceSide side_before(std::size_t cell, double least_gap) const;
  void append(std::size_t last, TraceSide side);

  const double* trace_ = nullptr;
  std::size_t count_ = 0;
  std::vector<CellRun> runs_;
};

}  // namespace strutt
