#pragma once

#include "strutt/chart/tongues.hpp"

namespace strutt {

/// Throws InvalidInput for a line that is not finite or not from < to, or a scene that does not validate at
/// both ends.
void require_line(const Scene& scene, const TongueLine& line);

}  // namespace strutt
