#pragma once

#include <cstddef>
#include <vector>

#include "chart/cell_row.hpp"
#include "chart/product_table.hpp"

namespace strutt {

/// What CellRow wants to know of the equations along a row, made of damping and kappa. Kept while the values
/// stay the same, which they mostly do from row to row or along a row.
class CellColumns {
 public:
  /// For some columns of a row.
  void set(const ProductTable& half_damping, const ProductTable& kappa_square, std::size_t row,
           std::size_t first_column, std::size_t columns);

  /// Lets the row point here, from `column` on; to the next multiple of kPadding cells there is something to
  /// read.
  void give(CellRow& row, std::size_t column) const;

 private:
  static constexpr std::size_t kPadding = 16;

  void resize(std::size_t columns);
  void set_damping(const ProductTable& half_damping, std::size_t row, std::size_t first, std::size_t last);
  void set_kappa(const ProductTable& kappa_square, std::size_t row, std::size_t first, std::size_t last);

  std::vector<double> h_, decay_, half_sinh_, sinh_, cosh_, half_over_cosh_, kappa_, kappa_square_,
      inverse_kappa_;
  bool complete_ = false;  // the same in all rows, and all set
};

}  // namespace strutt
