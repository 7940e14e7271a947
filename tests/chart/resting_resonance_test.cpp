// Where tongues of systems begin, against closed forms in 50 digits.
#include "chart/resting_resonance.hpp"
#include "support/ratchet.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>

namespace strutt::test::resting_resonance_test {
namespace {

using boost::math::constants::pi;
using Exact = boost::multiprecision::cpp_bin_float_50;

/// Two oscillators with any masses and coupling, at rest.
struct Oscillators {
  double m00, m01, m11, k00, k01, k11;

  explicit Oscillators(std::mt19937_64& random, double square) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    m00 = 1.0 + unit(random), m11 = 1.0 + unit(random), m01 = 0.5 * unit(random) - 0.25;
    k00 = square * (1.0 + unit(random)), k11 = square * (2.0 + unit(random));
    k01 = square * (unit(random) - 0.5);
  }

  Scene scene(double period) const {
    Scene scene;
    scene.linear = LinearPeriodicSystem{
        .period = period, .mass = Eigen::Matrix2d{{m00, m01}, {m01, m11}}, .damping = {}, .stiffness = {}};
    scene.linear->stiffness.mean = Eigen::Matrix2d{{k00, k01}, {k01, k11}};
    return scene;
  }

  /// Both frequencies: det(K - w^2 M) = 0.
  std::pair<Exact, Exact> frequencies() const {
    const Exact a = Exact(m00) * m11 - Exact(m01) * m01,
                b = Exact(m00) * k11 + Exact(m11) * k00 - 2 * Exact(m01) * k01,
                c = Exact(k00) * k11 - Exact(k01) * k01, root = sqrt(b * b - 4 * a * c);
    return {sqrt((b - root) / (2 * a)), sqrt((b + root) / (2 * a))};
  }
};

/// How far a resonance is from the closed form, in units of its bound.
double share_of_bound(const CertainZero& found, const Exact& expected) {
  return static_cast<double>(abs(Exact(found.position) - expected)) / found.error;
}

}  // namespace

TEST_CASE("the period of a resonance at rest is good to its error, small or large",
          "[chart][tongues][ratchet]") {
  std::mt19937_64 random(1);
  double most = 0.0, most_roundings = 0.0, widest = 0.0;
  for (const double square : {1e12, 1.0, 1e-12, 1e-24})
    for (int sample = 0; sample < 50; ++sample) {
      const Oscillators oscillators(random, square);
      const auto [slow, fast] = oscillators.frequencies();
      for (const int k : {1, 2, 5}) {
        const struct {
          Exact period;
          Mechanism mechanism;
        } cases[] = {{k * pi<Exact>() / slow, k % 2 == 0 ? Mechanism::plus_one : Mechanism::minus_one},
                     {2 * k * pi<Exact>() / (slow + fast), Mechanism::complex_pair}};
        for (const auto& [period, mechanism] : cases) {
          const auto near = static_cast<double>(period);
          const auto found =
              resting_resonance(oscillators.scene(near), {"linear.period", 0.5 * near, 2.0 * near}, mechanism,
                                near * (1.0 + 1e-5), 1e-4 * near);
          CAPTURE(square, sample, k, near);
          REQUIRE(found);
          most = std::max(most, share_of_bound(*found, period));
          const double off = static_cast<double>(abs(Exact(found->position) - period));
          most_roundings = std::max(most_roundings, off / (0x1p-52 * std::max(1.0, near)));
          widest = std::max(widest, found->error / near);
        }
      }
    }
  CHECK(most <= 1.0);
  CHECK(most_roundings > 1.0);  // more than the rounding of the position itself
  check_within("bound of a resonance at rest (relative)", widest, 1e-13);
}

TEST_CASE("the error of a resonance at rest knows how slowly the frequencies change",
          "[chart][tongues][ratchet]") {
  // (p - w^2 m00)(k11 - w^2 m11) = (k01 - w^2 m01)^2, w = pi k/T, is solved for p = k00; w hardly depends on
  // p where the mode is that of the other mass
  std::mt19937_64 random(2);
  double widest = 0.0;
  for (const double square : {1e8, 1.0})
    for (const double coupling : {1.0, 1e-2, 1e-4}) {
      Oscillators oscillators(random, square);
      oscillators.m01 = 0.0;
      oscillators.k01 = coupling * square;
      const double period = 2.0 / std::sqrt(square);
      const Exact w = pi<Exact>() / period, w2 = w * w;
      const double shift = coupling * 0.7;  // of the other mass's own frequency
      oscillators.k11 = static_cast<double>(w2 * oscillators.m11 * (1 + shift));
      const Exact expected = w2 * oscillators.m00 + Exact(oscillators.k01) * oscillators.k01 /
                                                        (oscillators.k11 - w2 * oscillators.m11);
      const auto near = static_cast<double>(expected);
      const auto found =
          resting_resonance(oscillators.scene(period), {"linear.stiffness.mean.0.0", 0.2 * near, 4.0 * near},
                            Mechanism::minus_one, near * (1.0 + 1e-3), 1e-2 * near);
      CAPTURE(square, coupling, near);
      REQUIRE(found);
      CHECK(share_of_bound(*found, expected) <= 1.0);
      CHECK(found->error > 0x1p-52 * near);
      widest = std::max(widest, found->error / near);
    }
  check_within("bound of a resonance at rest of weakly coupled masses (relative)", widest, 1e-13);
}

}  // namespace strutt::test::resting_resonance_test
