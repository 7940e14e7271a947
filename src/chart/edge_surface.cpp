#include "chart/edge_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "chart/unstable_intervals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/tongue_edges.hpp"
#include "strutt/floquet/tongue_width.hpp"

namespace strutt {
namespace {

constexpr double kSharp = 1e-5;  // relative error of a gradient that is worth using

double sum_of_harmonics(const PeriodicFunction& f) {
  double sum = 0.0;
  for (const Harmonic& h : f.harmonics()) sum += std::abs(h.cosine) + std::abs(h.sine);
  return sum;
}

/// The mean on the edge. Of one harmonic by Mathieu's equation, delta = a/4 at q = 2 epsilon: the bound is
/// sharper.
CharacteristicValue mean_on_edge(const HillEquation& equation, const EdgeSurface::Edge& edge) {
  const auto harmonics = equation.coefficient.harmonics();
  if (harmonics.size() == 1 && harmonics.front().order == 1) {
    const double epsilon = equation.epsilon();
    const auto pair = characteristic_values(edge.tongue, edge.tongue, 2.0 * epsilon).front();
    const CharacteristicValue& x = edge.upper ? pair.a : *pair.b;
    return {0.25 * x.value, 0.25 * x.error + 2.0 * kUnit * epsilon};
  }
  const TongueEdges edges = tongue_edges(equation.coefficient, edge.tongue, edge.tongue).front();
  return edge.upper ? edges.upper : *edges.lower;
}

/// sign (mean - edge), and what is not known of it.
Margin edge_distance(const HillEquation& equation, const EdgeSurface::Edge& edge) {
  const double mean = equation.coefficient.mean();
  const CharacteristicValue at = mean_on_edge(equation, edge);
  const double inputs =
      (equation.coefficient_error + kUnit) * (std::abs(mean) + sum_of_harmonics(equation.coefficient));
  return {edge.sign * (mean - at.value), at.error + inputs};
}

void require_known(int tongue) {
  if (tongue > kLargestTongue)
    throw NumericalFailure("tongue " + std::to_string(tongue) + " is beyond the known ones");
}

}  // namespace

std::vector<EdgeSurface::Edge> bounding_edges(const Scene& scene, bool stable) {
  const LinearModel model = linear_model(scene);
  if (!is_undamped_fourier(model)) return {};
  MonodromyEngine engine;
  const double winding = analyse(engine, model, sharpest()).winding;
  if (stable) {
    const int below = static_cast<int>(std::floor(2.0 * winding));
    require_known(below + 1);
    return {{below, true, 1.0}, {below + 1, false, -1.0}};
  }
  const int own = static_cast<int>(std::lround(2.0 * winding));
  require_known(own);
  if (own == 0) return {{0, true, -1.0}};
  return {{own, true, -1.0}, {own, false, 1.0}};
}

EdgeSurface::EdgeSurface(const Scene& scene, const std::vector<std::string>& parameters,
                         std::optional<Edge> edge, double margin_sign)
    : scene_(scene),
      parameters_(parameters),
      value_(static_cast<Eigen::Index>(parameters.size())),
      edge_(edge),
      margin_sign_(margin_sign) {
  for (const std::string& path : parameters_) pointers_.push_back(&parameter(scene_, path));
  for (std::size_t i = 0; i < pointers_.size(); ++i) value_[static_cast<Eigen::Index>(i)] = *pointers_[i];
}

void EdgeSurface::set(const Eigen::VectorXd& x) {
  const auto values = this->values(x);
  for (std::size_t i = 0; i < values.size(); ++i) *pointers_[i] = values[i];
}

std::vector<double> EdgeSurface::values(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd products = value_.cwiseProduct(x);
  return {products.begin(), products.end()};
}

Margin EdgeSurface::at(const Eigen::VectorXd& x) {
  set(x);
  try {
    validate(scene_);
    const LinearModel model = linear_model(scene_);
    if (edge_) return edge_distance(std::get<HillEquation>(model), *edge_);
    const Stability s =
        analyse(engine_, model, sharpest(), {.verdict = false, .winding = false, .matrix = false});
    method_ = s.method;
    return {margin_sign_ * s.margin, s.margin_error};
  } catch (const InvalidInput&) {
    return {NAN, NAN};
  }
}

std::optional<EdgeSurface::Edge> EdgeSurface::behind_closed(const Eigen::VectorXd& x) {
  if (!edge_ || edge_->tongue == 0) return std::nullopt;
  set(x);
  const auto w = std::get<HillEquation>(linear_model(scene_)).coefficient, v = w.plus(-w.mean());
  const TongueWidth width = tongue_width(v, tongue_edges(v, edge_->tongue, edge_->tongue).front());
  const bool closed = width.value == 0.0 || width.relative_error >= 1.0;
  if (!closed) return std::nullopt;
  const int next = edge_->upper ? edge_->tongue - 1 : edge_->tongue + 1;
  if (next > kLargestTongue) return std::nullopt;
  return Edge{next, edge_->upper, edge_->sign};
}

std::optional<int> EdgeSurface::tongue(const Eigen::VectorXd& x) {
  if (edge_) return edge_->tongue;
  set(x);
  const double winding = analyse(engine_, linear_model(scene_), sharpest()).winding;
  if (std::isnan(winding)) return std::nullopt;
  return static_cast<int>(std::lround(2.0 * winding));
}

Eigen::VectorXd EdgeSurface::exact_gradient() {
  Eigen::VectorXd result(value_.size());
  double error = 0.0;
  for (Eigen::Index i = 0; i < value_.size(); ++i) {
    const Derivative rate = sensitivity(engine_, scene_, parameters_[static_cast<std::size_t>(i)]).edge;
    result[i] = rate.value * value_[i];
    error += std::abs(rate.error * value_[i]);
  }
  if (!(error <= kSharp * result.norm())) return {};
  return result;
}

/// How far the surface moves along the ray when one coordinate moves: F is not smooth where multipliers of
/// systems collide, the surface is.
Eigen::VectorXd EdgeSurface::difference_gradient(const Eigen::VectorXd& x, const Eigen::VectorXd& ray) {
  constexpr double kStep = 1e-5;
  const auto moved = [&](Eigen::Index i, double step) {
    Eigen::VectorXd from = x;
    from[i] += step;
    const auto value = [&](double s) { return at(from + s * ray).value; };
    double low = -8.0 * kStep, high = 8.0 * kStep, at_low = value(low), at_high = value(high);
    for (int doubling = 0; doubling < 12 && !(at_low > 0.0); ++doubling) at_low = value(low *= 2.0);
    for (int doubling = 0; doubling < 12 && at_high > 0.0; ++doubling) at_high = value(high *= 2.0);
    if (!(at_low > 0.0 && at_high < 0.0)) return at_low > 0.0 ? high : low;
    const auto close = [&](double a, double b) { return b - a <= 1e-14; };
    return bracketed_zero(value, low, high, at_low, at_high, close).middle();
  };
  Eigen::VectorXd result(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    result[i] = (moved(i, kStep) - moved(i, -kStep)) / (2.0 * kStep);
  return result;
}

Eigen::VectorXd EdgeSurface::normal(const Eigen::VectorXd& x, const Eigen::VectorXd& ray) {
  set(x);
  Eigen::VectorXd gradient = exact_gradient();
  if (gradient.size() == 0) gradient = difference_gradient(x, ray);
  const double length = gradient.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return {};
  return gradient / std::copysign(length, gradient.dot(ray));
}

}  // namespace strutt
