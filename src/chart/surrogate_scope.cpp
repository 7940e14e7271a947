#include "chart/surrogate_scope.hpp"

#include <algorithm>
#include <vector>

#include "strutt/base/error.hpp"

namespace strutt {
namespace {

/// The phase about which all coefficients are even, 0 if all are constant.
std::optional<double> common_even_phase(const std::vector<PeriodicFunction>& coefficients) {
  const auto first =
      std::find_if(coefficients.begin(), coefficients.end(), [](const auto& w) { return !w.is_constant(); });
  const auto phase = first == coefficients.end() ? std::optional(0.0) : first->even_centre();
  const bool all = phase && std::all_of(coefficients.begin(), coefficients.end(),
                                        [&](const auto& w) { return is_even_about(w, *phase); });
  return all ? phase : std::nullopt;
}

SurrogateScope scope_of_systems(const std::vector<LinearModel>& models) {
  SurrogateScope scope;
  scope.is_system = true;
  bool inside = false;
  for (const auto& model : models) {
    const auto damping = damping_of(std::get<LinearPeriodicSystem>(model));
    scope.splits_damping = scope.splits_damping || damping == SystemDamping::split_off;
    inside = inside || damping == SystemDamping::inside;
  }
  if (inside && scope.splits_damping)
    scope.refusal = "the damping is proportional to the mass at some points only";
  return scope;
}

}  // namespace

std::optional<std::vector<LinearModel>> sampled_models(const Scene& scene, const Axis& x, const Axis& y) {
  Scene point = scene;
  const Axis few_x{x.parameter, x.from, x.to, 3, x.scale}, few_y{y.parameter, y.from, y.to, 3, y.scale};
  std::vector<LinearModel> models;
  for (const std::size_t j : {1, 0, 2}) {
    for (const std::size_t i : {1, 0, 2}) {
      parameter(point, x.parameter) = few_x.value(i);
      parameter(point, y.parameter) = few_y.value(j);
      try {
        models.push_back(linear_model(point));
      } catch (const InvalidInput&) {
        return std::nullopt;
      }
    }
  }
  return models;
}

std::optional<HillEquation> hill_equation_of(const LinearModel& model) {
  if (const auto* equation = std::get_if<HillEquation>(&model)) return *equation;
  return as_hill_equation(std::get<LinearPeriodicSystem>(model));
}

bool is_square(const PeriodicFunction& w) { return !w.is_constant() && w.harmonics().empty(); }

bool is_even_about(const PeriodicFunction& w, double phase) {
  return w.asymmetry(phase) <= 1e-15 * (1.0 + w.highest_order());
}

SystemDamping damping_of(const LinearPeriodicSystem& system) {
  if (!system.has_damping()) return SystemDamping::none;
  const auto c = system.proportional_damping();
  return c && *c > 0.0 ? SystemDamping::split_off : SystemDamping::inside;
}

SurrogateScope surrogate_scope(const Scene& scene, const Axis& x, const Axis& y) {
  SurrogateScope scope;
  const auto models = sampled_models(scene, x, y);
  if (!models) {
    scope.refusal = "the parameters do not make a model everywhere";
    return scope;
  }
  std::vector<PeriodicFunction> coefficients;
  for (const auto& model : *models) {
    if (const auto equation = hill_equation_of(model)) coefficients.push_back(equation->coefficient);
  }
  if (coefficients.empty()) return scope_of_systems(*models);
  if (coefficients.size() < models->size()) {
    scope.refusal = "the model is a Hill equation at some points only";
  } else if (std::any_of(coefficients.begin(), coefficients.end(), is_square)) {
    scope.refusal = "the coefficient is not smooth";
  } else {
    scope.even_phase = common_even_phase(coefficients);
    if (scope.even_phase) scope.kind = SurrogateKind::half_period;
  }
  return scope;
}

}  // namespace strutt
