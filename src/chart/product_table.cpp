#include "chart/product_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/constants.hpp"

namespace strutt {
namespace {

constexpr double kSameProduct = 1e-13;

bool all_equal(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); });
}

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

double smallest_of(const std::vector<double>& values) {
  double smallest = kInfinity;
  for (const double v : values) smallest = std::min(smallest, std::abs(v));
  return smallest;
}

}  // namespace

std::optional<ProductTable> ProductTable::of(const Function& g, const Axis& x, const Axis& y) {
  // the reference is where g is largest, so that it is not 0 unless g is
  double x0 = x.from, y0 = y.from, largest = 0.0;
  for (const double a : {x.from, x.to}) {
    for (const double b : {y.from, y.to}) {
      const double value = std::abs(g(a, b));
      if (!(value > largest)) continue;
      largest = value;
      x0 = a;
      y0 = b;
    }
  }
  const double reference = g(x0, y0);
  for (const double a : {x.from, std::midpoint(x.from, x.to), x.to}) {
    for (const double b : {y.from, std::midpoint(y.from, y.to), y.to}) {
      if (!(std::abs(g(a, b) * reference - g(a, y0) * g(x0, b)) <= kSameProduct * reference * reference))
        return std::nullopt;
    }
  }
  ProductTable result;
  for (std::size_t i = 0; i < x.points; ++i)
    result.columns_.push_back(largest > 0.0 ? g(x.value(i), y0) : 0.0);
  for (std::size_t j = 0; j < y.points; ++j)
    result.rows_.push_back(largest > 0.0 ? g(x0, y.value(j)) / reference : 0.0);
  result.same_in_all_rows_ = all_equal(result.rows_);
  result.same_in_all_columns_ = all_equal(result.columns_);
  result.largest_ = largest_of(result.columns_) * largest_of(result.rows_);
  result.smallest_ = smallest_of(result.columns_) * smallest_of(result.rows_);
  return result;
}

}  // namespace strutt
