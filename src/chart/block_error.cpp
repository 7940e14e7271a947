#include "chart/block_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"

namespace strutt {
namespace {

/// A bound of a product of two factors, and of its error.
double product(const BlockRanges& x, std::size_t i, std::size_t j) {
  return x.largest_factors[i] * x.largest_factors[j];
}

double product_error(const BlockRanges& x, const CellRow& row, std::size_t i, std::size_t j) {
  const double a = x.largest_factors[i], b = x.largest_factors[j], ea = row.factor_error[i],
               eb = row.factor_error[j];
  return a * eb + b * ea + ea * eb + 16.0 * kUnit * a * b;
}

}  // namespace

BlockError block_error(const BlockRanges& x, const CellRow& row) {
  const double square = std::ldexp(1.0, static_cast<int>(2 * row.exponent));
  const double outer = product_error(x, row, 0, 3), inner = product_error(x, row, 2, 1), ea = outer + inner;
  const double ratio = 2.0 * x.kappa.largest / row.box_kappa,
               inverse_ratio = 2.0 * row.box_kappa / x.kappa.least;
  const double eb = ratio * product_error(x, row, 1, 3), eg = inverse_ratio * product_error(x, row, 0, 2);
  double error = std::max({2.0 * ea, eb, eg});
  double unit = square, of_trace_rounding = 8.0 * kUnit;
  if (row.damped) {
    const double h = x.h.largest, s = h / x.kappa.least * 0.5 * std::numbers::inv_pi;
    const double a = product(x, 0, 3) + product(x, 2, 1), b = ratio * product(x, 1, 3),
                 g = inverse_ratio * product(x, 0, 2);
    of_trace_rounding += 4.0 * kUnit * h;
    const double rounding = h > 0.0 ? of_trace_rounding : 0.0;
    error = std::max({2.0 * (ea + s * eb), eb, eg + 2.0 * s * ea + s * s * eb}) +
            rounding * std::max({b, a + s * b, g + s * s * b});
    unit *= std::exp(-x.h.least);
  }
  // The largest number of M is at least as large as that of the diagonal without damping, which adds to one
  // of its entries what it takes from the other. e unit/max(1, size unit) rises with the unit.
  const auto relative = [&](double e) { return e * unit / std::max(1.0, x.least_half_trace * unit); };
  BlockError result{relative(error) + 8.0 * kUnit, 4.0 * square * std::max(outer, inner)};
  if (row.shifted) result.monodromy = std::max(result.monodromy, relative(2.0 * ea) + of_trace_rounding);
  if (!std::isfinite(result.monodromy)) result.monodromy = kInfinity;
  return result;
}

}  // namespace strutt
