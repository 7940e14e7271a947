#pragma once

#include <cstddef>
#include <vector>

#include "chart/box_panel.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// Some cells of a few rows of a chart that lie in one box.
struct GridPiece {
  static constexpr std::size_t kMostRows = 12, kMostColumns = 2160;
  static constexpr std::size_t kTileColumns = 240;  ///< whole blocks of the tensor kernel
  std::size_t box = 0;
  std::size_t first_row = 0, rows = 0;
  std::size_t first_column = 0, columns = 0;

  /// Where row r of the piece begins in a layer of the strip.
  std::size_t offset(std::size_t r, const ChartStrip& strip) const {
    return (first_row + r - strip.first_row) * strip.columns + first_column;
  }
};

/// The boxes of a surrogate on the tensor grid of a chart: for some rows of a box a matrix product with the
/// Chebyshev polynomials at the columns, which are kept while rows of the box are asked for. A wide box is
/// cut into panels of columns, on which polynomials of lower degree do.
class SurrogateGrid {
 public:
  SurrogateGrid() = default;  // of no cells
  SurrogateGrid(const std::vector<SurrogateBox>& boxes, const Axis& x, const Axis& y);

  /// The cells of `rows` rows that lie in interpolated boxes. Rows must be asked for in ascending order.
  std::vector<GridPiece> pieces(std::size_t first_row, std::size_t rows);

  bool empty() const { return boxes_.empty(); }

  /// With bounds for what `evaluate` gives.
  const SurrogateBox& box(const GridPiece& piece) const { return boxes_[piece.box].box; }

  /// The functions that the box interpolates, at a piece (or some cells of one) of the rows last asked for:
  /// function f of cell c of row r, counted in the piece, at values[(r * functions + f) * stride + c].
  void evaluate(const GridPiece& piece, double* values, std::size_t stride) const;

  /// How far the first function leaves the straight line between neighbouring cells of row r of the piece,
  /// and the cell before, at most.
  double bend(const GridPiece& piece, std::size_t r) const;

 private:
  struct Range {
    std::size_t first = 0, last = 0;  // last excluded
    std::size_t size() const { return last - first; }
    bool empty() const { return first >= last; }
  };
  struct Panel {
    BoxPanel functions;
    Range columns;
    std::vector<double> basis;    // terms x columns
    std::vector<double> weights;  // terms x functions of the rows last asked for
    std::vector<double> bends;    // of these rows, see bend; of the first function
    double step = 0.0;            // the widest between columns, of the 2 of the panel
    std::size_t terms() const { return static_cast<std::size_t>(functions.coefficients[0].rows()); }
  };
  struct Box {
    SurrogateBox box;
    Range columns, rows;
    std::vector<Panel> panels;  // while its rows are asked for
    Range weighted;             // the rows last asked for
  };

  static Range indices_in(const std::vector<double>& coordinates, double low, double high, bool with_high);
  void cut_into_panels(Box& box) const;
  Panel panel(const Box& box, const Range& columns) const;
  void contract(Box& box, const Range& rows) const;

  std::vector<double> x_, y_;  // axis coordinates
  std::vector<Box> boxes_;
};

}  // namespace strutt
