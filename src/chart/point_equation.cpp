#include "chart/point_equation.hpp"

#include <cmath>
#include <numbers>

#include "chart/surrogate_scope.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

PointScale of_system(const LinearPeriodicSystem& system) {
  PointScale result;
  result.angular_frequency = 2.0 * pi / system.period;
  if (damping_of(system) == SystemDamping::split_off)
    result.sample.half_damping = *system.proportional_damping() * (system.period / (2.0 * pi)) * pi;
  return result;
}

}  // namespace

std::optional<PointScale> point_equation(const LinearModel& model, const std::optional<double>& even_phase) {
  const auto equation = hill_equation_of(model);
  if (!equation) return of_system(std::get<LinearPeriodicSystem>(model));
  if (is_square(equation->coefficient)) return std::nullopt;
  if (even_phase && !is_even_about(equation->coefficient, *even_phase)) return std::nullopt;
  PointScale result;
  result.sample.half_damping = equation->canonical_damping() * pi;
  result.sample.kappa = equation->canonical_kappa();
  result.sample.shifted = even_phase.value_or(0.0) != 0.0;
  result.angular_frequency = equation->angular_frequency;
  return result;
}

}  // namespace strutt
