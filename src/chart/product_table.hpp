#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "strutt/chart/axis.hpp"

namespace strutt {

/// A function of the two parameters of a chart that is a product of one of x and one of y, tabulated over
/// both axes.
class ProductTable {
 public:
  using Function = std::function<double(double x, double y)>;

  /// Nothing if the function is no such product (seen at three values of each parameter). NaN is kept.
  static std::optional<ProductTable> of(const Function& g, const Axis& x, const Axis& y);

  /// g at column i, row j, with a relative error of at most 2 units in the last place more than g itself has.
  double operator()(std::size_t i, std::size_t j) const { return columns_[i] * rows_[j]; }

  std::size_t columns() const { return columns_.size(); }
  bool same_in_all_rows() const { return same_in_all_rows_; }
  bool same_in_all_columns() const { return same_in_all_columns_; }
  double largest() const { return largest_; }    ///< bound of the absolute values
  double smallest() const { return smallest_; }  ///< the same from below

 private:
  std::vector<double> columns_, rows_;
  bool same_in_all_rows_ = false, same_in_all_columns_ = false;
  double largest_ = 0.0, smallest_ = 0.0;
};

}  // namespace strutt
