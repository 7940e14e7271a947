#include "chart/surrogate_scope.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "chart/hill_model.hpp"
#include "chart/product_table.hpp"
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

/// Whether damping and mean can be tabulated axis by axis.
bool has_tables(const Scene& scene, const Axis& x, const Axis& y, double even_phase) {
  HillModel model(scene, x, y, even_phase);
  const Axis few_x{x.parameter, x.from, x.to, 2, x.scale}, few_y{y.parameter, y.from, y.to, 2, y.scale};
  const auto is_product = [&](double PointEquation::*property) {
    const auto value = [&](double px, double py) {
      const auto point = model.at(px, py);
      return point ? (*point).*property : std::numeric_limits<double>::quiet_NaN();
    };
    return ProductTable::of(value, few_x, few_y).has_value();
  };
  return is_product(&PointEquation::half_damping) && is_product(&PointEquation::kappa_square);
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
  if (x.points < 2 || y.points < 2) {
    scope.refusal = "an axis has only one point";
    return scope;
  }
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
    if (scope.even_phase && !has_tables(scene, x, y, *scope.even_phase))
      scope.refusal =
          "damping or mean of the coefficient is not a product of functions of the two parameters";
  }
  return scope;
}

}  // namespace strutt
