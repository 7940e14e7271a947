#pragma once

#include <Eigen/Core>

namespace strutt::detail {

/// The errors that a state of two components can have, as a parallelogram of right angles that turns with the
/// flow (Lohner's method with approximate propagators): { Q e : |e_i| <= r_i }. It neither grows under a
/// rotation nor exceeds the growth that the propagators have.
class ErrorBox {
 public:
  explicit ErrorBox(const Eigen::Vector2d& radii) : radii_(radii) {}

  /// Bounds of the components of propagator * error.
  Eigen::Vector2d bound(const Eigen::Matrix2d& propagator) const;

  /// error -> propagator * error + anything of at most `added` in each component.
  void advance(const Eigen::Matrix2d& propagator, double added);

 private:
  Eigen::Matrix2d axes_ = Eigen::Matrix2d::Identity();
  Eigen::Vector2d radii_;
};

}  // namespace strutt::detail
