#pragma once

#include "strutt/floquet/sensitivity.hpp"
#include "strutt/model/model_derivative.hpp"

namespace strutt {

Sensitivity hill_sensitivity(MonodromyEngine& engine, const HillEquation& equation,
                             const HillDerivative& derivative, const MonodromyOptions& options);

Sensitivity system_sensitivity(MonodromyEngine& engine, const LinearPeriodicSystem& system,
                               const SystemDerivative& derivative, const MonodromyOptions& options);

/// The monodromy matrix of (q, dq/dp) in canonical time.
Monodromy augmented_monodromy(MonodromyEngine& engine, const LinearPeriodicSystem& canonical,
                              const SystemDerivative& derivative, const MonodromyOptions& options);

/// N and its derivative in the state (Y, Y') of canonical time, both times 2^exponent, with entrywise bounds.
struct HillVariation {
  Eigen::Matrix2d n, n_error, dn, dn_error;
  long exponent = 0;
  Outcome outcome = Outcome::failed;
};

/// Of Y'' + W Y = 0 in the direction dW of its coefficient.
HillVariation hill_variation(MonodromyEngine& engine, const PeriodicFunction& w, const PeriodicFunction& dw,
                             const MonodromyOptions& options);

/// The same with both piecewise constant, in closed form.
HillVariation square_variation(const PeriodicFunction& w, const PeriodicFunction& dw);

}  // namespace strutt
