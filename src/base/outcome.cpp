#include "strutt/base/outcome.hpp"

#include <array>

namespace strutt {

std::string_view to_string(Outcome outcome) {
  static constexpr std::array<std::string_view, kOutcomeCount> names = {
      "converged",      "tolerance_not_reached",
      "step_limit",     "time_limit",
      "step_underflow", "non_finite",
      "cancelled",      "failed"};
  return names[static_cast<std::size_t>(outcome)];
}

}  // namespace strutt
