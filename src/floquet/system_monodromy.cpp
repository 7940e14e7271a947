#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"
#include "floquet/assembly.hpp"
#include "floquet/propagators.hpp"
#include "floquet/undamped_system.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kRadiansPerPart = 16.0;  // that a solution turns by at most in one part of the period
constexpr double kMostParts = 10'000.0;

/// Of all columns of [y; y'].
class RightHandSideOf {
 public:
  explicit RightHandSideOf(const UndampedSystem& system) : system_(system) {}

  void operator()(double theta, StateView y, StateOut dydt) {
    const auto d = system_.mass.rows();
    system_.stiffness.evaluate(theta, matrix_);
    const auto phi = y.reshaped(2 * d, 2 * d);
    auto rate = dydt.reshaped(2 * d, 2 * d);
    rate.topRows(d) = phi.bottomRows(d);
    rate.bottomRows(d).noalias() = -matrix_ * phi.topRows(d);
    if (system_.damping.mean.size() == 0) return;
    system_.damping.evaluate(theta, matrix_);
    rate.bottomRows(d).noalias() -= matrix_ * phi.bottomRows(d);
  }

 private:
  const UndampedSystem& system_;
  Eigen::MatrixXd matrix_ = system_.mass;
};

/// By SUNDIALS.
Monodromy integrated(PropagatorPool& pool, const UndampedSystem& y, Method method,
                     const MonodromyOptions& options) {
  const int n = static_cast<int>(2 * y.mass.rows());
  const double needed = std::max(std::ceil(2.0 * pi * y.rate / kRadiansPerPart), 1.0);
  if (!(needed <= kMostParts)) return without_result<Eigen::MatrixXd>(method, Outcome::step_limit);
  const auto parts = static_cast<int>(needed);
  const double coefficient_error =
      y.coefficient_error + (8.0 + 2.0 * pi * y.highest_order) * kUnit;  // of cos(k theta)
  const RightHandSide f = [right_hand_side = RightHandSideOf(y)](double theta, StateView state,
                                                                 StateOut dydt) mutable {
    right_hand_side(theta, state, dydt);
  };
  return tighten(sundials_ladder(options), options.tolerance, [&](double local_tolerance) {
    Propagators<Eigen::MatrixXd> propagators;
    auto& integrator = pool.integrator(n, method);
    for (int j = 0; j < parts; ++j) {
      const double from = 2.0 * pi * j / parts, to = 2.0 * pi * (j + 1) / parts;
      propagators.append(integrator.propagate(f, from, to, y.rate * (to - from), coefficient_error,
                                              propagator_options(options, local_tolerance, y.highest_order)));
    }
    return y.assembled(propagators, false);
  });
}

}  // namespace

Monodromy system_monodromy(PropagatorPool& pool, const LinearPeriodicSystem& system, Method method,
                           const MonodromyOptions& options) {
  const UndampedSystem y(system);
  Monodromy result =
      method == Method::propagator ? taylor_monodromy(y, options) : integrated(pool, y, method, options);
  result.method = method;
  return result;
}

}  // namespace strutt
