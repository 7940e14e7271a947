#include "strutt/model/linearisation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

// Roundings between the inputs and a coefficient of W: alpha^2 (3), omega^2 (1), their quotient (1), the
// harmonic (3).
constexpr double kCoefficientError = 8.0 * 0x1p-53;

}  // namespace

LinearisedPendulum linearise(const PhysicalPendulum& pendulum, Equilibrium about, const Excitation* support,
                             const Excitation* moment) {
  const DefaultFloatingPoint environment;
  pendulum.validate();
  const double sign = about == Equilibrium::hanging ? 1.0 : -1.0;
  const double alpha_squared = pendulum.alpha_squared();
  LinearisedPendulum result;
  HillEquation& equation = result.equation;
  equation.damping = pendulum.damping;
  if (support == nullptr) {
    equation.angular_frequency = std::sqrt(alpha_squared);
    equation.coefficient = PeriodicFunction::constant(sign);  // exactly: the phase is alpha t
  } else {
    const double omega = support->frequency;
    require(omega > 0.0 && std::isfinite(omega), "support.frequency", omega, "a finite number > 0");
    equation.angular_frequency = omega;
    // An underflow must not prove that delta is 0.
    const double delta = std::max(alpha_squared / (omega * omega), std::numeric_limits<double>::denorm_min());
    const auto acceleration = support->function.derivative().derivative();  // per theta^2
    equation.coefficient = acceleration.scaled(sign * (alpha_squared / pendulum.gravity)).plus(sign * delta);
    equation.coefficient_error = kCoefficientError;
  }
  equation.validate();
  if (moment != nullptr) {
    if (support != nullptr && moment->frequency != support->frequency && !moment->function.is_constant()) {
      throw InvalidInput("moment.frequency", to_text(moment->frequency), "that of the support");
    }
    result.forcing = moment->function.scaled(1.0 / pendulum.inertia);
  }
  return result;
}

}  // namespace strutt
