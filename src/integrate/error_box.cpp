#include "integrate/error_box.hpp"

#include <cmath>
#include <limits>

namespace strutt::detail {
namespace {

// Second order and the rounding of the products themselves.
constexpr double kSlack = 1.0 + 1e-6;

}  // namespace

Eigen::Vector2d ErrorBox::bound(const Eigen::Matrix2d& propagator) const {
  return kSlack * ((propagator * axes_).cwiseAbs() * radii_);
}

void ErrorBox::advance(const Eigen::Matrix2d& propagator, double added) {
  const Eigen::Matrix2d image = propagator * axes_;
  // The first axis follows the longer side: the overestimate of the other one then costs least.
  const double first = image.col(0).stableNorm() * radii_[0];
  const double second = image.col(1).stableNorm() * radii_[1];
  Eigen::Vector2d longer = first >= second ? image.col(0) : image.col(1);
  const double length = longer.stableNorm();
  if (!(length > 0.0))
    longer = Eigen::Vector2d::UnitX();
  else
    longer /= length;
  Eigen::Matrix2d turned;
  turned << longer[0], -longer[1], longer[1], longer[0];
  const Eigen::Vector2d noise = Eigen::Vector2d::Constant(added);
  radii_ =
      kSlack * ((turned.transpose() * image).cwiseAbs() * radii_ + turned.cwiseAbs().transpose() * noise);
  axes_ = turned;
  if (!turned.allFinite() || !radii_.allFinite()) {
    axes_.setIdentity();
    radii_.setConstant(std::numeric_limits<double>::infinity());
  }
}

}  // namespace strutt::detail
