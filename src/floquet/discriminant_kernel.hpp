#pragma once

#include <cstddef>

#include "strutt/integrate/hill_propagator.hpp"

namespace strutt::detail {

/// Half-period propagators of a group, with all steps and with half of them, and what becomes of them.
struct DiscriminantArrays {
  const HillPropagators* full;
  const HillPropagators* half;
  const double* mean;
  const double* bound;       // of |W|
  double share;              // of |full - half| that bounds the truncation
  double rounding;           // of a propagator, relative to its largest entry
  double coefficient_error;  // relative, of W
  double *value, *error;     // see HillDiscriminants::compute
  std::size_t lanes;
};

/// With the instruction set of this process.
void combine(const DiscriminantArrays& arrays);

}  // namespace strutt::detail
