#include "chart/trace_runs.hpp"

#include <algorithm>
#include <cmath>

namespace strutt {
namespace {

TraceSide side_of(double trace, double least_gap) {
  if (std::abs(trace) < 2.0 - least_gap) return TraceSide::between;
  if (trace > 2.0 + least_gap) return TraceSide::above;
  return -trace > 2.0 + least_gap ? TraceSide::below : TraceSide::near;
}

}  // namespace

void TraceRuns::begin(const double* trace, std::size_t count) {
  trace_ = trace;
  count_ = count;
  runs_.clear();
}

void TraceRuns::add(std::size_t count, double least_gap) {
  const std::size_t begin = last(), end = begin + count;
  std::array<TraceSide, kMostAdded / kBlock> sides;
  trace_sides(trace_ + begin, count, kBlock, least_gap, sides.data());
  TraceSide before = side_before(begin, least_gap);
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t next = std::min(end, first + kBlock);
    const TraceSide side = sides[(first - begin) / kBlock];
    if (side == before && side != TraceSide::near && next < count_) {
      append(next, side);
    } else {
      add_parts(next, least_gap);
      before = side_before(next, least_gap);
    }
  }
}

/// A block that is not on one side as a whole.
void TraceRuns::add_parts(std::size_t end, double least_gap) {
  const std::size_t begin = last();
  std::array<TraceSide, kBlock / kPart> sides;
  trace_sides(trace_ + begin, end - begin, kPart, least_gap, sides.data());
  for (std::size_t first = begin; first < end; first += kPart) {
    const std::size_t next = std::min(end, first + kPart);
    const TraceSide side = sides[(first - begin) / kPart];
    append(next, side == side_before(first, least_gap) && next < count_ ? side : TraceSide::near);
  }
}

/// Of the cell before; near if there is none.
TraceSide TraceRuns::side_before(std::size_t cell, double least_gap) const {
  return cell == 0 ? TraceSide::near : side_of(trace_[cell - 1], least_gap);
}

void TraceRuns::append(std::size_t last, TraceSide side) {
  if (!runs_.empty() && runs_.back().side == side) {
    runs_.back().last = last;
  } else {
    runs_.push_back({this->last(), last, side});
  }
}

}  // namespace strutt
