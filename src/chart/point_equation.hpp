#pragma once

#include <optional>

#include "chart/propagator_sample.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// What turns an interpolated propagator into the monodromy of a point: the sample without its propagator.
struct PointScale {
  PropagatorSample sample;  ///< half_damping, kappa (canonical), shifted
  double angular_frequency = 1.0;
};

/// Nothing where a surrogate about this phase (or of a system) does not fit the model.
std::optional<PointScale> point_equation(const LinearModel& model, const std::optional<double>& even_phase);

}  // namespace strutt
