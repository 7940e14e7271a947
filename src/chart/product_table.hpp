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

 private:
  std::vector<double> columns_, rows_;
};

}  // namespace strutt
