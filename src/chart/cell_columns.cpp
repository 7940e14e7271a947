#include "chart/cell_columns.hpp"

#include <algorithm>
#include <cmath>

namespace strutt {

void CellColumns::set(const ProductTable& half_damping, const ProductTable& kappa_square, std::size_t row,
                      std::size_t first_column, std::size_t columns) {
  if (is_new_) {
    h_.fill(std::numeric_limits<double>::quiet_NaN());  // equal to nothing
    kappa_square_ = h_;
    for (auto* values : {&decay_, &half_sinh_, &sinh_, &cosh_, &half_over_cosh_, &kappa_, &inverse_kappa_})
      values->fill(1.0);
    is_new_ = false;
  }
  set_damping(half_damping, row, first_column, columns);
  set_kappa(kappa_square, row, first_column, columns);
}

void CellColumns::set_damping(const ProductTable& half_damping, std::size_t row, std::size_t first_column,
                              std::size_t columns) {
  for (std::size_t c = 0; c < columns; ++c) {
    const double h = half_damping(first_column + c, row);
    if (h == h_[c]) continue;
    h_[c] = h;
    const bool as_before = c > 0 && h == h_[c - 1];
    decay_[c] = as_before ? decay_[c - 1] : std::exp(-h);
    half_sinh_[c] = as_before ? half_sinh_[c - 1] : std::sinh(0.5 * h);
    sinh_[c] = as_before ? sinh_[c - 1] : std::sinh(h);
    cosh_[c] = as_before ? cosh_[c - 1] : std::cosh(h);
    half_over_cosh_[c] = 0.5 / cosh_[c];
  }
}

void CellColumns::set_kappa(const ProductTable& kappa_square, std::size_t row, std::size_t first_column,
                            std::size_t columns) {
  for (std::size_t c = 0; c < columns; ++c) {
    const double square = kappa_square(first_column + c, row);
    if (square == kappa_square_[c]) continue;
    kappa_square_[c] = square;
    kappa_[c] = std::max(1.0, std::sqrt(square));
    inverse_kappa_[c] = 1.0 / kappa_[c];
  }
}

void CellColumns::give(CellRow& row) const {
  row.damping = {h_.data(),    decay_.data(), half_sinh_.data(),
                 sinh_.data(), cosh_.data(),  half_over_cosh_.data()};
  row.kappa = kappa_.data();
  row.inverse_kappa = inverse_kappa_.data();
}

}  // namespace strutt
