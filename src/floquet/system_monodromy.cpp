#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floquet/assembly.hpp"
#include "floquet/propagators.hpp"
#include "floquet/segments.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kUnit = 0x1p-53;
constexpr double kRadians = 16.0;  // that a solution turns by at most in one part of the period

/// q'' + c q' + mass^-1 (C - c mass) q' + mass^-1 K q = 0 in canonical time, its proportional part c split
/// off.
class Undamped {
 public:
  explicit Undamped(const LinearPeriodicSystem& system)
      : system_(system),
        unit_(system.period / (2.0 * pi)),
        inverse_mass_(system.mass.inverse()),
        stiffness_(system.mass),
        damping_(system.mass),
        scaled_(system.mass) {
    const auto proportional = system.proportional_damping();
    if (proportional && *proportional > 0.0) c_ = *proportional * unit_;
    general_damping_ = system.has_damping() && c_ == 0.0;
  }

  double unit() const { return unit_; }  ///< of canonical time
  double damping() const { return c_; }

  /// Of all columns of [q; q'].
  void derivative(double theta, StateView y, StateOut dydt) {
    const int d = system_.degrees_of_freedom(), n = system_.states();
    system_.stiffness.evaluate(theta, stiffness_);
    scaled_.noalias() = inverse_mass_ * stiffness_;
    scaled_ *= unit_ * unit_;
    scaled_.diagonal().array() -= 0.25 * c_ * c_;
    const auto phi = y.reshaped(n, n);
    auto rate = dydt.reshaped(n, n);
    rate.topRows(d) = phi.bottomRows(d);
    rate.bottomRows(d).noalias() = -scaled_ * phi.topRows(d);
    if (!general_damping_) return;
    system_.damping.evaluate(theta, damping_);
    scaled_.noalias() = inverse_mass_ * damping_;
    rate.bottomRows(d).noalias() -= unit_ * scaled_ * phi.bottomRows(d);
  }

  /// Upper bound of how fast a solution turns.
  double radians_per_phase() const {
    const double size = inverse_mass_.cwiseAbs().rowwise().sum().maxCoeff() * unit_;
    const double bound = size * system_.stiffness.bound() * unit_ + 0.25 * c_ * c_;
    return std::sqrt(bound) + (general_damping_ ? size * system_.damping.bound() : 0.0);
  }

  int highest_order() const {
    int highest = 1;
    for (const auto& h : system_.stiffness.harmonics) highest = std::max(highest, h.order);
    for (const auto& h : system_.damping.harmonics) highest = std::max(highest, h.order);
    return highest;
  }

 private:
  const LinearPeriodicSystem& system_;
  double unit_;
  double c_ = 0.0;
  bool general_damping_ = false;
  Eigen::MatrixXd inverse_mass_, stiffness_, damping_, scaled_;
};

Monodromy put_together(const Undamped& y, int states, const std::vector<BoundedMatrix>& factors) {
  Monodromy result;
  result.kappa = 1.0 / y.unit();
  result.half_damping = y.damping() * pi;
  result.undamped = ordered_product(factors, states);
  result.matrix = restore_damping(result.undamped, result.half_damping, 0.5 * y.damping());
  return result;
}

}  // namespace

Monodromy system_monodromy(PropagatorPool& pool, const LinearPeriodicSystem& system, Method method,
                           const MonodromyOptions& options) {
  Undamped y(system);
  const int n = system.states(), highest = y.highest_order();
  const double rate = y.radians_per_phase();
  const double coefficient_error = (16.0 + 2.0 * pi * highest) * kUnit;
  const double needed = std::max(std::ceil(2.0 * pi * rate / kRadians), 1.0);
  if (!(needed <= kMostSegments)) return without_result<Eigen::MatrixXd>(method, Outcome::step_limit);
  const auto parts = static_cast<int>(needed);

  const RightHandSide f = [&](double theta, StateView state, StateOut dydt) {
    y.derivative(theta, state, dydt);
  };
  Monodromy result = tighten(method, options.tolerance, [&](double local_tolerance) {
    Propagators<Eigen::MatrixXd> propagators;
    auto& integrator = pool.integrator(n, method);
    for (int j = 0; j < parts; ++j) {
      const double from = 2.0 * pi * j / parts, to = 2.0 * pi * (j + 1) / parts;
      propagators.append(integrator.propagate(f, from, to, rate * (to - from), coefficient_error,
                                              propagator_options(options, local_tolerance, highest)));
    }
    Monodromy attempt =
        combined(propagators, [&](const auto& factors) { return put_together(y, n, factors); });
    attempt.error = scaled_error(attempt.matrix);
    return attempt;
  });
  result.method = method;
  return result;
}

}  // namespace strutt
