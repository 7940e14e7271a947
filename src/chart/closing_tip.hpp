#pragma once

#include <atomic>
#include <optional>

#include "chart/damped_line.hpp"
#include "chart/edge_function.hpp"
#include "strutt/chart/closing_damping.hpp"

namespace strutt {

// The tip of a tongue on a line under damping, between whose undamped edges it begins: position, damping,
// error and method of closing_damping().

/// By the monodromy matrix; for thin tongues its error is large.
ClosingDamping tip_by_multipliers(DampedLine& damped, const TongueLine& line, const TongueEdge& low,
                                  const TongueEdge& high, const std::atomic<bool>* cancel);

/// By the width in the mean; nothing where the tongue is not thin.
std::optional<ClosingDamping> tip_by_width(DampedLine& damped, LineEquation& equation, const TongueLine& line,
                                           const TongueEdge& low, const TongueEdge& high);

}  // namespace strutt
