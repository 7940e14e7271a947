#pragma once

#include <optional>

#include "chart/certain_zero.hpp"
#include "strutt/chart/tongues.hpp"

namespace strutt {

/// Where on a line a system without excitation and damping has T (w_i + w_j) = 2 pi k, k = 1, 2, ..., for its
/// frequencies w_i: tongues of undamped systems begin there (Yakubovich, Starzhinskii 1975): through -1 for
/// i = j and odd k, through +1 for i = j and even k, with a complex pair for i != j. The nearest to `near`
/// within so much; nothing where the system is excited, damped, not symmetric or not positive definite.
std::optional<CertainZero> resting_resonance(const Scene& rest, const TongueLine& along, Mechanism mechanism,
                                             double near, double within);

}  // namespace strutt
