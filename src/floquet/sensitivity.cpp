#include "strutt/floquet/sensitivity.hpp"

#include <cmath>
#include <numbers>

#include "floquet/hill_sensitivity.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

bool has_entry(const Eigen::MatrixXd& m) { return m.size() > 0 && m(0, 0) != 0.0; }

double entry(const Eigen::MatrixXd& m) { return m.size() > 0 ? m(0, 0) : 0.0; }

/// Of W = (T/2 pi)^2 K/m and c = C/m. Nothing where the damping becomes periodic.
std::optional<HillDerivative> as_hill_derivative(const LinearPeriodicSystem& system,
                                                 const HillEquation& equation, const SystemDerivative& by) {
  for (const auto& h : by.damping.harmonics)
    if (has_entry(h.cosine) || has_entry(h.sine)) return std::nullopt;
  const double mass = system.mass(0, 0), stretch = by.period / system.period,
               mass_rate = entry(by.mass) / mass;
  HillDerivative result{.angular_frequency = -equation.angular_frequency * stretch,
                        .damping = entry(by.damping.mean) / mass - equation.damping * mass_rate,
                        .coefficient = equation.coefficient.scaled(2.0 * stretch - mass_rate)};
  const bool stiffness_moves = !by.stiffness.is_zero();
  if (!stiffness_moves) return result;
  const double unit = system.period / (2.0 * std::numbers::pi), factor = unit * unit / mass;
  std::vector<Harmonic> harmonics;
  for (const auto& h : by.stiffness.harmonics)
    harmonics.push_back({h.order, factor * entry(h.cosine), factor * entry(h.sine)});
  result.coefficient = PeriodicFunction::fourier(factor * entry(by.stiffness.mean), std::move(harmonics));
  return result;
}

}  // namespace

Sensitivity sensitivity(MonodromyEngine& engine, const Scene& scene, std::string_view path,
                        const MonodromyOptions& options) {
  const DefaultFloatingPoint environment;
  options.validate();
  const ModelDerivative derivative = model_derivative(scene, path);
  const LinearModel model = linear_model(scene);
  if (const auto* equation = std::get_if<HillEquation>(&model))
    return hill_sensitivity(engine, *equation, std::get<HillDerivative>(derivative), options);
  const auto& system = std::get<LinearPeriodicSystem>(model);
  const auto& by = std::get<SystemDerivative>(derivative);
  if (const auto equation = as_hill_equation(system))
    if (const auto hill = as_hill_derivative(system, *equation, by))
      return hill_sensitivity(engine, *equation, *hill, options);
  return system_sensitivity(engine, system, by, options);
}

Derivative edge_shift(MonodromyEngine& engine, const Scene& on_edge, std::string_view along,
                      std::string_view by, const MonodromyOptions& options) {
  const DefaultFloatingPoint environment;
  if (along == by) return {0.0, 0.0};
  const Derivative across = sensitivity(engine, on_edge, along, options).edge,
                   moved = sensitivity(engine, on_edge, by, options).edge;
  const double shift = -moved.value / across.value;
  if (!std::isfinite(shift)) return {};
  const double relative = across.error / std::abs(across.value);
  return {shift, moved.error / std::abs(across.value) + std::abs(shift) * (relative + 0x1p-51)};
}

}  // namespace strutt
