#include "floquet/half_period_factors.hpp"

#include <cmath>
#include <numbers>

namespace strutt {

double quadrant(const HalfPeriodFactors& factors, double quarter_turns) {
  const double pattern = sign_quadrant(factors.value[1], factors.value[3]);
  return pattern + 4.0 * std::round((quarter_turns - (pattern + 0.5)) / 4.0);
}

double winding_number(const HalfPeriodFactors& factors, const DiscriminantGap& discriminant,
                      double quadrant) {
  const double parity = discriminant.sign > 0 ? 0.0 : 1.0;
  const bool odd = std::fmod(quadrant, 2.0) != 0.0;
  if (discriminant.gap <= 0.0) return 0.5 * (quadrant + (odd == (parity == 1.0) ? 0.0 : 1.0));
  const auto& f = factors.value;
  const double angle =
      std::atan2(std::sqrt(std::abs(f[1] * f[2])), std::sqrt(std::abs(f[0] * f[3]))) / std::numbers::pi;
  return odd ? 0.5 * (quadrant + 1.0) - angle : 0.5 * quadrant + angle;
}

}  // namespace strutt
