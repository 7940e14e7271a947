#pragma once

#include <cstddef>

namespace strutt::detail {

/// Functions along a row of a tensor grid:
///   values[f * stride + c] = sum_k weights[f * terms + k] basis[k * basis_stride + c],   c = 0 ... columns -
///   1,
/// summed from the last k to the first, so that small terms come first.
struct TensorRow {
  const double* basis;
  std::size_t basis_stride;
  const double* weights;
  std::size_t functions, terms;
  double* values;
  std::size_t stride;
  std::size_t columns;  ///< a multiple of kTensorColumns
};
inline constexpr std::size_t kTensorColumns = 64;

/// With the instruction set of this process; every value has the same bits whatever stands beside it.
void evaluate(const TensorRow& row);

}  // namespace strutt::detail
