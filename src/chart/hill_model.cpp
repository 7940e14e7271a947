#include "chart/hill_model.hpp"

#include <cmath>
#include <numbers>

#include "base/constants.hpp"
#include "chart/surrogate_scope.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

HillModel::HillModel(const Scene& scene, const Axis& x, const Axis& y,
                     const std::optional<double>& even_phase)
    : scene_(scene),
      x_(&parameter(scene_, x.parameter)),
      y_(&parameter(scene_, y.parameter)),
      even_phase_(even_phase) {}

std::optional<PointEquation> HillModel::at(double x, double y) {
  *x_ = x;
  *y_ = y;
  std::optional<HillEquation> found;
  try {
    found = hill_equation_of(linear_model(scene_));
    if (found) found->validate();
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
  if (!found || is_square(found->coefficient)) return std::nullopt;
  if (even_phase_ && !is_even_about(found->coefficient, *even_phase_)) return std::nullopt;
  const double c = found->canonical_damping();
  PointEquation result;
  result.half_damping = c * std::numbers::pi;
  result.shifted = even_phase_.value_or(0.0) != 0.0;
  result.kappa = found->canonical_kappa();
  result.kappa_square = found->plain_kappa ? 0.0 : std::abs(found->coefficient.mean());
  const auto seen = even_phase_ ? found->coefficient.centred(*even_phase_) : found->coefficient;
  const auto w = seen.plus(-0.25 * c * c);
  double coefficient_error =
      found->coefficient_error + (even_phase_ ? found->coefficient.asymmetry(*even_phase_) : 0.0);
  if (c != 0.0) {  // the rounding of c^2/4 and of the difference, relative to what is left
    coefficient_error += (found->coefficient_error + 4.0 * kUnit) * (0.5 * c * c / w.bound() + 1.0);
  }
  result.equation = {1.0, 0.0, w, coefficient_error};
  return result;
}

PropagatorSample HillModel::sample(double x, double y, double tolerance, const std::atomic<bool>* cancel) {
  PropagatorSample result;
  const auto point = at(x, y);
  if (!point) return result;
  const Method method = point->equation.coefficient.is_constant() ? Method::exact : Method::propagator;
  const auto found =
      engine_.compute(point->equation, {.tolerance = tolerance, .method = method, .cancel = cancel});
  result.right_hand_sides = found.cost.right_hand_sides + found.estimate_cost.right_hand_sides;
  result.half_damping = point->half_damping;
  result.kappa = point->kappa;
  result.shifted = point->shifted;
  const bool has_value =
      found.outcome == Outcome::converged || found.outcome == Outcome::tolerance_not_reached;
  if (!has_value || (even_phase_ && !found.half)) return result;
  const BoundedMatrix2& propagator = even_phase_ ? *found.half : found.undamped;
  const auto canonical = at_kappa(propagator.value.mantissa, propagator.error, 1.0 / found.kappa);
  result.value = canonical.value;
  result.error = canonical.error;
  result.exponent = propagator.value.exponent;
  result.valid = true;
  return result;
}

}  // namespace strutt
