// The closed form for four states against the eigenvalues of six.
#include "floquet/reciprocal_sums.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "strutt/floquet/verdict.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::reciprocal_sums_test {

namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;

const Matrix2d kMass{{1.3, 0.2}, {0.2, 0.8}};

/// A product of symplectic shears in q and in mass q' by random symmetric matrices, state (q, q').
MatrixXd random_propagator(std::mt19937_64& random, double strength) {
  std::uniform_real_distribution<double> entry(-strength, strength);
  const auto symmetric = [&] {
    const double off = entry(random);
    return Matrix2d{{entry(random), off}, {off, entry(random)}};
  };
  MatrixXd n = MatrixXd::Identity(4, 4);
  for (int step = 0; step < 2; ++step) {
    MatrixXd drift = MatrixXd::Identity(4, 4), push = drift;
    drift.topRightCorner(2, 2) = symmetric() * kMass;
    push.bottomLeftCorner(2, 2) = kMass.inverse() * symmetric();
    n = push * drift * n;
  }
  return n;
}

/// Beside it a third oscillator that turns by a quarter a period, whose rho is 0.
SystemStability with_six_states(const MatrixXd& n, double bound, long exponent, double h) {
  MatrixXd wide = MatrixXd::Zero(6, 6), error = wide, mass = MatrixXd::Identity(3, 3);
  mass.topLeftCorner(2, 2) = kMass;
  for (int i : {0, 1}) {
    for (int j : {0, 1}) {
      wide.block(3 * i, 3 * j, 2, 2) = n.block(2 * i, 2 * j, 2, 2);
      error.block(3 * i, 3 * j, 2, 2).setConstant(bound);
    }
  }
  wide(2, 5) = std::ldexp(1.0, static_cast<int>(-exponent));
  wide(5, 2) = -wide(2, 5);
  return reciprocal_stability(BoundedMatrix{{wide, exponent}, error}, mass, h);
}

}  // namespace

TEST_CASE("four states in closed form are as six by eigenvalues", "[floquet][multipliers][ratchet]") {
  const double h = GENERATE(0.0, 0.4), strength = GENERATE(0.7, 1.5, 4.0);
  const long exponent = GENERATE(0L, 3L);
  const double bound = 1e-12;
  std::mt19937_64 random(11);
  int real = 0, complex = 0, resolved = 0;
  for (int i = 0; i < 300; ++i) {
    const MatrixXd n = std::ldexp(1.0, static_cast<int>(-exponent)) * random_propagator(random, strength);
    const auto four =
        reciprocal_stability(BoundedMatrix{{n, exponent}, MatrixXd::Constant(4, 4, bound)}, kMass, h);
    const auto six = with_six_states(n, bound, exponent, h);
    INFO("h " << h << ", strength " << strength << ", propagator " << i);
    if (verdict_of(four.margin) == Verdict::unresolved || verdict_of(six.margin) == Verdict::unresolved)
      continue;
    ++resolved;
    (four.margin.value == -four.growth ? complex : real) += 1;
    CHECK(verdict_of(four.margin) == verdict_of(six.margin));
    CHECK(std::abs(four.margin.value - six.margin.value) <= four.margin.error + six.margin.error);
    check_within("growth by the sums of reciprocal pairs against that of six states",
                 std::abs(four.growth - six.growth), 1.5e-13);
  }
  CHECK(resolved > 250);
  CHECK(real > 20);
  CHECK(complex > 5);
}

TEST_CASE("the sums of two uncoupled rotations are twice their cosines", "[floquet][multipliers]") {
  const double first = 0.7, second = GENERATE(0.7, 0.7 + 1e-9, 2.9);
  SymplecticBlocks n;
  n.a = n.d = Eigen::Vector2d(std::cos(first), std::cos(second)).asDiagonal();
  n.b = Eigen::Vector2d(std::sin(first), std::sin(second)).asDiagonal();
  n.c = -n.b;
  n.a_error = n.b_error = n.c_error = n.d_error = Matrix2d::Constant(1e-14);
  const auto found = reciprocal_stability(n, 0, 0.0);
  const double margin = 1.0 - std::max(std::abs(std::cos(first)), std::abs(std::cos(second)));
  CHECK(std::abs(found.margin.value - margin) <= found.margin.error);
  if (second != first) {
    CHECK(verdict_of(found.margin) == Verdict::stable);
    CHECK(found.growth == 0.0);
  } else {
    CHECK(verdict_of(found.margin) == Verdict::unresolved);  // a collision: nothing proves that it stays real
  }
}

}  // namespace strutt::test::reciprocal_sums_test
