#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {

struct CertainZero {
  double position;
  double error;  ///< bound of |position - true|: on both sides the sign is certain from there on
};

/// The change of sign of a function that is known with bounds (Margin f(double)) between low < high; nothing
/// unless its signs there are certain and opposite.
template <typename Function>
std::optional<CertainZero> certain_zero(const Function& f, double low, double high) {
  const Margin at_low = f(low), at_high = f(high);
  const auto certain = [](const Margin& m) { return std::abs(m.value) > m.error; };
  if (!certain(at_low) || !certain(at_high) || at_low.value * at_high.value > 0.0) return std::nullopt;
  const double position = bracketed_zero([&](double p) { return f(p).value; }, low, high, at_low.value,
                                         at_high.value, boost::math::tools::eps_tolerance<double>(52))
                              .middle();
  const auto distance_to = [&](double end, double sign) {
    return certain_distance(position, end, [&](double p) {
      const Margin m = f(p);
      return certain(m) && m.value * sign > 0.0;
    });
  };
  return CertainZero{position, std::max(distance_to(low, at_low.value), distance_to(high, at_high.value)) +
                                   kUnit * std::abs(position)};
}

}  // namespace strutt
