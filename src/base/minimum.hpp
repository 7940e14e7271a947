#pragma once

#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>

namespace strutt {

/// Where a function is least, and its value there.
struct Minimum {
  double place, value;
};

/// The minimum of a function with one between low and high, to 2^-bits of their distance (Brent 1973, chapter
/// 5): a double cannot tell more than half of its digits there. Brent's tolerance is one of the variable,
/// which therefore is the share of the way.
template <typename Function>
Minimum least_between(const Function& f, double low, double high, int bits = 30) {
  std::uintmax_t most = 60;
  const auto [share, value] = boost::math::tools::brent_find_minima(
      [&](double x) { return f(std::lerp(low, high, x)); }, 0.0, 1.0, bits, most);
  return {std::lerp(low, high, share), value};
}

}  // namespace strutt
