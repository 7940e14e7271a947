#include "floquet/hill_sensitivity.hpp"

namespace strutt {
namespace {

/// [of 0; by of]: `of` for q and S, `by` for what S takes from q. Empty if both are.
Eigen::MatrixXd block(const Eigen::MatrixXd& of, const Eigen::MatrixXd& by, Eigen::Index d) {
  if (of.size() == 0 && by.size() == 0) return {};
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(2 * d, 2 * d);
  if (of.size() > 0) result.topLeftCorner(d, d) = result.bottomRightCorner(d, d) = of;
  if (by.size() > 0) result.bottomLeftCorner(d, d) = by;
  return result;
}

const MatrixHarmonic* find(const PeriodicMatrix& matrix, int order) {
  for (const auto& h : matrix.harmonics)
    if (h.order == order) return &h;
  return nullptr;
}

PeriodicMatrix block(const PeriodicMatrix& of, const PeriodicMatrix& by, Eigen::Index d) {
  PeriodicMatrix result;
  result.mean = block(of.mean, by.mean, d);
  const MatrixHarmonic none;
  const auto add = [&](const MatrixHarmonic& x, const MatrixHarmonic& y, int order) {
    result.harmonics.push_back({order, block(x.cosine, y.cosine, d), block(x.sine, y.sine, d)});
  };
  for (const auto& h : of.harmonics) {
    const auto* other = find(by, h.order);
    add(h, other != nullptr ? *other : none, h.order);
  }
  for (const auto& h : by.harmonics)
    if (find(of, h.order) == nullptr) add(none, h, h.order);
  if (result.mean.size() == 0 && !result.harmonics.empty()) result.mean = Eigen::MatrixXd::Zero(2 * d, 2 * d);
  return result;
}

}  // namespace

Monodromy augmented_monodromy(MonodromyEngine& engine, const LinearPeriodicSystem& canonical,
                              const SystemDerivative& derivative, const MonodromyOptions& options) {
  const auto d = canonical.mass.rows();
  LinearPeriodicSystem augmented;
  augmented.period = canonical.period;
  augmented.mass = block(canonical.mass, derivative.mass, d);
  augmented.damping = block(canonical.damping, derivative.damping, d);
  augmented.stiffness = block(canonical.stiffness, derivative.stiffness, d);
  return engine.compute(augmented, options);
}

}  // namespace strutt
