#pragma once

#include <cstddef>

#include "strutt/integrate/hill_series.hpp"

namespace strutt::detail {

/// Half-period propagators of a group, and what becomes of them.
struct DiscriminantArrays {
  const HillPropagators* half;
  const double* mean;
  const double* const* weights;  // of functions that are at most 1
  int functions;
  double coefficient_error;  // relative, of W, times the length of the interval
  double *value, *error;     // see HillDiscriminants::compute
  std::size_t lanes;
};

/// With the instruction set of this process.
void combine(const DiscriminantArrays& arrays);

}  // namespace strutt::detail
