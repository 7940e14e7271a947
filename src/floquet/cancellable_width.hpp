#pragma once

#include <atomic>

#include "strutt/floquet/tongue_width.hpp"

namespace strutt {

/// tongue_width(), given up between two eliminations when `cancel` says so: with the bounds that are known by
/// then. With many harmonics one elimination takes some 0.1 s and a width dozens of them.
TongueWidth cancellable_width(const PeriodicFunction& coefficient, const TongueEdges& edges,
                              double coefficient_error, const std::atomic<bool>* cancel);

}  // namespace strutt
