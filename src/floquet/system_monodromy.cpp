#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floquet/assembly.hpp"
#include "floquet/propagators.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kUnit = 0x1p-53;

}  // namespace

Monodromy system_monodromy(PropagatorPool& pool, const LinearPeriodicSystem& system, Method method,
                           const MonodromyOptions& options) {
  const int d = system.degrees_of_freedom(), n = system.states();
  const double unit = system.period / (2.0 * pi);  // of canonical time
  // q'' + c q' + mass^-1 (C - c mass) q' + mass^-1 K q = 0 with the proportional part c split off
  const auto proportional = system.proportional_damping();
  const double c = proportional && *proportional > 0.0 ? *proportional * unit : 0.0;
  const bool general_damping = system.has_damping() && c == 0.0;
  const Eigen::MatrixXd inverse_mass = system.mass.inverse();
  Eigen::MatrixXd stiffness(d, d), damping(d, d), scaled(d, d);

  const RightHandSide f = [&](double theta, StateView y, StateOut dydt) {
    system.stiffness.evaluate(theta, stiffness);
    scaled.noalias() = inverse_mass * stiffness;
    scaled *= unit * unit;
    scaled.diagonal().array() -= 0.25 * c * c;
    const auto phi = y.reshaped(n, n);
    auto rate = dydt.reshaped(n, n);
    rate.topRows(d) = phi.bottomRows(d);
    rate.bottomRows(d).noalias() = -scaled * phi.topRows(d);
    if (!general_damping) return;
    system.damping.evaluate(theta, damping);
    scaled.noalias() = inverse_mass * damping;
    rate.bottomRows(d).noalias() -= unit * scaled * phi.bottomRows(d);
  };
  const double size = inverse_mass.cwiseAbs().rowwise().sum().maxCoeff() * unit;
  const double bound = size * system.stiffness.bound() * unit + 0.25 * c * c;
  const double damping_bound = general_damping ? size * system.damping.bound() : 0.0;
  const double radians_per_phase = std::sqrt(bound) + damping_bound;
  int highest = 1;
  for (const auto& h : system.stiffness.harmonics) highest = std::max(highest, h.order);
  for (const auto& h : system.damping.harmonics) highest = std::max(highest, h.order);
  const double coefficient_error = (16.0 + 2.0 * pi * highest) * kUnit;
  const auto parts = static_cast<int>(std::clamp(std::ceil(2.0 * pi * radians_per_phase / 16.0), 1.0, 1e6));

  const auto put_together = [&](const std::vector<BoundedMatrix>& factors) {
    Monodromy result;
    result.kappa = 1.0 / unit;
    result.half_damping = c * pi;
    result.undamped = ordered_product(factors, n);
    result.matrix = restore_damping(result.undamped, result.half_damping, 0.5 * c);
    return result;
  };
  Monodromy result = tighten(method, options.tolerance, [&](double local_tolerance) {
    Propagators propagators;
    auto& integrator = pool.integrator(n, method);
    for (int j = 0; j < parts; ++j) {
      const double from = 2.0 * pi * j / parts, to = 2.0 * pi * (j + 1) / parts;
      propagators.append(integrator.propagate(f, from, to, radians_per_phase * (to - from), coefficient_error,
                                              propagator_options(options, local_tolerance, highest)));
    }
    Monodromy attempt = combined(propagators, put_together);
    attempt.error = scaled_error(attempt.matrix);
    return attempt;
  });
  result.method = method;
  return result;
}

}  // namespace strutt
