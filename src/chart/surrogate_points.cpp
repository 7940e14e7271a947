#include <limits>

#include "chart/point_equation.hpp"
#include "chart/surrogate_box.hpp"
#include "chart/surrogate_scope.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {
namespace {

using Points = std::span<const std::array<double, 2>>;

/// A scene with two parameters in place.
class ModelAt {
 public:
  explicit ModelAt(const SurrogateData& data)
      : scene_(data.scene),
        x_(&parameter(scene_, data.x.parameter)),
        y_(&parameter(scene_, data.y.parameter)) {}
  ModelAt(const ModelAt&) = delete;

  LinearModel operator()(const std::array<double, 2>& point) {
    *x_ = point[0];
    *y_ = point[1];
    return linear_model(scene_);
  }

 private:
  Scene scene_;
  double *x_, *y_;
};

/// Interpolated propagators with their bounds, point by point.
class Interpolated {
 public:
  Interpolated(const Surrogate& surrogate, Points points)
      : boxes_(surrogate.boxes()),
        entries_(surrogate.entries(points)),
        errors_(boxes_.size()),
        points_(points.size()) {}

  /// The box of a point, if there is one.
  const SurrogateBox* box(std::size_t p) const {
    return entries_.box[p] == SurrogateEntries::kNone ? nullptr : &boxes_[entries_.box[p]];
  }

  /// In the state of another kappa.
  PointPropagator at(std::size_t p, double kappa) {
    const auto& box = boxes_[entries_.box[p]];
    auto& error = errors_[entries_.box[p]];
    if (error.size() == 0) error = evaluation_error(box);
    Eigen::MatrixXd value = error;  // of the same shape
    const auto n = static_cast<std::size_t>(value.rows());
    for (std::size_t f = 0; f < n * n; ++f)
      value(static_cast<Eigen::Index>(f / n), static_cast<Eigen::Index>(f % n)) =
          entries_.values[f * points_ + p];
    return at_kappa(value, error, kappa / box.kappa);
  }

 private:
  const std::vector<SurrogateBox>& boxes_;
  SurrogateEntries entries_;
  std::vector<Eigen::MatrixXd> errors_;  // of boxes, when first needed
  std::size_t points_;
};

}  // namespace

SurrogateEntries Surrogate::entries(Points points) const {
  SurrogateEntries result;
  std::vector<std::vector<std::size_t>> members(data_.boxes.size());
  std::size_t functions = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    result.box.push_back(box_at(points[p][0], points[p][1]));
    if (result.box[p] == SurrogateEntries::kNone) continue;
    members[result.box[p]].push_back(p);
    functions = data_.boxes[result.box[p]].coefficients.size();
  }
  result.values.assign(functions * points.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<double> x, y, values;
  for (std::size_t b = 0; b < members.size(); ++b) {
    const auto& here = members[b];
    if (here.empty()) continue;
    x.clear();
    y.clear();
    for (const std::size_t p : here) {
      x.push_back(coordinate(data_.x, points[p][0]));
      y.push_back(coordinate(data_.y, points[p][1]));
    }
    values.resize(functions * here.size());
    evaluate(data_.boxes[b], x, y, values.data());
    for (std::size_t f = 0; f < functions; ++f) {
      for (std::size_t i = 0; i < here.size(); ++i)
        result.values[f * points.size() + here[i]] = values[f * here.size() + i];
    }
  }
  return result;
}

std::vector<std::optional<HillMonodromy>> Surrogate::hill_monodromies(Points points) const {
  const DefaultFloatingPoint environment;
  std::vector<std::optional<HillMonodromy>> results(points.size());
  Interpolated interpolated(*this, points);
  ModelAt model_at(data_);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto* const box = interpolated.box(p);
    if (box == nullptr) continue;
    const auto model = model_at(points[p]);
    if (!hill_equation_of(model)) continue;
    const auto scale = point_equation(model, data_.even_phase);
    if (!scale) continue;
    results[p] = hill_monodromy_of(data_.kind, interpolated.at(p, scale->sample.kappa), box->exponent,
                                   scale->sample, scale->angular_frequency, data_.tolerance);
  }
  return results;
}

std::vector<std::optional<Monodromy>> Surrogate::monodromies(Points points) const {
  const DefaultFloatingPoint environment;
  std::vector<std::optional<Monodromy>> results(points.size());
  if (!data_.scene.linear || data_.scene.linear->degrees_of_freedom() == 1) {
    const auto found = hill_monodromies(points);
    for (std::size_t p = 0; p < points.size(); ++p)
      if (found[p]) results[p] = widened(*found[p]);
  }
  Interpolated interpolated(*this, points);
  ModelAt model_at(data_);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto* const box = interpolated.box(p);
    if (box == nullptr || results[p]) continue;
    const auto model = model_at(points[p]);
    if (hill_equation_of(model)) continue;
    const auto scale = point_equation(model, std::nullopt);
    results[p] = system_monodromy_of(interpolated.at(p, scale->sample.kappa), box->exponent, scale->sample,
                                     scale->angular_frequency, data_.tolerance);
  }
  return results;
}

std::optional<HillMonodromy> Surrogate::hill_monodromy(double x, double y) const {
  const std::array<double, 2> point{x, y};
  return hill_monodromies({&point, 1}).front();
}

std::optional<Monodromy> Surrogate::monodromy(double x, double y) const {
  const std::array<double, 2> point{x, y};
  return monodromies({&point, 1}).front();
}

}  // namespace strutt
