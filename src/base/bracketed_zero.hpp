#pragma once

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/constants.hpp"

namespace strutt {

/// Two places close together between which a function changes its sign.
struct ZeroBracket {
  double low, high;

  double middle() const { return std::midpoint(low, high); }
};

/// When a bracket is small enough: its ends are the same double or neighbours.
inline bool are_neighbours(double a, double b) { return std::nextafter(a, b) == b || a == b; }

/// When a bracket is small enough: its ends differ by about a rounding.
inline bool are_close(double a, double b) { return std::abs(b - a) <= 2.0 * kUnit * std::abs(a + b); }

/// The sign change of f between low < high, where f(low) = at_low and f(high) = at_high have opposite signs
/// or are 0, enclosed by Algorithm 748 (Alefeld, Potra, Shi 1995) until close(low, high), in at most `most`
/// evaluations.
template <typename Function, typename Close>
ZeroBracket bracketed_zero(const Function& f, double low, double high, double at_low, double at_high,
                           const Close& close, std::uintmax_t most = 100) {
  const auto [a, b] = boost::math::tools::toms748_solve(f, low, high, at_low, at_high, close, most);
  return {a, b};
}

/// How far one must go from a place towards `end` until certain(place): steps doubled from `first` > 0 on;
/// the whole way where it is nowhere certain before.
template <typename Certain>
double certain_distance(double place, double end, double first, const Certain& certain) {
  const double whole = std::abs(end - place);
  for (double distance = first; distance < whole; distance *= 2.0)
    if (certain(place + std::copysign(distance, end - place))) return distance;
  return whole;
}

/// The same with steps from the rounding of both places on.
template <typename Certain>
double certain_distance(double place, double end, const Certain& certain) {
  return certain_distance(place, end, kUnit * std::max(std::abs(place), std::abs(end - place)), certain);
}

}  // namespace strutt
