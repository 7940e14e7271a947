#include "strutt/free_pendulum/energy.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "free_pendulum/orbit_start.hpp"
#include "reference/free_pendulum.hpp"
#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::energy_test {

using exact::Real;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kPiRounded = exact::pi<double>();

Real true_excess(double angle, double velocity) {
  const Real c = 2 * cos(Real(angle) / 2);
  return (velocity - c) * (velocity + c);
}

void check(double angle, double velocity) {
  INFO("phi = " << angle << ", v = " << velocity);
  const EnergyIntegral integral = energy_integral(angle, velocity);
  const Real truth = true_excess(angle, velocity);
  CHECK(abs(integral.separatrix_excess - truth) <= Real(integral.error));
  CHECK(integral.error <= 1.2e-16 * std::abs(integral.separatrix_excess) + 1e-29);
  CHECK(integral.kind == (truth < 0 ? MotionKind::libration : MotionKind::rotation));
  const Real sine = sin(Real(angle) / 2), w = sqrt(Real(velocity) * velocity + 4 * sine * sine);
  CHECK(abs(integral.maximal_velocity / w - 1) <= Real(0x1p-52));
  if (truth > 0) {
    check_within("smallest velocity of a rotation (relative)",
                 static_cast<double>(Real(abs(integral.minimal_velocity / sqrt(truth) - 1))), 8e-16);
    CHECK(std::isnan(integral.amplitude));
    return;
  }
  CHECK(integral.minimal_velocity == 0.0);
  const Real amplitude = 2 * asin(Real(w / 2));
  CHECK(abs(integral.amplitude / amplitude - 1) <= Real(0x1p-51));
  check_within("distance of a libration from the top (relative)",
               static_cast<double>(Real(abs(integral.from_top / (exact::pi<Real>() - amplitude) - 1))),
               2.5e-15);
}

}  // namespace

TEST_CASE("the separatrix excess keeps its digits and its sign",
          "[free_pendulum][energy][accuracy][ratchet]") {
  check(1.0, 0.5);
  check(0.3, 3.0);
  check(1e-9, 1e-9);
  check(1e-150, 0.0);  // 1 - cos would be 0
  check(kPiRounded, 0.0);
  check(kPiRounded, 1.2e-16);
  check(kPiRounded, 1.3e-16);
  check(3.0 * kPiRounded, 0.0);
  check(-5000.0, 1e-3);
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> angle(-10.0, 10.0), velocity(-3.0, 3.0), nearly(-4e-16, 4e-16);
  for (int i = 0; i < 300; ++i) check(angle(generator), velocity(generator));
  for (int i = 0; i < 300; ++i) {
    const double phi = angle(generator);
    check(phi, 2.0 * std::cos(0.5 * phi) + nearly(generator));
  }
}

TEST_CASE("the classes of orbits", "[free_pendulum][energy][exact][ratchet]") {
  CHECK(energy_integral(0.0, 0.0).kind == MotionKind::equilibrium);
  CHECK(energy_integral(0.0, 2.0).kind == MotionKind::separatrix);
  CHECK(energy_integral(0.0, -2.0).separatrix_excess == 0.0);
  CHECK(energy_integral(0.0, 2.0).error == 0.0);
  CHECK(energy_integral(0.0, std::nextafter(2.0, 0.0)).kind == MotionKind::libration);
  CHECK(energy_integral(0.0, std::nextafter(2.0, 3.0)).kind == MotionKind::rotation);
  check_close("constant of the first integral (relative)", energy_integral(1.0, 0.0).constant(),
              -2.0 * std::cos(1.0), 8e-16);
  CHECK(to_string(MotionKind::unresolved) == "unresolved");
  CHECK(energy_integral(3.0, 2.0 * std::cos(1.5)).kind != MotionKind::unresolved);
  // No double comes that close; a velocity of twice the precision does.
  const DoubleDouble nearest = ldexp(sin_cos(1.5).cosine, 1);
  CHECK(orbit_start(3.0, nearest, 0.0).kind == MotionKind::unresolved);
  CHECK(orbit_start(3.0, nearest * DoubleDouble(1.0 + 1e-15), 0.0).kind == MotionKind::rotation);
}

TEST_CASE("orbits of a given excess", "[free_pendulum][energy][exact][ratchet]") {
  CHECK(energy_integral(-4.0).kind == MotionKind::equilibrium);
  CHECK(energy_integral(0.0).kind == MotionKind::separatrix);
  CHECK(energy_integral(0.0).amplitude == kPiRounded);
  CHECK(energy_integral(-1e-300).kind == MotionKind::libration);
  check_close("orbit of a given excess (relative)", energy_integral(-1e-300).from_top, 1e-150, 8e-16);
  CHECK(energy_integral(1e-300).kind == MotionKind::rotation);
  check_close("orbit of a given excess (relative)", energy_integral(1e-300).minimal_velocity, 1e-150, 8e-16);
  check_close("orbit of a given excess (relative)", energy_integral(-2.0).amplitude, kPiRounded / 2, 8e-16);
  CHECK(energy_integral(-2.0).error == 0.0);
  CHECK(energy_integral(5.0).maximal_velocity == 3.0);
}

TEST_CASE("a velocity whose square overflows", "[free_pendulum][energy][extremes][ratchet]") {
  const EnergyIntegral integral = energy_integral(1.0, -1e200);
  CHECK(integral.kind == MotionKind::rotation);
  CHECK(std::isinf(integral.separatrix_excess));
  CHECK(integral.maximal_velocity == 1e200);
  check_close("smallest velocity of a rotation at 1e200 (relative)", integral.minimal_velocity, 1e200, 8e-16);
}

TEST_CASE("equilibria are centres and saddles in turn", "[free_pendulum][energy][ratchet]") {
  const double alpha = 1.7;
  for (const int index : {-3, -2, 0, 1, 4}) {
    const EquilibriumPoint point = equilibrium_point(index, alpha);
    CHECK(point.angle == index * kPiRounded);
    CHECK((point.type == EquilibriumPoint::Type::saddle) == (index % 2 != 0));
    Eigen::Matrix2cd jacobian;
    jacobian << 0.0, 1.0, -alpha * alpha * (index % 2 == 0 ? 1.0 : -1.0), 0.0;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2cd vector = point.eigenvectors.col(i);
      check_within("eigenvectors of an equilibrium",
                   (jacobian * vector - point.eigenvalues[static_cast<std::size_t>(i)] * vector).norm(),
                   8e-16);
    }
    CHECK(point.eigenvalues[0] == -point.eigenvalues[1]);
  }
  CHECK_THROWS_AS(equilibrium_point(0, 0.0), InvalidInput);
}

TEST_CASE("the separatrix and its time law", "[free_pendulum][energy][accuracy]") {
  for (const double tau : {-700.0, -3.0, -1e-200, 0.0, 1e-9, 0.5, 5.0, 20.0, 40.0}) {
    const Real t = tau, angle = 2 * atan(sinh(t)), velocity = 2 / cosh(t);
    CHECK(abs(separatrix_angle(tau) - angle) <= 4 * Real(0x1p-52) * abs(angle));
    CHECK(abs(separatrix_velocity(tau) - velocity) <= 4 * Real(0x1p-52) * velocity);
  }
  CHECK(separatrix_velocity(1e4) == 0.0);
  CHECK(separatrix_angle(1e4) == kPiRounded);
  for (const double angle : {-3.0, -1e-200, 0.0, 1.0, 3.1415, kPiRounded}) {
    const Real truth = asinh(Real(tan(Real(angle) / 2)));
    CHECK(abs(separatrix_time(angle) - truth) <= 4 * Real(0x1p-52) * abs(truth));
  }
  CHECK_THROWS_AS(separatrix_time(3.2), InvalidInput);
}

TEST_CASE("the first integral refuses misuse", "[free_pendulum][energy][error]") {
  CHECK_THROWS_AS(energy_integral(kNaN, 0.0), InvalidInput);
  CHECK_THROWS_AS(energy_integral(1.1e9, 0.0), InvalidInput);
  CHECK_THROWS_AS(energy_integral(0.0, kNaN), InvalidInput);
  CHECK_THROWS_AS(energy_integral(-4.1), InvalidInput);
  CHECK_THROWS_AS(energy_integral(kNaN), InvalidInput);
}

}  // namespace strutt::test::energy_test
