#pragma once

#include <cstddef>
#include <vector>

#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// Some cells of one row of a chart that lie in one box.
struct GridPiece {
  std::size_t box = 0;
  std::size_t row = 0;
  std::size_t first_column = 0;
  std::size_t columns = 0;
};

/// Factors at the cells of a piece, function f of cell c at values[f * stride + c]: u1, kappa u2, u1'/kappa,
/// u2' with the kappa and the exponent of the box, then its quarter turns.
struct FactorRow {
  static constexpr std::size_t stride = 512;
  std::vector<double> values;
  std::vector<double> weights, polynomials;  // workspace, kept while box and row are the same
  std::size_t box = static_cast<std::size_t>(-1), row = 0;
};

/// The boxes of a surrogate on the tensor grid of a chart: per row and box a small matrix product with the
/// Chebyshev polynomials at the columns, which are kept while rows of the box are asked for.
class SurrogateGrid {
 public:
  /// The boxes must stay.
  SurrogateGrid(const std::vector<SurrogateBox>& boxes, const Axis& x, const Axis& y);

  /// The cells of `rows` rows that lie in interpolated boxes. Rows must be asked for in ascending order.
  std::vector<GridPiece> pieces(std::size_t first_row, std::size_t rows);

  const SurrogateBox& box(const GridPiece& piece) const { return *boxes_[piece.box].box; }

  /// A piece of the rows last asked for. Thread-safe with a workspace per thread.
  void evaluate(const GridPiece& piece, FactorRow& result) const;

 private:
  struct Range {
    std::size_t first = 0, last = 0;  // last excluded
    bool empty() const { return first >= last; }
  };
  struct Box {
    const SurrogateBox* box;
    Range columns, rows;
    std::vector<double> basis;  // (highest degree + 1) x padded columns
  };

  static std::size_t padded(const Range& columns);
  static Range indices_in(const std::vector<double>& coordinates, double low, double high, bool with_high);
  void tabulate(Box& box) const;
  void contract_row(const GridPiece& piece, FactorRow& result) const;

  std::vector<double> x_, y_;  // axis coordinates
  std::vector<Box> boxes_;
};

}  // namespace strutt
