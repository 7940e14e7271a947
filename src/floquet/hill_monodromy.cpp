#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "floquet/assembly.hpp"
#include "floquet/propagators.hpp"
#include "floquet/segments.hpp"
#include "strutt/floquet/constant_propagator.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kUnit = 0x1p-53;

/// Relative error of evaluating W: of its coefficients, and of cos(k theta) through the rounding of theta.
double evaluation_error(const HillEquation& equation) {
  return equation.coefficient_error + (2.0 + 2.0 * pi * equation.coefficient.highest_order()) * kUnit;
}

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

Propagators closed_form_propagators(const HillEquation& equation, const PeriodicFunction& w,
                                    const std::vector<Segment>& segments, double kappa) {
  Propagators result;
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

Propagators splitting_propagators(SplittingPropagators& tables, const PeriodicFunction& w,
                                  const std::vector<Segment>& pieces, double kappa, double coefficient_error,
                                  const PropagatorOptions& options) {
  Propagators result;
  result.truncation_share = 0.0;
  for (const auto& piece : pieces) {
    if (options.cancel != nullptr && options.cancel->load()) result.outcome = Outcome::cancelled;
    if (result.outcome != Outcome::converged) return result;
    auto step = tables.propagate(w.piece(0.5 * (piece.from + piece.to)), piece, kappa,
                                 options.local_tolerance, coefficient_error, options.estimate_error);
    if (step.cost.steps == 0) result.outcome = Outcome::step_limit;
    result.cost += step.cost;
    result.estimate_cost += step.check_cost;
    result.truncation_share = std::max(result.truncation_share, step.truncation_share);
    result.checks.push_back({std::move(step.check), {}});
    result.factors.push_back(std::move(step.matrix));
  }
  return result;
}

Propagators integrated_propagators(LinearPropagator& integrator, const PeriodicFunction& w,
                                   const std::vector<Segment>& segments, double kappa,
                                   double coefficient_error, const PropagatorOptions& options) {
  Propagators result;
  for (const auto& segment : segments) {
    const auto piece = w.piece(0.5 * (segment.from + segment.to));
    const double length = segment.to - segment.from;
    result.append(integrator.propagate(hill_right_hand_side(piece, segment.from, kappa), 0.0, length,
                                       std::sqrt(piece.bound()) * length, coefficient_error, options));
  }
  return result;
}

/// The equation of y = exp(ct/2) x over half a period from a symmetric point, or over a whole one if there is
/// none.
struct Undamped {
  explicit Undamped(const HillEquation& equation)
      : centre(equation.coefficient.even_centre()),
        w(centre ? equation.coefficient.centred(*centre) : equation.coefficient),
        kappa(equation.canonical_kappa()) {
    const double c = equation.canonical_damping();
    if (c != 0.0) w = w.plus(-0.25 * c * c);
    // The centre is cut out because M is wanted from t = 0.
    pieces = smooth_pieces(w, 0.0, centre ? pi : 2.0 * pi, centre.value_or(0.0));
  }

  std::optional<double> centre;
  PeriodicFunction w;
  double kappa;
  std::vector<Segment> pieces;
};

Monodromy put_together(const HillEquation& equation, const Undamped& y, const std::vector<Segment>& segments,
                       const std::vector<BoundedMatrix>& factors) {
  Monodromy result;
  result.kappa = y.kappa * equation.angular_frequency;
  result.half_damping = equation.canonical_damping() * pi;
  if (y.centre) {
    result.half = ordered_product(factors, 2);
    const auto before =
        std::count_if(segments.begin(), segments.end(), [&](const Segment& s) { return s.to <= *y.centre; });
    result.undamped = period_from_half(factors, static_cast<std::size_t>(before));
  } else {
    result.undamped = ordered_product(factors, 2);
  }
  result.matrix =
      restore_damping(result.undamped, result.half_damping, 0.5 * equation.canonical_damping() / y.kappa);
  return result;
}

}  // namespace

Monodromy hill_monodromy(PropagatorPool& pool, const HillEquation& equation, Method method,
                         const MonodromyOptions& options) {
  const Undamped y(equation);
  // Only the steps of SUNDIALS need short intervals; a closed form cut into parts would turn proved zeros
  // into rounding.
  const bool integrated = method == Method::arkode || method == Method::cvode;
  const auto segments = integrated ? subdivided(y.pieces, y.w) : y.pieces;
  if (segments.empty()) return without_result(method, Outcome::step_limit);
  const double coefficient_error =
      evaluation_error(equation) + (y.centre ? equation.coefficient.asymmetry(*y.centre) : 0.0);
  const auto propagators = [&](double local_tolerance) {
    if (method == Method::exact) return closed_form_propagators(equation, y.w, segments, y.kappa);
    const auto wanted = propagator_options(options, local_tolerance, y.w.highest_order());
    return method == Method::propagator
               ? splitting_propagators(pool.splittings, y.w, segments, y.kappa, coefficient_error, wanted)
               : integrated_propagators(pool.integrator(2, method), y.w, segments, y.kappa, coefficient_error,
                                        wanted);
  };
  Monodromy result = tighten(method, options.tolerance, [&](double local_tolerance) {
    const Propagators found = propagators(local_tolerance);
    Monodromy attempt;
    attempt.outcome = found.outcome;
    if (found.outcome == Outcome::cancelled || found.outcome == Outcome::step_limit) return attempt;
    attempt =
        combined(found, [&](const auto& factors) { return put_together(equation, y, segments, factors); });
    for (const auto& factor : found.factors) {
      attempt.determinant_defect = std::max(attempt.determinant_defect, determinant_defect(factor));
    }
    attempt.error = scaled_error(attempt.matrix);
    return attempt;
  });
  result.method = method;
  return result;
}

}  // namespace strutt
