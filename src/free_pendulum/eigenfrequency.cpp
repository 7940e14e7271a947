#include "strutt/free_pendulum/eigenfrequency.hpp"

#include <cmath>

#include "free_pendulum/double_double.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

DoubleDouble alpha_squared(const PendulumTable& p) {
  switch (p.shape) {
    case PendulumTable::Shape::rod:
      return two_product(1.5, p.gravity) / DoubleDouble(p.length);
    case PendulumTable::Shape::point_mass:
      return DoubleDouble(p.gravity) / DoubleDouble(p.length);
    case PendulumTable::Shape::body:
      break;
  }
  return two_product(p.mass, p.gravity) * DoubleDouble(p.centroid) / DoubleDouble(p.inertia);
}

}  // namespace

void Eigenfrequency::validate() const {
  require(value > 0.0 && std::isfinite(value), "alpha", value, "finite and > 0");
  require(std::abs(rest) <= 0x1p-52 * value, "the rest of alpha", rest, "below a rounding of alpha");
}

Eigenfrequency eigenfrequency(const PendulumTable& pendulum) {
  const DefaultFloatingPoint environment;
  const DoubleDouble alpha = sqrt(alpha_squared(pendulum));
  const Eigenfrequency result{alpha.hi, alpha.lo};
  result.validate();
  return result;
}

}  // namespace strutt
