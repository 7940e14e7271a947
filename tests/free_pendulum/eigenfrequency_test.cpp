#include "strutt/free_pendulum/eigenfrequency.hpp"

#include <catch2/catch.hpp>

#include "reference/free_pendulum.hpp"
#include "strutt/base/error.hpp"

namespace strutt::test::eigenfrequency_test {

using exact::Real;

TEST_CASE("alpha of a scene is known to 30 digits", "[free_pendulum][eigenfrequency][accuracy]") {
  using Shape = PendulumTable::Shape;
  const auto shape = GENERATE(Shape::rod, Shape::point_mass, Shape::body);
  PendulumTable table{
      .shape = shape, .mass = 1.3, .length = 0.7, .inertia = 0.41, .centroid = 0.37, .gravity = 9.81};
  const Real g = table.gravity, l = table.length;
  const Real squared = shape == Shape::rod          ? Real(3 * g / (2 * l))
                       : shape == Shape::point_mass ? Real(g / l)
                                                    : Real(table.mass * g * table.centroid / table.inertia);
  const Eigenfrequency alpha = eigenfrequency(table);
  CHECK(abs((Real(alpha.value) + Real(alpha.rest)) / sqrt(squared) - 1) < Real(0x1p-98));
  CHECK(alpha.rest != 0.0);
}

TEST_CASE("an eigenfrequency is positive and its rest is small", "[free_pendulum][eigenfrequency][error]") {
  CHECK_NOTHROW(Eigenfrequency{}.validate());
  CHECK_THROWS_AS((Eigenfrequency{0.0, 0.0}.validate()), InvalidInput);
  CHECK_THROWS_AS((Eigenfrequency{1.0, 1e-10}.validate()), InvalidInput);
}

}  // namespace strutt::test::eigenfrequency_test
