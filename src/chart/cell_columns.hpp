#pragma once

#include <array>
#include <limits>
#include <vector>

#include "chart/cell_row.hpp"
#include "chart/product_table.hpp"

namespace strutt {

/// What CellRow wants to know of the equations along a row, made of damping and kappa. Kept while the values
/// stay the same, which they mostly do from row to row or along a row.
class CellColumns {
 public:
  void set(const ProductTable& half_damping, const ProductTable& kappa_square, std::size_t row,
           std::size_t first_column, std::size_t columns);

  /// Lets the row point here.
  void give(CellRow& row) const;

 private:
  using Column = std::array<double, CellRow::kMost>;

  void set_damping(const ProductTable& half_damping, std::size_t row, std::size_t first_column,
                   std::size_t columns);
  void set_kappa(const ProductTable& kappa_square, std::size_t row, std::size_t first_column,
                 std::size_t columns);

  Column h_, decay_, half_sinh_, sinh_, cosh_, half_over_cosh_, kappa_, kappa_square_, inverse_kappa_;
  bool is_new_ = true;
};

}  // namespace strutt
