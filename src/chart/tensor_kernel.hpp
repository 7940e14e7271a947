#pragma once

#include <cstddef>

namespace strutt::detail {

/// Functions on a tensor grid as a product of matrices:
///   values[r * stride + c] = sum_k weights[k * weights_stride + r] basis[k * basis_stride + c],
/// r = 0 ... rows - 1, c = 0 ... columns - 1, summed from the last k to the first, so that small terms come
/// first.
struct TensorProduct {
  const double* basis;
  std::size_t basis_stride;
  const double* weights;
  std::size_t weights_stride;
  std::size_t rows, columns, terms;
  double* values;
  std::size_t stride;
};

/// With the instruction set of this process; every value has the same bits whatever stands beside it.
void evaluate(const TensorProduct& product);

}  // namespace strutt::detail
