#include "chart/reciprocal_cells.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/constants.hpp"
#include "chart/point_equation.hpp"
#include "chart/surrogate_scope.hpp"
#include "floquet/reciprocal_sums.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;

/// The system, if it is one of those that ReciprocalCells serves.
const LinearPeriodicSystem* served(const LinearModel& model) {
  const auto* const system = std::get_if<LinearPeriodicSystem>(&model);
  if (system == nullptr || system->degrees_of_freedom() != 2) return nullptr;
  const auto damping = system->proportional_damping();
  const bool reciprocal = damping && *damping >= 0.0 && system->stiffness.is_symmetric() &&
                          system->mass == system->mass.transpose();
  return reciprocal ? system : nullptr;
}

/// The mass matrix of the systems at the sampled points, if all are served and have the same.
std::optional<Matrix2d> common_mass(const Scene& scene, const Axis& x, const Axis& y) {
  const auto models = sampled_models(scene, x, y);
  if (!models) return std::nullopt;
  const auto* const first = served(models->front());
  for (const auto& model : *models) {
    const auto* const system = served(model);
    if (first == nullptr || system == nullptr || system->mass != first->mass) return std::nullopt;
  }
  return Matrix2d(first->mass);
}

/// Blocks of a matrix of four rows and columns.
struct Blocks {
  Matrix2d a, b, c, d;

  explicit Blocks(const Matrix4d& m)
      : a(m.topLeftCorner<2, 2>()),
        b(m.topRightCorner<2, 2>()),
        c(m.bottomLeftCorner<2, 2>()),
        d(m.bottomRightCorner<2, 2>()) {}

  double largest() const {
    return std::max(std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()),
                    std::max(c.cwiseAbs().maxCoeff(), d.cwiseAbs().maxCoeff()));
  }
};

/// [I, 0; -slope, I] N [I, 0; slope, I], or with |slope| instead.
Blocks sheared(Blocks n, double slope, double sign) {
  n.c += sign * slope * n.a + slope * (n.d + sign * slope * n.b);
  n.a += slope * n.b;
  n.d += sign * slope * n.b;
  return n;
}

/// Monodromy::error, see restore_damping and scaled_error.
double error_of(const Blocks& value, const Blocks& error, const Blocks& size, long exponent, double h) {
  double largest = value.largest();
  double largest_error = std::max(error.largest(), error.a.trace() + error.d.trace());
  double unit = std::ldexp(1.0, static_cast<int>(std::clamp(exponent, -1000L, 1000L)));
  if (h > 0.0) {
    const double slope = 0.5 * h / std::numbers::pi;
    Blocks bound = sheared(error, slope, 1.0);
    const Blocks rounding = sheared(size, slope, 1.0);
    const double units = (8.0 + 4.0 * h) * kUnit;
    bound.a += units * rounding.a;
    bound.b += units * rounding.b;
    bound.c += units * rounding.c;
    bound.d += units * rounding.d;
    largest = sheared(value, slope, -1.0).largest();
    largest_error = std::max(bound.largest(), bound.a.trace() + bound.d.trace());
    unit *= std::exp(-h);
  }
  if (!std::isfinite(largest) || !std::isfinite(largest_error))
    return std::numeric_limits<double>::infinity();
  return (largest * unit > 1.0 ? largest_error / largest : largest_error * unit) + 6.0 * kUnit;
}

}  // namespace

bool ReciprocalCells::serves(const Scene& scene, const Axis& x, const Axis& y) {
  return common_mass(scene, x, y).has_value();
}

std::optional<ReciprocalCells> ReciprocalCells::of(const Scene& scene, const ChartRequest& request) {
  const auto mass = common_mass(scene, request.x, request.y);
  if (!mass) return std::nullopt;
  ReciprocalCells result;
  result.tolerance_ = request.tolerance;
  result.mass_ = *mass;
  result.inverse_mass_ = result.mass_.inverse();
  Scene point = scene;
  double &x = parameter(point, request.x.parameter), &y = parameter(point, request.y.parameter);
  const auto half_damping = [&](double at_x, double at_y) {
    x = at_x;
    y = at_y;
    try {
      return point_equation(linear_model(point), std::nullopt)->sample.half_damping;
    } catch (const InvalidInput&) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  };
  const auto table = ProductTable::of(half_damping, request.x, request.y);
  if (!table) return std::nullopt;
  result.half_damping_ = *table;
  return result;
}

Stability ReciprocalCells::assess(std::size_t i, std::size_t j, const SurrogateBox& box,
                                  const Matrix4d& value) const {
  Matrix4d in_state = value, error = Eigen::Map<const Matrix4d>(box.error.data()).transpose();
  for (auto* m : {&in_state, &error}) {  // from the box's kappa to 1, see at_kappa
    m->topRightCorner<2, 2>() /= box.kappa;
    m->bottomLeftCorner<2, 2>() *= box.kappa;
  }
  error += 4.0 * kUnit * in_state.cwiseAbs();
  const double h = half_damping_(i, j);
  const Matrix4d size = in_state.cwiseAbs();
  const Blocks n(in_state), bounds(error);
  Stability result;
  result.method = Method::surrogate;
  result.error = error_of(n, bounds, Blocks(size), box.exponent, h);
  result.outcome = result.error <= tolerance_ ? Outcome::converged : Outcome::tolerance_not_reached;
  // canonical coordinates (q, mass q')
  const Blocks wide(Matrix4d(error + 32.0 * kUnit * size));
  const Matrix2d to = mass_.cwiseAbs(), from = inverse_mass_.cwiseAbs();
  const auto stability =
      reciprocal_stability({n.a, n.b * inverse_mass_, mass_ * n.c, mass_ * n.d * inverse_mass_, wide.a,
                            wide.b * from, to * wide.c, to * wide.d * from},
                           box.exponent, h);
  result.margin = stability.margin.value;
  result.margin_error = stability.margin.error;
  result.verdict = verdict_of(stability.margin);
  result.growth = stability.growth;
  const bool in_range = std::abs(box.exponent) < 900;  // of doubles
  result.discriminant = std::ldexp(n.a.trace() + n.d.trace(), in_range ? static_cast<int>(box.exponent) : 0);
  result.log_scale = (in_range ? 0.0 : static_cast<double>(box.exponent) * std::numbers::ln2) - h;
  return result;
}

}  // namespace strutt
