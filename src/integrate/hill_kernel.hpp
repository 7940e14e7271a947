#pragma once

#include <cstddef>

namespace strutt::detail {

/// The tables of a HillPropagator and the data of a batch, for the kernels.
struct HillSweep {
  const double* drift;  // a h
  const double* kick;   // b h
  const double* basis;  // b h f_j, kick by kick
  std::size_t stages;   // drifts; one kick more
  int functions;
  const double* mean;
  const double* const* weights;
  double *u1, *du1, *u2, *du2;
  long* exponent;
  std::size_t lanes;
};

/// Integrates all lanes with the instruction set of this process.
void sweep(const HillSweep& batch);

}  // namespace strutt::detail
