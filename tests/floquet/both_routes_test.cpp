// Edges as eigenvalues of the Fourier side and as zeros of the half-period factors of the propagator: two
// routes that share no mathematics beyond the equation, compared over the whole range of the first.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::both_routes_test {

using strutt::test::check_within;

namespace {

struct Factor {
  double value, error;
  bool certain() const { return std::abs(value) > error; }
};

/// The half-period factor that vanishes at a characteristic value, with its bound, both divided by one power
/// of two.
class HalfPeriod {
 public:
  HalfPeriod(bool even, int order, double q) : q_(q) {
    // u1', u1 at a of even, odd order; u2, u2' at b of even, odd order
    column_ = even ? 0 : 1;
    row_ = even == (order % 2 == 0) ? 1 : 0;
  }
  Factor operator()(double a) {
    const auto half =
        engine_.compute(mathieu_a_q(a, q_), {.tolerance = 1e-12, .method = Method::propagator}).half.value();
    if (!exponent_) exponent_ = half.value.exponent;
    const auto scale = [&](double x) {
      return std::ldexp(x, static_cast<int>(half.value.exponent - *exponent_));
    };
    return {scale(half.value.mantissa(row_, column_)), scale(half.error(row_, column_))};
  }

 private:
  MonodromyEngine engine_;
  double q_;
  int row_, column_;
  std::optional<long> exponent_;
};

/// Widens value -+ h until the factor has certain and opposite signs there, so that it has a zero between.
/// Returns h over the sum of both bounds. A sign is certain from twice the factor's bound on, and h grows by
/// steps of a half: 3 is the most that honest bounds give where the factor is a straight line with one bound,
/// 4 leaves room for what it is.
double disagreement(const CharacteristicValue& found, HalfPeriod factor, double q) {
  for (double h = found.error;; h *= 1.5) {
    const Factor low = factor(found.value - h), high = factor(found.value + h);
    const double slope = std::abs(high.value - low.value) / (2.0 * h);
    const double allowed = found.error + std::max(low.error, high.error) / slope;
    if (low.certain() && high.certain())
      return (low.value > 0.0) != (high.value > 0.0) ? h / allowed : HUGE_VAL;
    if (h > 1e-9 * (1.0 + std::abs(found.value) + 2.0 * std::abs(q))) return HUGE_VAL;
  }
}

/// The largest disagreement of `count` values with |q| between 10^from and 10^to and orders up to `last`,
/// evenly distributed in their logarithms, of both kinds and both signs of q.
double largest_disagreement(int count, double from, double to, int last, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double largest = 0.0;
  for (int k = 0; k < count; ++k) {
    const double q = std::pow(10.0, std::lerp(from, to, unit(random))) * (k % 2 == 0 ? 1.0 : -1.0);
    const int order = k % 10 == 0 ? 0 : static_cast<int>(std::pow(last + 1.0, unit(random)));
    const bool even = order == 0 || unit(random) < 0.5;
    const auto pair = characteristic_values(order, order, q).at(0);
    const double found = disagreement(even ? pair.a : pair.b.value(), HalfPeriod(even, order, q), q);
    CAPTURE(q, order, even, found);
    CHECK(found <= 4.0);
    largest = std::max(largest, found);
  }
  return largest;
}

}  // namespace

TEST_CASE("both routes agree within their bounds: half-period factors of the propagator vanish at the values",
          "[floquet][characteristic][law][slow][ratchet]") {
  const double largest = largest_disagreement(600, -3.0, 3.0, 300, 1);
  check_within("both routes to an edge: distance over the sum of the bounds", largest, 2.0);
}

TEST_CASE("both routes agree within their bounds at |q| up to 1e8 and orders up to 10000",
          "[floquet][characteristic][law][extreme][N13][ratchet][slow]") {
  // up to 1e4 turns a period: the bound of a phase is that of its rounding, and no sign is taken for certain
  // too early
  const double largest = largest_disagreement(20, 3.0, 8.0, 10'000, 2);
  check_within("N13 both routes to an edge up to |q| = 1e8: distance over the sum of the bounds", largest,
               2.0);
}

TEST_CASE("The frequency from which an inverted rod stands, by both routes",
          "[floquet][characteristic][known][ratchet]") {
  // r0/l = 0.05: epsilon = 3 r0/(2 l) = 0.075; the edge of tongue 0 is delta = -(alpha/omega)^2 = a_0(2
  // epsilon)/4
  const double epsilon = 1.5 * 0.05;
  const double by_edges = std::sqrt(-4.0 / characteristic_values(0, 0, 2.0 * epsilon).at(0).a.value);
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 0.8);
  MonodromyEngine engine;
  const auto stands = [&](double ratio) {
    const auto support = sinusoidal_support(0.05 * 0.8, ratio * rod.alpha());
    const auto equation = linearise(rod, Equilibrium::inverted, &support).equation;
    return discriminant_gap(engine.compute(equation, {.tolerance = 1e-13})).gap > 0.0;
  };
  double low = 10.0, high = 30.0;
  REQUIRE((!stands(low) && stands(high)));
  while (high - low > 1e-15 * low) {
    const double middle = std::midpoint(low, high);
    if (middle == low || middle == high) break;
    (stands(middle) ? high : low) = middle;
  }
  check_close("frequency from which an inverted rod stands against Kapitza's to lowest order (relative)",
              by_edges, 18.85, 0.005);  // Kapitza: omega/alpha = sqrt(2)/epsilon, to lowest order
  check_within("frequency from which an inverted rod stands: difference of both routes (relative)",
               std::abs(high / by_edges - 1.0), 1e-14);
}

}  // namespace strutt::test::both_routes_test
