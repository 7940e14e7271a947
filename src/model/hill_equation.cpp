#include "strutt/model/hill_equation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {

double HillEquation::period() const { return 2.0 * std::numbers::pi / angular_frequency; }

double HillEquation::delta() const { return coefficient.mean(); }

double HillEquation::epsilon() const {
  if (coefficient.harmonics().empty()) return coefficient.deviation();  // a constant or a square wave
  const auto& first = coefficient.harmonics().front();
  return first.order == 1 ? std::hypot(first.cosine, first.sine) : 0.0;
}

double HillEquation::canonical_damping() const { return damping / angular_frequency; }

double HillEquation::canonical_kappa() const {
  return plain_kappa ? 1.0 : std::max(1.0, std::sqrt(std::abs(delta())));
}

void HillEquation::validate() const {
  require(angular_frequency > 0.0 && std::isfinite(angular_frequency), "angular frequency", angular_frequency,
          "a finite number > 0");
  require(damping >= 0.0 && std::isfinite(damping), "damping", damping, "a finite number >= 0");
  const double bound = coefficient.bound();
  require(std::isfinite(bound), "coefficient of Hill's equation in canonical time", bound, "finite");
}

HillEquation mathieu_delta_epsilon(double delta, double epsilon, double damping) {
  const DefaultFloatingPoint environment;
  return {1.0, damping, PeriodicFunction::fourier(delta, {{1, epsilon, 0.0}})};
}

HillEquation mathieu_a_q(double a, double q, double damping) {
  const DefaultFloatingPoint environment;
  return {2.0, damping, PeriodicFunction::fourier(a / 4.0, {{1, -q / 2.0, 0.0}})};
}

HillEquation hill_equation(double period, const PeriodicFunction& w, double damping) {
  const DefaultFloatingPoint environment;
  require(period > 0.0 && std::isfinite(period), "period", period, "a finite number > 0");
  const double unit = period / (2.0 * std::numbers::pi);  // of canonical time
  auto canonical = w.scaled(unit * unit);
  if (w.mean() != 0.0 && canonical.mean() == 0.0) {  // an underflow must not prove that the mean is 0
    canonical = canonical.plus(std::copysign(std::numeric_limits<double>::denorm_min(), w.mean()));
  }
  // roundings: pi, the quotient and the square count twice each, the product once
  return {1.0 / unit, damping, canonical, 8.0 * 0x1p-53};
}

}  // namespace strutt
