#include "strutt/model/model_derivative.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "model/parameter_table.hpp"

namespace strutt {
namespace {

/// The scene in which nothing but this parameter, which is 1, drives the coefficient: the direction of a
/// linear one.
Scene unit_direction(Scene scene, std::string_view path, const std::string& table) {
  for (const auto& entry : parameter_table(scene)) {
    const bool drives = entry.info.path.starts_with(table + ".harmonics.") ||
                        entry.info.path == table + ".amplitude" || entry.info.path == table + ".mean";
    if (drives) *entry.value = entry.info.path == path ? 1.0 : 0.0;
  }
  return scene;
}

PeriodicFunction coefficient_of(const Scene& scene) {
  return std::get<HillEquation>(linear_model(scene)).coefficient;
}

HillDerivative mathieu_derivative(const MathieuTable& m, std::string_view path) {
  if (path == "mathieu.damping") return {.damping = 1.0, .coefficient = {}};
  if (path == "mathieu.delta") return {.coefficient = PeriodicFunction::constant(1.0)};
  if (path == "mathieu.a") return {.coefficient = PeriodicFunction::constant(0.25)};
  return {.coefficient = PeriodicFunction::fourier(0.0, {{1, m.mathieu_form ? -0.5 : 1.0, 0.0}})};
}

HillDerivative hill_derivative(const Scene& scene, std::string_view path) {
  const HillTable& h = *scene.hill;
  if (path == "hill.damping") return {.damping = 1.0, .coefficient = {}};
  if (path == "hill.period")  // W = w T^2/(4 pi^2)
    return {.angular_frequency = -2.0 * std::numbers::pi / (h.period * h.period),
            .coefficient = coefficient_of(scene).scaled(2.0 / h.period)};
  return {.coefficient = coefficient_of(unit_direction(scene, path, "hill"))};
}

/// The derivatives of ln(alpha^2) and of ln(alpha^2/g).
struct LogarithmicRates {
  double delta = 0.0;
  double epsilon = 0.0;
};

LogarithmicRates rates_of(const PendulumTable& p, std::string_view path) {
  const bool body = p.shape == PendulumTable::Shape::body;
  if (path == "pendulum.gravity") return {1.0 / p.gravity, 0.0};
  double rate = 0.0;
  if (path == "pendulum.mass" && body) rate = 1.0 / p.mass;
  if (path == "pendulum.inertia") rate = -1.0 / p.inertia;
  if (path == "pendulum.centroid") rate = 1.0 / p.centroid;
  if (path == "pendulum.length") rate = -1.0 / p.length;
  return {rate, rate};
}

/// W = +-(alpha^2/omega^2 + (alpha^2/g) d^2 r/dtheta^2); without a support W = +-1 and Omega = alpha.
HillDerivative pendulum_derivative(const Scene& scene, std::string_view path) {
  if (path == "pendulum.damping") return {.damping = 1.0, .coefficient = {}};
  const LogarithmicRates rates = rates_of(*scene.pendulum, path);
  if (!scene.support)
    return {.angular_frequency = 0.5 * rates.delta * pendulum(scene).alpha(), .coefficient = {}};
  const PeriodicFunction w = coefficient_of(scene);
  if (path == "support.frequency")
    return {.angular_frequency = 1.0,
            .coefficient = PeriodicFunction::constant(-2.0 * w.mean() / scene.support->frequency)};
  const bool drives = path == "support.amplitude" || path.starts_with("support.harmonics.");
  if (drives) {
    const PeriodicFunction unit = coefficient_of(unit_direction(scene, path, "support"));
    return {.coefficient = unit.plus(-unit.mean())};
  }
  return {.coefficient = w.plus(-w.mean()).scaled(rates.epsilon).plus(rates.delta * w.mean())};
}

void set_zero(Eigen::MatrixXd& matrix) {
  if (matrix.size() > 0) matrix.setZero();
}

void set_zero(PeriodicMatrix& matrix) {
  set_zero(matrix.mean);
  for (auto& h : matrix.harmonics) {
    set_zero(h.cosine);
    set_zero(h.sine);
  }
}

SystemDerivative linear_derivative(const Scene& scene, std::string_view path) {
  Scene direction;
  direction.linear = scene.linear;
  auto& system = *direction.linear;
  system.period = 0.0;
  set_zero(system.mass);
  set_zero(system.damping);
  set_zero(system.stiffness);
  parameter(direction, path) = 1.0;
  return {system.period, system.mass, system.damping, system.stiffness};
}

}  // namespace

ModelDerivative model_derivative(const Scene& scene, std::string_view path) {
  parameter_info(scene, path);  // throws for an unknown one
  if (scene.linear) return linear_derivative(scene, path);
  if (scene.mathieu) return mathieu_derivative(*scene.mathieu, path);
  if (scene.hill) return hill_derivative(scene, path);
  return pendulum_derivative(scene, path);
}

bool moves_stability(const Scene& scene, std::string_view path) {
  const auto derivative = model_derivative(scene, path);
  const auto* hill = std::get_if<HillDerivative>(&derivative);
  if (hill == nullptr) return true;
  return hill->angular_frequency != 0.0 || hill->damping != 0.0 || hill->coefficient.bound() != 0.0;
}

}  // namespace strutt
