#include "strutt/floquet/monodromy.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "floquet/assembly.hpp"
#include "floquet/segments.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/constant_propagator.hpp"
#include "strutt/integrate/linear_propagator.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kUnit = 0x1p-53;
constexpr double kLowestLocalTolerance = 1e-14;  // below, rounding grows faster than truncation falls
constexpr double kHighestLocalTolerance = 1e-4;
constexpr double kLocalShare = 0.01;  // local tolerance to global tolerance

/// Propagators of consecutive segments, and how their integration went.
struct Propagators {
  std::vector<BoundedMatrix> factors;  // with the bounds of their rounding
  std::vector<BoundedMatrix> checks;   // the same from the second runs, without bounds; empty for closed forms
  Outcome outcome = Outcome::converged;
  IntegrationCost cost, estimate_cost;
};

Backend backend_of(Method method) { return method == Method::cvode ? Backend::cvode_adams : Backend::arkode_erk; }

Method method_for(const HillEquation& equation, Method asked) {
  const bool closed_form = equation.coefficient.is_piecewise_constant();
  if (asked == Method::automatic) return closed_form ? Method::exact : Method::arkode;
  if (asked == Method::exact && !closed_form) {
    throw InvalidInput("method exact needs a piecewise-constant coefficient; use auto, arkode or cvode");
  }
  return asked;
}

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
    const double error = relative * (std::abs(value) + 0.5 * c * c) + (rounded_sum ? kUnit * std::abs(value) : 0.0);
    const double half_turns = (segment.to - segment.from) / pi;
    result.factors.push_back(constant_propagator(value, half_turns, kappa, error));
  }
  return result;
}

PropagatorOptions propagator_options(const MonodromyOptions& options, double local_tolerance, int highest_order) {
  return {.local_tolerance = local_tolerance,
          .highest_frequency = static_cast<double>(highest_order),
          .estimate_error = options.estimate_error,
          .max_seconds = options.max_seconds,
          .cancel = options.cancel};
}

void append(Propagators& list, Propagation&& step) {
  if (list.outcome == Outcome::converged) list.outcome = step.outcome;
  list.cost += step.cost;
  list.estimate_cost += step.estimate_cost;
  list.checks.push_back({std::move(step.check), Eigen::MatrixXd::Zero(step.matrix.error.rows(), step.matrix.error.cols())});
  list.factors.push_back(std::move(step.matrix));
}

/// Adds to the error bounds of `result` what the second runs, put together the same way, show of the truncation.
void add_truncation(Monodromy& result, const Monodromy& check) {
  add_truncation(result.matrix, check.matrix.value);
  add_truncation(result.undamped, check.undamped.value);
  if (result.half) add_truncation(*result.half, check.half->value);
}

void take_over(Monodromy& result, const Propagators& propagators) {
  result.cost += propagators.cost;
  result.estimate_cost += propagators.estimate_cost;
  result.outcome = propagators.outcome;
}

/// Runs attempt(local_tolerance) with tighter and tighter tolerances until the error is small enough.
template <typename Attempt>
Monodromy tighten(const MonodromyOptions& options, Attempt attempt) {
  double local = std::clamp(kLocalShare * options.tolerance, kLowestLocalTolerance, kHighestLocalTolerance);
  Monodromy result = attempt(local);
  while (result.outcome == Outcome::converged && result.error > options.tolerance && local > kLowestLocalTolerance) {
    local = std::max(kLocalShare * local, kLowestLocalTolerance);
    const auto spent = result.cost, spent_estimating = result.estimate_cost;
    result = attempt(local);
    result.cost += spent;
    result.estimate_cost += spent_estimating;
  }
  if (result.outcome == Outcome::converged && !(result.error <= options.tolerance)) {
    result.outcome = std::isfinite(result.error) ? Outcome::tolerance_not_reached : Outcome::non_finite;
  }
  if (result.outcome != Outcome::converged && result.outcome != Outcome::tolerance_not_reached) {
    result.error = std::numeric_limits<double>::infinity();
  }
  return result;
}

}  // namespace

void MonodromyOptions::validate() const {
  require(tolerance >= 1e-13 && tolerance <= 1e-2, "tolerance", tolerance, "in [1e-13, 1e-2]");
  if (method != Method::automatic && method != Method::exact && method != Method::arkode && method != Method::cvode) {
    throw InvalidInput("method", to_string(method), "one of auto, exact, arkode, cvode for a monodromy matrix");
  }
}

struct MonodromyEngine::Workspace {
  std::map<std::pair<int, Backend>, LinearPropagator> propagators;

  LinearPropagator& propagator(int states, Backend backend) {
    return propagators.try_emplace({states, backend}, states, backend).first->second;
  }
};

MonodromyEngine::MonodromyEngine() : workspace_(std::make_unique<Workspace>()) {}
MonodromyEngine::~MonodromyEngine() = default;
MonodromyEngine::MonodromyEngine(MonodromyEngine&&) noexcept = default;
MonodromyEngine& MonodromyEngine::operator=(MonodromyEngine&&) noexcept = default;

Monodromy MonodromyEngine::compute(const HillEquation& equation, const MonodromyOptions& options) {
  equation.validate();
  options.validate();
  const Method method = method_for(equation, options.method);
  const double kappa = equation.canonical_kappa(), c = equation.canonical_damping();
  const auto centre = equation.coefficient.even_centre();
  const double theta0 = centre.value_or(0.0);
  auto w = centre ? equation.coefficient.centred(theta0) : equation.coefficient;
  if (c != 0.0) w = w.plus(-0.25 * c * c);  // of y = exp(ct/2) x
  // With an even coefficient half a period is enough; theta0 is cut out because M is wanted from t = 0.
  const auto pieces = smooth_pieces(w, 0.0, centre ? pi : 2.0 * pi, theta0);
  // A closed form is exact over a whole piece: cutting it would turn zeros that are proved into rounding.
  const auto segments = method == Method::exact ? pieces : subdivided(pieces, w);

  const double relative_error = evaluation_error(equation) + (centre ? equation.coefficient.asymmetry(theta0) : 0.0);
  const auto integrate = [&](double local_tolerance) {
    Propagators result;
    auto& propagator = workspace_->propagator(2, backend_of(method));
    for (const auto& segment : segments) {
      const auto piece = w.piece(0.5 * (segment.from + segment.to));
      const double length = segment.to - segment.from;
      append(result, propagator.propagate(hill_right_hand_side(piece, segment.from, kappa), 0.0, length,
                                          std::sqrt(piece.bound()) * length, relative_error,
                                          propagator_options(options, local_tolerance, w.highest_order())));
    }
    return result;
  };
  const auto before = static_cast<std::size_t>(
      std::count_if(segments.begin(), segments.end(), [&](const Segment& s) { return centre && s.to <= theta0; }));
  const auto put_together = [&](const std::vector<BoundedMatrix>& factors) {
    Monodromy result;
    result.method = method;
    result.kappa = kappa * equation.angular_frequency;
    result.half_damping = c * pi;
    if (centre) {
      result.half = ordered_product(factors, 2);
      result.undamped = period_from_half(factors, before);
    } else {
      result.undamped = ordered_product(factors, 2);
    }
    result.matrix = restore_damping(result.undamped, result.half_damping, 0.5 * c / kappa);
    return result;
  };
  return tighten(options, [&](double local_tolerance) {
    const auto propagators = method == Method::exact ? closed_form_propagators(equation, w, segments, kappa)
                                                     : integrate(local_tolerance);
    auto result = put_together(propagators.factors);
    take_over(result, propagators);
    for (const auto& factor : propagators.factors) {
      result.determinant_defect = std::max(result.determinant_defect, determinant_defect(factor));
    }
    if (!propagators.checks.empty()) add_truncation(result, put_together(propagators.checks));
    result.error = scaled_error(result.matrix);
    return result;
  });
}

Monodromy MonodromyEngine::compute(const LinearPeriodicSystem& system, const MonodromyOptions& options) {
  system.validate();
  options.validate();
  if (options.method == Method::exact) {
    throw InvalidInput("method exact needs a piecewise-constant Hill equation; use auto, arkode or cvode");
  }
  const Method method = options.method == Method::automatic ? Method::arkode : options.method;
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
    result.method = method;
    result.kappa = 1.0 / unit;
    result.half_damping = c * pi;
    result.undamped = ordered_product(factors, n);
    result.matrix = restore_damping(result.undamped, result.half_damping, 0.5 * c);
    return result;
  };
  return tighten(options, [&](double local_tolerance) {
    Propagators propagators;
    auto& propagator = workspace_->propagator(n, backend_of(method));
    for (int j = 0; j < parts; ++j) {
      const double from = 2.0 * pi * j / parts, to = 2.0 * pi * (j + 1) / parts;
      append(propagators, propagator.propagate(f, from, to, radians_per_phase * (to - from), coefficient_error,
                                               propagator_options(options, local_tolerance, highest)));
    }
    auto result = put_together(propagators.factors);
    take_over(result, propagators);
    add_truncation(result, put_together(propagators.checks));
    result.error = scaled_error(result.matrix);
    return result;
  });
}

}  // namespace strutt
