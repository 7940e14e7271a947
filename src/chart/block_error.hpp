#pragma once

#include <array>

#include "chart/cell_row.hpp"

namespace strutt {

struct Extent {
  double least, largest;
};

/// What some neighbouring cells of a row have in common.
struct BlockRanges {
  std::array<double, 4> largest_factors;  ///< |u1|, |u2|, |u1'|, |u2'|, in the row's state and unit
  double least_half_trace;                ///< |u1 u2' + u1' u2|
  Extent kappa, h;
};

/// Bounds for all of these cells.
struct BlockError {
  double monodromy;  ///< of Monodromy::error, as by monodromy_error but relative to the diagonal of M
  double gap;        ///< of the error of 2 - |D|
};
BlockError block_error(const BlockRanges& ranges, const CellRow& row);

}  // namespace strutt
