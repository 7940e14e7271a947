#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "strutt/base/error.hpp"

namespace strutt {

/// Throws InvalidInput, naming `field`, unless the orders of the harmonics are >= 1 and each is given only
/// once.
template <typename AnyHarmonic>
void require_orders(std::string_view field, const std::vector<AnyHarmonic>& harmonics) {
  std::set<int> seen;
  for (const auto& h : harmonics) {
    require(h.order >= 1, field, h.order, "an integer >= 1");
    require(seen.insert(h.order).second, field, h.order, "given only once");
  }
}

}  // namespace strutt
