#include "chart/half_period_model.hpp"

#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;

std::optional<HillEquation> hill_equation_of(const LinearModel& model) {
  if (const auto* equation = std::get_if<HillEquation>(&model)) return *equation;
  return as_hill_equation(std::get<LinearPeriodicSystem>(model));
}

bool is_square(const PeriodicFunction& w) { return !w.is_constant() && w.harmonics().empty(); }

/// As in PeriodicFunction::even_centre: what is left of the sines is rounding.
bool is_even_about(const PeriodicFunction& w, double phase) {
  return w.asymmetry(phase) <= 1e-15 * (1.0 + w.highest_order());
}

}  // namespace

EvenPoint even_point(const Scene& scene, const Axis& x, const Axis& y) {
  Scene point = scene;
  std::optional<double> phase;
  const Axis middle_x{x.parameter, x.from, x.to, 3, x.scale}, middle_y{y.parameter, y.from, y.to, 3, y.scale};
  std::vector<PeriodicFunction> coefficients;
  for (const std::size_t j : {1, 0, 2}) {
    for (const std::size_t i : {1, 0, 2}) {
      parameter(point, x.parameter) = middle_x.value(i);
      parameter(point, y.parameter) = middle_y.value(j);
      std::optional<HillEquation> equation;
      try {
        equation = hill_equation_of(linear_model(point));
      } catch (const InvalidInput&) {
        return {0.0, "the parameters do not make a model everywhere"};
      }
      if (!equation) return {0.0, "the model is not a Hill equation"};
      const auto& w = equation->coefficient;
      if (is_square(w)) return {0.0, "the coefficient is not smooth"};
      if (!phase && !w.is_constant()) {
        phase = w.even_centre();
        if (!phase) return {0.0, "the coefficient is not even about any phase"};
      }
      coefficients.push_back(w);
    }
  }
  for (const auto& w : coefficients) {
    if (phase && !is_even_about(w, *phase))
      return {0.0, "the phase about which the coefficient is even changes"};
  }
  return {phase.value_or(0.0), ""};
}

HalfPeriodModel::HalfPeriodModel(const Scene& scene, const Axis& x, const Axis& y, double even_phase)
    : scene_(scene),
      x_(&parameter(scene_, x.parameter)),
      y_(&parameter(scene_, y.parameter)),
      even_phase_(even_phase) {}

std::optional<CentredEquation> HalfPeriodModel::at(double x, double y) {
  *x_ = x;
  *y_ = y;
  std::optional<HillEquation> found;
  try {
    found = hill_equation_of(linear_model(scene_));
    if (found) found->validate();
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
  if (!found || is_square(found->coefficient) || !is_even_about(found->coefficient, even_phase_))
    return std::nullopt;
  const double c = found->canonical_damping();
  CentredEquation result;
  result.half_damping = c * std::numbers::pi;
  result.shifted = even_phase_ != 0.0;
  result.kappa = found->canonical_kappa();
  result.kappa_square = found->plain_kappa ? 0.0 : std::abs(found->coefficient.mean());
  const auto w = found->coefficient.centred(even_phase_).plus(-0.25 * c * c);
  double coefficient_error = found->coefficient_error + found->coefficient.asymmetry(even_phase_);
  if (c != 0.0) {  // the rounding of c^2/4 and of the difference, relative to what is left
    coefficient_error += (found->coefficient_error + 4.0 * kUnit) * (0.5 * c * c / w.bound() + 1.0);
  }
  result.equation = {1.0, 0.0, w, coefficient_error};
  return result;
}

HalfPeriodSample HalfPeriodModel::sample(double x, double y, double tolerance,
                                         const std::atomic<bool>* cancel) {
  HalfPeriodSample result;
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
  if (!has_value || !found.half) return result;
  const auto& m = found.half->value.mantissa;
  const auto& e = found.half->error;
  const double k = found.kappa;
  result.value = {m(0, 0), m(0, 1) / k, m(1, 0) * k, m(1, 1)};
  result.error = {e(0, 0), e(0, 1) / k, e(1, 0) * k, e(1, 1)};
  for (const std::size_t i : {1, 2}) result.error[i] += 2.0 * kUnit * std::abs(result.value[i]);
  result.exponent = found.half->value.exponent;
  result.valid = true;
  return result;
}

}  // namespace strutt
