#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "strutt/floquet/stability.hpp"
#include "support/models.hpp"

/// Runs a law on every model by every method that fits it.
namespace strutt::test {

inline std::vector<Method> methods(const LinearModel& model) {
  std::vector<Method> result{Method::propagator, Method::arkode, Method::cvode};
  const auto* equation = std::get_if<HillEquation>(&model);
  if (equation != nullptr && equation->coefficient.is_piecewise_constant()) result.push_back(Method::exact);
  return result;
}

inline Monodromy computed(const LinearModel& model, Method method) {
  static MonodromyEngine engine;
  const MonodromyOptions options{.tolerance = 1e-9, .method = method};
  const auto* equation = std::get_if<HillEquation>(&model);
  auto result = equation != nullptr ? widened(engine.compute(*equation, options))
                                    : engine.compute(std::get<LinearPeriodicSystem>(model), options);
  CHECK(result.outcome == Outcome::converged);
  CHECK(result.error <= 1e-9);
  return result;
}

/// Calls check(case, method, monodromy) for every model and every method that fits it.
template <typename Check>
void on_every_model(Check check) {
  for (const auto& entry : every_model()) {
    for (const auto method : methods(entry.model)) {
      INFO(entry.name << ", " << to_string(method));
      check(entry, method, computed(entry.model, method));
    }
  }
}

struct Plain {
  Eigen::MatrixXd value, error;
};

inline Plain plain(const BoundedMatrix& m) {
  const double scale = std::ldexp(1.0, static_cast<int>(m.value.exponent));
  return {m.value.mantissa * scale, m.error * scale};
}

}  // namespace strutt::test
