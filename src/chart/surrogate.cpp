#include "strutt/chart/surrogate.hpp"

#include <algorithm>
#include <cmath>

#include "chart/chebyshev.hpp"
#include "chart/surrogate_box.hpp"
#include "chart/surrogate_build.hpp"
#include "chart/surrogate_scope.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

/// T_k(t) and T_k'(t), k = 0 ... degree.
struct Basis {
  Eigen::VectorXd value, slope;

  Basis(double t, Eigen::Index terms) : value(terms), slope(terms) {
    value[0] = 1.0;
    slope[0] = 0.0;
    if (terms > 1) {
      value[1] = t;
      slope[1] = 1.0;
    }
    for (Eigen::Index k = 2; k < terms; ++k) {
      value[k] = 2.0 * t * value[k - 1] - value[k - 2];
      slope[k] = 2.0 * value[k - 1] + 2.0 * t * slope[k - 1] - slope[k - 2];
    }
  }
};

double half_width(const SurrogateBox& box, std::size_t axis) {
  return 0.5 * (box.high[axis] - box.low[axis]);
}

/// d coordinate / d parameter.
double stretch(const Axis& axis, double value) { return axis.scale == AxisScale::linear ? 1.0 : 1.0 / value; }

}  // namespace

double Surrogate::coordinate(const Axis& axis, double value) {
  return axis.scale == AxisScale::linear ? value : std::log(std::abs(value));
}

std::string Surrogate::refusal(const Scene& scene, const Axis& x, const Axis& y) {
  return surrogate_scope(scene, x, y).refusal;
}

Surrogate::Surrogate(const Scene& scene, const Axis& x, const Axis& y, const SurrogateOptions& options) {
  const DefaultFloatingPoint environment;
  x.validate("x");
  y.validate("y");
  MonodromyOptions{.tolerance = options.tolerance}.validate();
  const auto scope = surrogate_scope(scene, x, y);
  if (!scope.refusal.empty())
    throw InvalidInput("no surrogate over " + x.parameter + " and " + y.parameter + ": " + scope.refusal);
  auto built = build_surrogate(scene, x, y, options, scope, surrogate_source(scope, scene, x, y, options));
  data_ = std::move(built.data);
  cancelled_ = built.cancelled;
}

Surrogate::Surrogate(SurrogateData data) : data_(std::move(data)) {
  data_.x.validate("x");
  data_.y.validate("y");
  parameter(data_.scene, data_.x.parameter);
  parameter(data_.scene, data_.y.parameter);
  for (const auto& box : data_.boxes) {
    if (!box.interpolated) continue;
    const auto& c = box.coefficients;
    const auto n = std::lround(std::sqrt(static_cast<double>(c.size())));
    const bool same_shape = !c.empty() && std::all_of(c.begin(), c.end(), [&](const auto& m) {
      return m.size() > 0 && m.rows() == c[0].rows() && m.cols() == c[0].cols() && m.allFinite();
    });
    if (!same_shape || n % 2 != 0 || static_cast<std::size_t>(n * n) != c.size() ||
        box.error.size() != c.size())
      throw InvalidInput("a box of the surrogate has coefficients that do not fit together");
  }
}

std::size_t Surrogate::box_at(double x, double y) const {
  const double at_x = coordinate(data_.x, x), at_y = coordinate(data_.y, y);
  const auto found = std::find_if(data_.boxes.begin(), data_.boxes.end(), [&](const SurrogateBox& box) {
    return at_x >= box.low[0] && at_x <= box.high[0] && at_y >= box.low[1] && at_y <= box.high[1];
  });
  if (found == data_.boxes.end() || !found->interpolated) return SurrogateEntries::kNone;
  return static_cast<std::size_t>(found - data_.boxes.begin());
}

std::optional<SurrogateGradient> Surrogate::gradient(double x, double y) const {
  const DefaultFloatingPoint environment;
  const std::size_t found = box_at(x, y);
  if (found == SurrogateEntries::kNone) return std::nullopt;
  const SurrogateBox* const box = &data_.boxes[found];
  const auto place = [&](std::size_t axis, double v) {
    return (v - 0.5 * (box->low[axis] + box->high[axis])) / half_width(*box, axis);
  };
  const Basis s(place(0, coordinate(data_.x, x)), box->coefficients[0].rows());
  const Basis t(place(1, coordinate(data_.y, y)), box->coefficients[0].cols());
  const double by_x = stretch(data_.x, x) / half_width(*box, 0),
               by_y = stretch(data_.y, y) / half_width(*box, 1);
  SurrogateGradient result;
  result.exponent = box->exponent;
  result.kappa = box->kappa;
  result.value = result.by_x = result.by_y = error_matrix(*box);  // of the same shape
  const Eigen::Index n = result.value.rows();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto& c = box->coefficients[static_cast<std::size_t>(i * n + j)];
      result.value(i, j) = s.value.dot(c * t.value);
      result.by_x(i, j) = by_x * s.slope.dot(c * t.value);
      result.by_y(i, j) = by_y * s.value.dot(c * t.slope);
    }
  }
  return result;
}

}  // namespace strutt
