#include <cmath>
#include <numbers>

#include "base/constants.hpp"
#include "floquet/assembly.hpp"
#include "floquet/propagators.hpp"
#include "floquet/undamped_hill.hpp"
#include "strutt/floquet/constant_propagator.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

/// Y'' + W Y = 0 for both columns of [Y; Y'/kappa], in time local to the segment.
RightHandSide hill_right_hand_side(const PeriodicFunction& w, double from, double kappa) {
  return [&w, from, kappa](double s, StateView y, StateOut dydt) {
    const double stiffness = -w(from + s) / kappa;
    dydt[0] = kappa * y[1];
    dydt[1] = stiffness * y[0];
    dydt[2] = kappa * y[3];
    dydt[3] = stiffness * y[2];
  };
}

Propagators<Eigen::Matrix2d> closed_form_propagators(const HillEquation& equation, const PeriodicFunction& w,
                                                     const std::vector<Segment>& segments, double kappa) {
  Propagators<Eigen::Matrix2d> result;
  const double c = equation.canonical_damping();
  // c^2/4 is rounded once it is there, and so is the difference
  const double relative = equation.coefficient_error + (c == 0.0 ? 0.0 : 4.0 * kUnit);
  for (const auto& segment : segments) {
    const double value = w.piece(0.5 * (segment.from + segment.to)).mean();
    const bool rounded_sum = !equation.coefficient.is_constant();  // mean +- amplitude
    const double error =
        relative * (std::abs(value) + 0.5 * c * c) + (rounded_sum ? kUnit * std::abs(value) : 0.0);
    const double half_turns = (segment.to - segment.from) / pi;
    result.factors.push_back(constant_propagator(value, half_turns, kappa, error));
  }
  return result;
}

/// Relative, of values of W: cos(k theta) takes the rounding of theta k times.
double evaluation_error(const PeriodicFunction& w) { return (2.0 + 2.0 * pi * w.highest_order()) * kUnit; }

Propagators<Eigen::Matrix2d> integrated_propagators(LinearPropagator& integrator, const PeriodicFunction& w,
                                                    const std::vector<Segment>& segments, double kappa,
                                                    double coefficient_error,
                                                    const PropagatorOptions& options) {
  Propagators<Eigen::Matrix2d> result;
  for (const auto& segment : segments) {
    const auto piece = w.piece(0.5 * (segment.from + segment.to));
    const double length = segment.to - segment.from;
    result.append(integrator.propagate(hill_right_hand_side(piece, segment.from, kappa), 0.0, length,
                                       std::sqrt(piece.bound()) * length, coefficient_error, options));
  }
  return result;
}

}  // namespace

HillMonodromy hill_monodromy(PropagatorPool& pool, const HillEquation& equation, Method method,
                             const MonodromyOptions& options) {
  const UndampedHill y(equation);
  // Only the steps of SUNDIALS need short intervals; a closed form cut into parts would turn proved zeros
  // into rounding.
  const auto segments = method == Method::exact ? y.pieces : subdivided(y.pieces, y.w);
  if (segments.empty()) return without_result<Eigen::Matrix2d>(method, Outcome::step_limit);
  HillMonodromy result = tighten(sundials_ladder(options), options.tolerance, [&](double local_tolerance) {
    const auto found =
        method == Method::exact
            ? closed_form_propagators(equation, y.w, segments, y.kappa)
            : integrated_propagators(pool.integrator(2, method), y.w, segments, y.kappa,
                                     y.coefficient_error + evaluation_error(y.w),
                                     propagator_options(options, local_tolerance, y.w.highest_order()));
    return y.assembled(found, segments);
  });
  result.method = method;
  result.sharpest = result.sharpest || method == Method::exact;
  return result;
}

}  // namespace strutt
