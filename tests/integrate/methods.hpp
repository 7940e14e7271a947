#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#include "strutt/integrate/integrator.hpp"

/// Methods and problems the tests of the integrator share.
namespace strutt::test {

struct Method {
  Backend backend;
  int order;
};

inline const std::vector<Method> kMethods{
    {Backend::arkode_erk, 2}, {Backend::arkode_erk, 3}, {Backend::arkode_erk, 4},  {Backend::arkode_erk, 5},
    {Backend::arkode_erk, 6}, {Backend::arkode_erk, 8}, {Backend::cvode_adams, 8}, {Backend::cvode_bdf, 8}};

inline std::string name(const Method& method) {
  if (method.backend == Backend::cvode_adams) return "Adams";
  if (method.backend == Backend::cvode_bdf) return "BDF";
  return "order " + std::to_string(method.order);
}

inline IntegratorOptions options_of(const Method& method, double tolerance) {
  IntegratorOptions options;
  options.backend = method.backend;
  options.order = method.order;
  options.relative_tolerance = options.absolute_tolerance = tolerance;
  return options;
}

inline void oscillator(double, StateView y, StateOut dydt) {
  dydt[0] = y[1];
  dydt[1] = -y[0];
}

inline void mathieu(double t, StateView y, StateOut dydt) {
  const double stiffness = 1.0 + 0.5 * std::cos(t);
  for (int column = 0; column < 4; column += 2) {
    dydt[column] = y[column + 1];
    dydt[column + 1] = -stiffness * y[column];
  }
}

inline Eigen::VectorXd vector(std::initializer_list<double> values) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

inline bool same_bits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

}  // namespace strutt::test
