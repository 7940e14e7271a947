#pragma once

#include <Eigen/Core>
#include <atomic>
#include <optional>

#include "chart/edge_surface.hpp"
#include "chart/sphere_descent.hpp"

namespace strutt {

/// Rays from the design to a surface of EdgeSurface, and the shortest of them.
class NearestPoint {
 public:
  NearestPoint(EdgeSurface& surface, Eigen::Index size, const std::atomic<bool>* cancel)
      : surface_(surface), centre_(Eigen::VectorXd::Ones(size)), cancel_(cancel) {}

  /// The shortest ray to which turning the ray in a direction leads, or a longer one where that cannot be
  /// shorter than `known`. Its value is the length, its error that of the surface along the ray. Nothing
  /// where the ray in this direction meets no surface within `most`.
  std::optional<SpherePoint> shortest(const Eigen::VectorXd& direction, double most, double known);

  /// What the length of a ray can be too large by: its own error, and that of its direction.
  static double error(const SpherePoint& ray);

  /// A direction in which F <= 0 at a distance: the least values of F over the sphere are looked for, from
  /// directions that are spread over it. Nothing if there is none among them.
  std::optional<Eigen::VectorXd> outside(double distance);

  Eigen::VectorXd point(const SpherePoint& ray) const { return centre_ + ray.value * ray.direction; }

 private:
  double value(const Eigen::VectorXd& direction, double length) {
    return surface_.at(centre_ + length * direction).value;
  }
  bool cancelled() const { return cancel_ != nullptr && *cancel_; }

  std::optional<SpherePoint> first(const Eigen::VectorXd& direction, double most);
  std::optional<SpherePoint> next_to(const Eigen::VectorXd& direction, const SpherePoint& best);
  /// Nothing where the ray is longer than `most`.
  std::optional<SpherePoint> solved(const Eigen::VectorXd& direction, double low, double high, double most);
  double uncertainty(const Eigen::VectorXd& direction, double length, double bracket);
  SpherePoint on_sphere(const Eigen::VectorXd& direction, double distance);

  EdgeSurface& surface_;
  Eigen::VectorXd centre_;
  const std::atomic<bool>* cancel_;
};

}  // namespace strutt
