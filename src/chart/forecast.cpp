#include "strutt/chart/forecast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "chart/cost_table.hpp"
#include "chart/surrogate_scope.hpp"
#include "floquet/undamped_hill.hpp"
#include "floquet/undamped_system.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

/// Multiply-adds a lane, see SeriesPlanner.
double series_work(double steps, double terms) { return steps * (terms * terms + 8.0 * terms + 120.0); }

double evaluations(const EvaluationLaw& law, double radians, double tolerance) {
  return std::max(law.least, law.per_radian * radians) * std::pow(1e-9 / tolerance, 1.0 / law.order);
}

/// Whether the multipliers come in pairs, and the verdict needs no eigenvalues.
bool is_reciprocal(const LinearPeriodicSystem& system) {
  const auto c = system.proportional_damping();
  return c && *c >= 0.0 && system.stiffness.is_symmetric() && system.mass == system.mass.transpose();
}

/// Of systems: p(p + 1)/2 products a step.
int order_of(double products) { return 2 * static_cast<int>(0.5 * std::sqrt(0.25 + 2.0 * products)); }

void add_cost(PointForecast& result, const IntegrationCost& cost) {
  result.steps = static_cast<double>(cost.steps);
  result.right_hand_sides = static_cast<double>(cost.right_hand_sides);
}

PointForecast forecast_sundials(Method method, double radians, double tolerance, bool system) {
  PointForecast result{.method = method, .points = 1.0};
  const bool arkode = method == Method::arkode;
  result.right_hand_sides = evaluations(arkode ? kArkodeLaw : kCvodeLaw, radians, tolerance);
  const double arkode_cost = system ? kCosts.system_arkode_evaluation : kCosts.arkode_evaluation;
  const double cvode_cost = system ? kCosts.system_cvode_evaluation : kCosts.cvode_evaluation;
  result.seconds = result.right_hand_sides * (arkode ? arkode_cost : cvode_cost);
  return result;
}

PointForecast forecast_hill(MonodromyEngine& engine, const HillEquation& equation,
                            const MonodromyOptions& options) {
  const Method method = method_for(equation, options.method);
  if (method == Method::exact) return {.method = method, .points = 1.0, .seconds = kCosts.exact_point};
  if (method != Method::propagator) {
    const UndampedHill y(equation);
    return forecast_sundials(method, (y.centre ? pi : 2.0 * pi) * std::sqrt(y.w.bound()), options.tolerance,
                             false);
  }
  MonodromyOptions series = options;
  series.method = method;
  PointForecast result{.method = method, .points = 1.0};
  add_cost(result, engine.compute(equation, series).cost);
  if (result.steps > 0.0) {
    const double terms = result.right_hand_sides / result.steps;
    result.order = 2 * static_cast<int>(std::lround(terms)) - 4;
    result.seconds = kCosts.hill_term * series_work(result.steps, terms);
  }
  result.seconds += kCosts.hill_point;
  return result;
}

PointForecast forecast_system(MonodromyEngine& engine, const LinearPeriodicSystem& system,
                              const MonodromyOptions& options) {
  const Method method = method_for(system, options.method);
  if (method != Method::propagator)
    return forecast_sundials(method, 2.0 * pi * UndampedSystem(system).rate, options.tolerance, true);
  MonodromyOptions series = options;
  series.method = method;
  PointForecast result{.method = method, .points = 1.0};
  add_cost(result, engine.compute(system, series).cost);
  if (result.steps > 0.0) result.order = order_of(result.right_hand_sides / result.steps);
  result.seconds = seconds_of_system(system.degrees_of_freedom(), result.right_hand_sides);
  return result;
}

PointForecast forecast(MonodromyEngine& engine, const LinearModel& model, const MonodromyOptions& options,
                       const StabilityParts& parts) {
  options.validate();
  if (const auto equation = hill_equation_of(model)) {
    auto result = forecast_hill(engine, *equation, options);
    result.seconds += (parts.winding ? kCosts.hill_winding : 0.0) + (parts.matrix ? kCosts.hill_matrix : 0.0);
    return result;
  }
  const auto& system = std::get<LinearPeriodicSystem>(model);
  auto result = forecast_system(engine, system, options);
  if (parts.matrix || !is_reciprocal(system))
    result.seconds += kCosts.multipliers * cube_of(system.degrees_of_freedom());
  return result;
}

class Mean {
 public:
  void add(const PointForecast& point, double weight) {
    sum_.method = point.method;
    sum_.points += 1.0;
    sum_.steps += weight * point.steps;
    sum_.right_hand_sides += weight * point.right_hand_sides;
    sum_.seconds += weight * point.seconds;
    sum_.order = std::max(sum_.order, point.order);
    weights_ += weight;
  }

  PointForecast value() const {
    PointForecast mean = sum_;
    if (weights_ == 0.0) return mean;
    mean.steps /= weights_;
    mean.right_hand_sides /= weights_;
    mean.seconds /= weights_;
    return mean;
  }

 private:
  PointForecast sum_;
  double weights_ = 0.0;
};

}  // namespace

PointForecast forecast_point(const LinearModel& model, const MonodromyOptions& options,
                             const StabilityParts& parts) {
  return forecast_points(std::span(&model, 1), options, parts);
}

PointForecast forecast_points(std::span<const LinearModel> models, const MonodromyOptions& options,
                              const StabilityParts& parts) {
  MonodromyEngine engine;
  Mean mean;
  for (const auto& model : models) mean.add(forecast(engine, model, options, parts), 1.0);
  return mean.value();
}

PointForecast forecast_points(const Scene& scene, const Axis& x, const Axis& y,
                              const MonodromyOptions& options, const StabilityParts& parts) {
  constexpr std::array kSimpson{1.0, 4.0, 1.0};
  const Axis few_x{x.parameter, x.from, x.to, 3, x.scale}, few_y{y.parameter, y.from, y.to, 3, y.scale};
  MonodromyEngine engine;
  Scene at = scene;
  Mean mean;
  for (std::size_t k = 0; k < 9; ++k) {
    parameter(at, x.parameter) = few_x.value(k % 3);
    parameter(at, y.parameter) = few_y.value(k / 3);
    try {
      mean.add(forecast(engine, linear_model(at), options, parts), kSimpson[k % 3] * kSimpson[k / 3]);
    } catch (const InvalidInput&) {
      // not every point of a chart need be a body
    }
  }
  return mean.value();
}

}  // namespace strutt
