#include "floquet/splitting_propagators.hpp"

#include <cmath>
#include <cstdlib>

namespace strutt {
namespace {

constexpr std::size_t kMostTables = 256;

/// W as mean + sum_j weights[j] basis_j, the basis named by `names` as in SplittingPropagators::Key.
struct Expansion {
  std::vector<int> names;
  std::vector<double> weights;
};

Expansion expansion(const PeriodicFunction& w) {
  Expansion result;
  const auto add = [&](int name, double weight) {
    if (weight == 0.0) return;
    result.names.push_back(name);
    result.weights.push_back(weight);
  };
  for (const auto& h : w.harmonics()) {
    add(h.order, h.cosine);
    add(-h.order, h.sine);
  }
  return result;
}

ScaledMatrix scaled(const HillPropagators& lanes, double kappa) {
  ScaledMatrix result{
      Eigen::MatrixXd{{lanes.u1[0], kappa * lanes.u2[0]}, {lanes.du1[0] / kappa, lanes.du2[0]}},
      lanes.exponent[0]};
  return result;
}

}  // namespace

const HillPropagator& SplittingPropagators::table(Key key) {
  const auto found = tables_.find(key);
  if (found != tables_.end()) return found->second;
  if (tables_.size() >= kMostTables) tables_.clear();
  std::vector<PeriodicFunction> basis;
  for (const int name : key.harmonics) {
    basis.push_back(
        PeriodicFunction::fourier(0.0, {{std::abs(name), name > 0 ? 1.0 : 0.0, name > 0 ? 0.0 : 1.0}}));
  }
  const HillStepPlan plan{key.order, key.steps};
  HillPropagator made(plan, basis, key.from, key.to);
  return tables_.emplace(std::move(key), std::move(made)).first->second;
}

SplittingPropagation SplittingPropagators::propagate(const PeriodicFunction& w, const Segment& piece,
                                                     double kappa, double tolerance, double coefficient_error,
                                                     bool with_check) {
  SplittingPropagation result;
  const auto plan = plan_hill_steps(w, piece.from, piece.to, tolerance);
  if (plan.steps == 0) return result;
  Expansion terms = expansion(w);
  const double mean[] = {w.mean()};
  HillBatch batch{mean, {}};
  for (const double& weight : terms.weights) batch.weights.emplace_back(&weight, 1);

  HillPropagators lanes;
  const auto& full = table({plan.order, plan.steps, piece.from, piece.to, terms.names});
  full.propagate(batch, lanes);
  result.matrix.value = scaled(lanes, kappa);
  const double size = result.matrix.value.mantissa.cwiseAbs().maxCoeff();
  const double radians = std::sqrt(w.bound()) * (piece.to - piece.from);
  result.matrix.error =
      Eigen::MatrixXd::Constant(2, 2, size * (full.rounding() + coefficient_error * radians));
  result.matrix.normalise();
  result.cost = {.steps = plan.steps, .rejections = 0, .right_hand_sides = full.evaluations()};
  if (!with_check) {
    result.check = result.matrix.value;
    return result;
  }
  const auto& half = table({plan.order, plan.steps / 2, piece.from, piece.to, std::move(terms.names)});
  half.propagate(batch, lanes);
  result.check = scaled(lanes, kappa);
  result.check.normalise();
  result.truncation_share = halving_share(plan.order);
  result.check_cost = {.steps = plan.steps / 2, .rejections = 0, .right_hand_sides = half.evaluations()};
  return result;
}

}  // namespace strutt
