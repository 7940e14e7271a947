#include "chart/cell_columns.hpp"

#include <cmath>
#include <limits>

#include "chart/hill_model.hpp"

namespace strutt {

void CellColumns::resize(std::size_t columns) {
  const std::size_t size = columns + kPadding;
  for (auto* values : {&h_, &kappa_square_})
    values->assign(size, std::numeric_limits<double>::quiet_NaN());  // equal to nothing
  for (auto* values : {&decay_, &half_sinh_, &sinh_, &cosh_, &half_over_cosh_, &kappa_, &inverse_kappa_})
    values->assign(size, 1.0);
}

void CellColumns::set(const ProductTable& half_damping, const ProductTable& kappa_square, std::size_t row,
                      std::size_t first_column, std::size_t columns) {
  if (complete_) return;
  if (h_.empty()) resize(half_damping.columns());
  complete_ = half_damping.same_in_all_rows() && kappa_square.same_in_all_rows();
  const std::size_t first = complete_ ? 0 : first_column,
                    last = complete_ ? half_damping.columns() : first_column + columns;
  set_damping(half_damping, row, first, last);
  set_kappa(kappa_square, row, first, last);
}

void CellColumns::set_damping(const ProductTable& half_damping, std::size_t row, std::size_t first,
                              std::size_t last) {
  for (std::size_t c = first; c < last; ++c) {
    const double h = half_damping(c, row);
    if (h == h_[c]) continue;
    h_[c] = h;
    const bool as_before = c > first && h == h_[c - 1];
    decay_[c] = as_before ? decay_[c - 1] : std::exp(-h);
    half_sinh_[c] = as_before ? half_sinh_[c - 1] : std::sinh(0.5 * h);
    sinh_[c] = as_before ? sinh_[c - 1] : std::sinh(h);
    cosh_[c] = as_before ? cosh_[c - 1] : std::cosh(h);
    half_over_cosh_[c] = 0.5 / cosh_[c];
  }
}

void CellColumns::set_kappa(const ProductTable& kappa_square, std::size_t row, std::size_t first,
                            std::size_t last) {
  for (std::size_t c = first; c < last; ++c) {
    const double square = kappa_square(c, row);
    if (square == kappa_square_[c]) continue;
    kappa_square_[c] = square;
    kappa_[c] = canonical_kappa(square);
    inverse_kappa_[c] = 1.0 / kappa_[c];
  }
}

void CellColumns::give(CellRow& row, std::size_t column) const {
  row.damping = {h_.data() + column,    decay_.data() + column, half_sinh_.data() + column,
                 sinh_.data() + column, cosh_.data() + column,  half_over_cosh_.data() + column};
  row.kappa = kappa_.data() + column;
  row.inverse_kappa = inverse_kappa_.data() + column;
}

}  // namespace strutt
