#include "strutt/floquet/stability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/floquet/winding.hpp"

namespace strutt {
namespace {

constexpr double kLogLargest = 690.0;  // ln 1e300, rounded down

// ln 2 as an unevaluated sum, for exact changes between powers of two and of e
constexpr double kLn2 = std::numbers::ln2;
constexpr double kLn2Tail = 2.3190468138462996e-17;

/// Writes matrix, trace and multipliers, all divided by one exp(log_scale) if the largest of them would pass
/// 1e300.
template <typename Matrix>
void write_matrix(Stability& result, const BasicMonodromy<Matrix>& monodromy,
                  const std::vector<Multiplier>& multipliers) {
  const auto& m = monodromy.matrix.value;
  const Eigen::Index n = m.mantissa.rows(), d = n / 2;
  Eigen::MatrixXd matrix = m.mantissa;  // (q, q'/kappa) -> (q, q')
  matrix.topRightCorner(d, d) /= monodromy.kappa;
  matrix.bottomLeftCorner(d, d) *= monodromy.kappa;
  const auto exponent = static_cast<double>(m.exponent);
  double largest =
      std::log(std::max(matrix.cwiseAbs().maxCoeff(), std::abs(matrix.trace()))) + exponent * kLn2;
  for (const auto& multiplier : multipliers) largest = std::max(largest, multiplier.log_modulus);
  const bool scaled = largest > kLogLargest;
  if (scaled) {
    result.log_scale = exponent * kLn2;
    const double rest = std::fma(exponent, kLn2, -result.log_scale) + exponent * kLn2Tail;
    matrix *= std::exp(rest);
  } else {
    matrix = matrix.unaryExpr(
        [e = static_cast<int>(std::max(m.exponent, -5000L))](double x) { return std::ldexp(x, e); });
  }
  result.matrix = matrix;
  result.discriminant = matrix.trace();
  for (const auto& multiplier : multipliers) {
    result.multipliers.push_back(std::exp(multiplier.log_modulus - result.log_scale) * multiplier.direction);
  }
}

template <typename Matrix>
Stability begin(const BasicMonodromy<Matrix>& monodromy) {
  Stability result;
  result.error = monodromy.error;
  result.method = monodromy.method;
  result.outcome = monodromy.outcome;
  result.cost = monodromy.cost;
  result.estimate_cost = monodromy.estimate_cost;
  return result;
}

/// x'' + c x' = 0: constants are solutions, the multipliers 1 and exp(-cT).
bool has_no_force(const HillEquation& equation) {
  return equation.coefficient.is_constant() && equation.coefficient.mean() == 0.0;
}

template <typename Matrix>
bool has_value(const BasicMonodromy<Matrix>& monodromy) {
  return monodromy.outcome == Outcome::converged || monodromy.outcome == Outcome::tolerance_not_reached;
}

void finish(Stability& result, const Margin& margin, double growth, double period) {
  result.margin = margin.value;
  result.margin_error = margin.error;
  result.verdict = verdict_of(margin);
  result.growth = growth;
  result.growth_per_time = growth / period;
}

/// Is the point to be computed again, as accurately as the method can?
template <typename Matrix>
bool may_be_decided(const Stability& result, const BasicMonodromy<Matrix>& monodromy,
                    const MonodromyOptions& options, const StabilityParts& parts) {
  return parts.verdict && options.estimate_error && !monodromy.sharpest &&
         result.outcome == Outcome::converged && result.verdict == Verdict::unresolved;
}

MonodromyOptions sharpest(MonodromyOptions options) {
  options.sharpest = true;
  return options;
}

/// At the cost of both.
Stability better_of(Stability first, Stability sharper) {
  const bool better = sharper.outcome == Outcome::converged && sharper.margin_error < first.margin_error;
  auto& result = better ? sharper : first;
  const auto& other = better ? first : sharper;
  result.cost += other.cost;
  result.estimate_cost += other.estimate_cost;
  return std::move(result);
}

Stability analyse_system(MonodromyEngine& engine, const LinearPeriodicSystem& system,
                         const MonodromyOptions& options, const StabilityParts& parts) {
  const auto monodromy = engine.compute(system, options);
  auto result = assess(system, monodromy, parts);
  if (!may_be_decided(result, monodromy, options, parts)) return result;
  return better_of(std::move(result), analyse_system(engine, system, sharpest(options), parts));
}

/// Side by side.
std::vector<Stability> analyse_hill(MonodromyEngine& engine, std::span<const HillEquation> equations,
                                    const MonodromyOptions& options, const StabilityParts& parts) {
  const auto monodromies = engine.compute(equations, options);
  std::vector<Stability> results;
  std::vector<HillEquation> open;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    results.push_back(assess(equations[i], monodromies[i], parts));
    if (!may_be_decided(results[i], monodromies[i], options, parts)) continue;
    open.push_back(equations[i]);
    places.push_back(i);
  }
  if (open.empty()) return results;
  auto sharper = analyse_hill(engine, open, sharpest(options), parts);
  for (std::size_t k = 0; k < open.size(); ++k) {
    auto& result = results[places[k]];
    result = better_of(std::move(result), std::move(sharper[k]));
  }
  return results;
}

}  // namespace

Stability assess(const HillEquation& equation, const HillMonodromy& monodromy, const StabilityParts& parts) {
  const DefaultFloatingPoint environment;
  const double period = equation.period();
  auto result = begin(monodromy);
  if (!has_value(monodromy)) return result;
  const auto discriminant = discriminant_gap(monodromy);
  const double h = monodromy.half_damping;
  const bool marginal = has_no_force(equation);
  finish(result, marginal ? Margin{0.0, 0.0} : hill_margin(discriminant, h),
         marginal ? 0.0 : hill_growth(discriminant, h), period);
  if (parts.winding) {
    const double c = equation.canonical_damping();
    result.winding = winding_number(equation.coefficient.plus(-0.25 * c * c), monodromy.undamped,
                                    discriminant, equation.canonical_kappa());
  }
  if (parts.matrix) write_matrix(result, monodromy, hill_multipliers(discriminant, h));
  return result;
}

Stability assess(const LinearPeriodicSystem& system, const Monodromy& monodromy,
                 const StabilityParts& parts) {
  const DefaultFloatingPoint environment;
  auto result = begin(monodromy);
  if (!has_value(monodromy)) return result;
  try {
    const auto proportional = system.proportional_damping();
    const bool reciprocal = proportional && *proportional >= 0.0 && system.stiffness.is_symmetric() &&
                            system.mass == system.mass.transpose();
    const auto multipliers =
        parts.matrix || !reciprocal ? system_multipliers(monodromy.matrix) : std::vector<Multiplier>{};
    const auto stability = reciprocal
                               ? reciprocal_stability(monodromy.undamped, system.mass, monodromy.half_damping)
                               : general_stability(multipliers);
    finish(result, stability.margin, stability.growth, system.period);
    if (parts.matrix) write_matrix(result, monodromy, multipliers);
  } catch (const NumericalFailure&) {
    result.outcome = Outcome::failed;
  }
  return result;
}

std::optional<HillEquation> as_hill_equation(const LinearPeriodicSystem& system) {
  const auto c = system.proportional_damping();
  if (system.degrees_of_freedom() != 1 || !c || *c < 0.0) return std::nullopt;
  const double mass = system.mass(0, 0);
  std::vector<Harmonic> harmonics;
  for (const auto& h : system.stiffness.harmonics) {
    harmonics.push_back({h.order, h.cosine.size() > 0 ? h.cosine(0, 0) / mass : 0.0,
                         h.sine.size() > 0 ? h.sine(0, 0) / mass : 0.0});
  }
  const auto w = PeriodicFunction::fourier(system.stiffness.mean(0, 0) / mass, std::move(harmonics));
  try {
    HillEquation equation = hill_equation(system.period, w, *c);
    equation.validate();
    equation.plain_kappa = true;
    return equation;
  } catch (const InvalidInput&) {
    return std::nullopt;  // beyond double in canonical time: to a system that is an outcome
  }
}

Method method_for(const LinearModel& model, Method asked) {
  if (const auto* equation = std::get_if<HillEquation>(&model)) return method_for(*equation, asked);
  const auto& system = std::get<LinearPeriodicSystem>(model);
  if (const auto equation = as_hill_equation(system)) return method_for(*equation, asked);
  return method_for(system, asked);
}

Stability analyse(MonodromyEngine& engine, const LinearModel& model, const MonodromyOptions& options,
                  const StabilityParts& parts) {
  return std::move(analyse(engine, std::span(&model, 1), options, parts).front());
}

std::vector<Stability> analyse(MonodromyEngine& engine, std::span<const LinearModel> models,
                               const MonodromyOptions& options, const StabilityParts& parts) {
  const DefaultFloatingPoint environment;
  std::vector<Stability> results(models.size());
  std::vector<HillEquation> equations;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const auto* system = std::get_if<LinearPeriodicSystem>(&models[i]);
    auto equation = system != nullptr ? as_hill_equation(*system) : std::get<HillEquation>(models[i]);
    if (equation) {
      equations.push_back(*std::move(equation));
      places.push_back(i);
    } else {
      results[i] = analyse_system(engine, *system, options, parts);
    }
  }
  auto found = analyse_hill(engine, equations, options, parts);
  for (std::size_t j = 0; j < places.size(); ++j) results[places[j]] = std::move(found[j]);
  return results;
}

}  // namespace strutt
