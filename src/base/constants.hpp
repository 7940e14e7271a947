#pragma once

#include <limits>

namespace strutt {

/// 2^-53: the most that rounding changes a number by, relative to it.
inline constexpr double kUnit = 0x1p-53;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace strutt
