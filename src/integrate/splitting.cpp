#include "integrate/splitting.hpp"

#include <array>
#include <string>

#include "strutt/base/error.hpp"

namespace strutt::detail {
namespace {

// Blanes, Moan, J. Comput. Appl. Math. 142 (2002) 313-330, table 3: SRKN 6b and SRKN 11b. The middle
// coefficients are what makes the sums 1.
constexpr double kA6[] = {0.245298957184271, 0.604872665711080};
constexpr double kB6[] = {0.0829844064174052, 0.396309801498368, -0.0390563049223486};
constexpr double kA11[] = {0.123229775946271, 0.290553797799558, -0.127049212625417, -0.246331761062075,
                           0.357208872795928};
constexpr double kB11[] = {0.0414649985182624, 0.198128671918067, -0.0400061921041533, 0.0752539843015807,
                           -0.0115113874206879};

constexpr double half_rest(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return 0.5 - sum;
}

constexpr std::array kDrifts4{kA6[0], kA6[1], half_rest(kA6), half_rest(kA6), kA6[1], kA6[0]};
constexpr std::array kKicks4{kB6[0], kB6[1], kB6[2], 2.0 * half_rest(kB6), kB6[2], kB6[1], kB6[0]};
constexpr std::array kDrifts6{kA11[0], kA11[1], kA11[2], kA11[3], kA11[4], 2.0 * half_rest(kA11),
                              kA11[4], kA11[3], kA11[2], kA11[1], kA11[0]};
constexpr std::array kKicks6{kB11[0],         kB11[1], kB11[2], kB11[3], kB11[4], half_rest(kB11),
                             half_rest(kB11), kB11[4], kB11[3], kB11[2], kB11[1], kB11[0]};

constexpr std::array<Splitting, 2> kSplittings{{{4, kKicks4, kDrifts4, 3e-5}, {6, kKicks6, kDrifts6, 8e-8}}};

}  // namespace

const Splitting& splitting(int order) {
  for (const auto& row : kSplittings) {
    if (row.order == order) return row;
  }
  throw InvalidInput("order", std::to_string(order), "4 or 6");
}

}  // namespace strutt::detail
