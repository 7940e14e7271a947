#pragma once

#include <cstddef>
#include <vector>

namespace strutt {

/// A point in units of the grid: column and row, with fractions.
struct GridPoint {
  double column = 0.0;
  double row = 0.0;
};

/// A line of equal value; closed if its ends are the same point.
using ContourLine = std::vector<GridPoint>;

/// The lines on which values[row * columns + column], interpolated linearly between neighbours, is `level`
/// (marching squares). Squares with a NaN at a corner hold no line, so a line may end inside the grid.
std::vector<ContourLine> contour_lines(const std::vector<float>& values, std::size_t columns, double level);

/// Length in units of the grid after the factors.
double length_of(const ContourLine& line, double column_unit, double row_unit);

}  // namespace strutt
