#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::verdict_test {

using strutt::test::check_close;
using strutt::test::check_within;

namespace {

Stability at(double delta, double epsilon, double damping = 0.0, double tolerance = 1e-10) {
  MonodromyEngine engine;
  return analyse(engine, mathieu_delta_epsilon(delta, epsilon, damping), {.tolerance = tolerance});
}

}  // namespace

TEST_CASE("A margin decides exactly when its error is smaller", "[floquet][verdict]") {
  CHECK(verdict_of({0.1, 0.05}) == Verdict::stable);
  CHECK(verdict_of({-0.1, 0.05}) == Verdict::unstable);
  CHECK(verdict_of({0.1, 0.1}) == Verdict::unresolved);
  CHECK(verdict_of({0.0, 1e-300}) == Verdict::unresolved);
  CHECK(verdict_of({0.0, 0.0}) == Verdict::boundary);
  CHECK(verdict_of({std::nan(""), 0.0}) == Verdict::unresolved);
  CHECK(verdict_of({-1.0, std::nan("")}) == Verdict::unresolved);
}

TEST_CASE("Equality is called boundary only where it is proved", "[floquet][verdict][N05][extreme]") {
  for (const double delta : {0.0, 0.25, 1.0, 2.25, 6.25, 2500.0}) {
    const auto result = at(delta, 0.0);
    CHECK(result.verdict == Verdict::boundary);
    CHECK(result.margin == 0.0);
    CHECK(result.margin_error == 0.0);
    CHECK(result.growth == 0.0);
    CHECK(result.winding == std::sqrt(delta));
  }
  // the neighbouring doubles are not on the edge: touching it from inside, all of them are stable
  CHECK(at(std::nextafter(1.0, 2.0), 0.0).verdict == Verdict::stable);
  CHECK(at(std::nextafter(0.25, 0.0), 0.0).verdict == Verdict::stable);
  CHECK(at(-1e-280, 0.0).verdict == Verdict::unstable);
  CHECK(at(1e-280, 0.0).verdict == Verdict::stable);
  CHECK(at(std::nextafter(0.0, -1.0), 0.0).verdict == Verdict::unresolved);  // underflow proves nothing
  const auto tiny = [&](double mean) {
    MonodromyEngine engine;
    return analyse(engine, hill_equation(1e-10, PeriodicFunction::constant(mean))).verdict;
  };
  CHECK(tiny(1e-310) == Verdict::unresolved);  // 0 in canonical time
  CHECK(tiny(-1e-310) == Verdict::unresolved);
  CHECK(tiny(0.0) == Verdict::boundary);
  // rounded inputs prove nothing: alpha^2/omega^2 = 1/4 up to rounding
  MonodromyEngine engine;
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 0.7);
  const auto support = sinusoidal_support(0.0, 2.0 * rod.alpha());
  CHECK(analyse(engine, linearise(rod, Equilibrium::hanging, &support).equation).verdict ==
        Verdict::unresolved);
  const auto fast = sinusoidal_support(0.0, 1e300);
  CHECK(analyse(engine, linearise(rod, Equilibrium::hanging, &fast).equation).verdict == Verdict::unresolved);
  // without a support the period is the free one, exactly
  CHECK(analyse(engine, linearise(rod, Equilibrium::hanging, nullptr).equation).verdict == Verdict::boundary);
}

TEST_CASE("Damping alone keeps constants: a boundary, proved", "[floquet][verdict]") {
  for (const double c : {1e-12, 0.1, 3.0, 400.0}) {
    const auto result = at(0.0, 0.0, c);
    CHECK(result.verdict == Verdict::boundary);
    CHECK(result.growth == 0.0);
    CHECK(at(1e-6, 0.0, c).verdict != Verdict::boundary);
    CHECK(at(0.0, 1e-9, c).verdict != Verdict::boundary);
  }
  CHECK_FALSE(std::signbit(at(0.0, 0.0).margin));  // files say 0, not -0
}

TEST_CASE("Coexistence of the square wave is proved when both pieces are whole turns",
          "[floquet][verdict][N08][extreme][ratchet]") {
  MonodromyEngine engine;  // w = 4 +- ... : sqrt(w) pi = whole turns over each half period
  const auto equation = hill_equation(2.0 * std::numbers::pi, PeriodicFunction::square(10.0, 6.0, 0.0));
  auto exact = equation;
  exact.coefficient_error = 0.0;
  exact.coefficient = PeriodicFunction::square(10.0, 6.0, 0.0);  // 16 and 4
  const auto result = analyse(engine, exact);
  CHECK(std::abs(result.margin) <= result.margin_error);
  check_within("N08 margin of the square wave whose pieces are whole turns", std::abs(result.margin), 1e-28);
}

TEST_CASE("Tiny and huge damping", "[floquet][verdict][extreme][N22][ratchet]") {
  // inside tongue 1 at its centre: growth of the undamped equation is about epsilon/2 * pi per period
  check_close("N22 growth at the centre of tongue 1 against first order (relative)", at(0.25, 0.01).growth,
              0.01 * std::numbers::pi, 0.00015);
  for (const double c : {1e-12, 1e-9, 1e-4}) {
    const auto result = at(0.25, 0.01, c, 1e-12);
    CHECK(result.verdict == Verdict::unstable);
    const double undamped = at(0.25 - c * c / 4.0, 0.01, 0.0, 1e-12).growth;  // of exp(ct/2) x
    const double expected = undamped - c * std::numbers::pi;
    check_within("N22 growth with damping down to 1e-12 (relative)", std::abs(result.growth / expected - 1.0),
                 1e-15);
  }
  // on the stable side the margin is 1 - |D|/(2 cosh h): it sees c = 1e-9 only through h^2/2
  const auto slightly = at(1.0, 0.0, 1e-9);
  CHECK(slightly.verdict == Verdict::stable);
  check_close("N22 growth with damping 1e-9 on an edge (relative)", slightly.growth, -1e-9 * std::numbers::pi,
              8e-16);
  const double h = 1e-9 * std::numbers::pi;
  // w = 1 - c^2/4 moves D away from 2 as well: D = 2 cos(2 pi sqrt(1 - c^2/4)), of higher order
  check_close("N22 margin with damping 1e-9 on an edge (relative)", slightly.margin, h * h / 2.0, 8e-16);
  const auto heavy = at(1.0, 0.5, 400.0, 1e-6);
  CHECK(heavy.verdict == Verdict::stable);
  CHECK(heavy.growth < 0.0);
  CHECK(heavy.growth > -0.1);
}

TEST_CASE("Growth has the sign of -margin and the closed form of constant coefficients",
          "[floquet][growth][extreme][N01][ratchet]") {
  for (const double delta : {-0.01, -1.0, -100.0, -12000.0, -1e6}) {
    const auto result = at(delta, 0.0);
    const double growth = 2.0 * std::numbers::pi * std::sqrt(-delta);
    check_within("N01 growth of constant coefficients up to exp(6283) (relative)",
                 std::abs(result.growth / growth - 1.0), 1e-15);
    CHECK(result.verdict == Verdict::unstable);
  }
  // damped edge of a constant coefficient: delta = 0 is the edge for every damping
  for (const double delta : {1e-3, 1e-9, -1e-9, -1e-3}) {
    const auto result = at(delta, 0.0, 0.7);
    CHECK(result.growth * result.margin < 0.0);
    const double exponent =
        delta > 0.0 ? -delta / (0.35 + std::sqrt(0.1225 - delta)) : -0.35 + std::sqrt(0.1225 - delta);
    check_close("growth next to a damped edge (relative)", result.growth, 2.0 * std::numbers::pi * exponent,
                6e-8);
  }
}

TEST_CASE("The margin is cut off, the growth is not", "[floquet][extreme][N01]") {
  const auto result = at(-2e5, 0.5, 0.0, 1e-6);
  CHECK(result.margin == kLowestMargin);
  CHECK(result.margin_error == 0.0);
  CHECK(result.verdict == Verdict::unstable);
  CHECK(result.growth > 2000.0);
  CHECK(std::isfinite(result.growth));
}

TEST_CASE("around the sixth to the eighth tongue every decided point is right, where |trace| > 2 guesses",
          "[floquet][verdict][extreme][N04]") {
  MonodromyEngine engine;
  const double q = 1.0;
  int guessed_wrong = 0, decided = 0;
  for (const int order : {6, 7, 8}) {  // 1.3e-7, 9.4e-10 and 4.8e-12 wide
    const auto pair = characteristic_values(order, order, q).at(0);
    const double low = pair.b->value, high = pair.a.value;
    for (int k = 0; k < 300; ++k) {
      const double a = std::lerp(low, high, -1.0 + 3.0 * (k + 0.5) / 300.0);
      if (std::abs(a - low) <= pair.b->error || std::abs(a - high) <= pair.a.error) continue;
      const Verdict truth = a > low && a < high ? Verdict::unstable : Verdict::stable;
      const auto result = analyse(engine, mathieu_a_q(a, q), {.tolerance = 1e-12});
      CAPTURE(order, k, result.margin, result.margin_error);
      CHECK((result.verdict == truth || result.verdict == Verdict::unresolved));
      decided += result.verdict == truth;
      guessed_wrong += (std::abs(result.discriminant) > 2.0) != (truth == Verdict::unstable);
    }
  }
  CHECK(decided >= 800);
  CHECK(guessed_wrong >= 100);
}

TEST_CASE("Far above its frequency an inverted pendulum has the margin of its mean equation",
          "[floquet][verdict][extreme][N12][ratchet]") {
  // delta = -(alpha/omega)^2 and epsilon = s sqrt(2) alpha/omega: winding^2 = delta + epsilon^2/2 +
  // O(epsilon^4), so that margin = 1 - cos(2 pi winding) = 2 pi^2 (s^2 - 1) (alpha/omega)^2, down to 1e-16
  MonodromyEngine engine;
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 0.7);
  double largest = 0.0;
  for (const double s : {0.5, 0.99, 1.01, 3.0}) {
    for (const double ratio : {1e3, 1e5, 1e7, 1e8}) {
      const double amplitude = s * std::sqrt(2.0) / ratio / 1.5 * 0.7;  // epsilon = 3 r0/(2 l)
      const auto support = sinusoidal_support(amplitude, ratio * rod.alpha());
      const auto result =
          analyse(engine, linearise(rod, Equilibrium::inverted, &support).equation, {.tolerance = 1e-13});
      const double term = 2.0 * std::numbers::pi * std::numbers::pi / (ratio * ratio);
      const double expected = (s * s - 1.0) * term,
                   next = 10.0 * (1.0 + std::pow(s, 4)) * term / (ratio * ratio);
      CAPTURE(s, ratio, expected, result.margin, result.margin_error);
      if (result.verdict != Verdict::unresolved)
        CHECK(result.verdict == (s > 1.0 ? Verdict::stable : Verdict::unstable));
      CHECK((result.verdict != Verdict::unresolved || std::abs(expected) < 1e-13));
      CHECK(std::abs(result.margin - expected) <= result.margin_error + next);
      largest = std::max(largest, (std::abs(result.margin - expected) - next) / ((s * s + 1.0) * term));
    }
  }
  check_within("N12 error of the margin relative to its terms up to 1e8 times the eigenfrequency", largest,
               4e-8);
}

TEST_CASE("A phase of 1e6 turns is as exact as one of one turn",
          "[floquet][verdict][extreme][N20][ratchet]") {
  // over a period that is 2 pi rounded the phase of 1e6 turns would be off by 2e-10
  for (const double turns : {1.0, 100.0, 1e4, 1e6}) {
    const auto result = at(turns * turns, 0.0);
    CHECK(result.verdict == Verdict::boundary);
    CHECK(result.margin == 0.0);
    if (turns < 1e6) CHECK(result.winding == turns);  // more are not counted
    MonodromyEngine engine;
    CHECK(analyse(engine, mathieu_a_q(4.0 * turns * turns, 0.0)).verdict == Verdict::boundary);
  }
  // next to it the margin is that of the distance: 1 - cos(2 pi h/(n + sqrt(n^2 + h))) with delta = n^2 + h
  for (const double n : {3.0, 1e3, 1e4, 1e5}) {
    for (const double h : {0x1p-12, 0x1p-10, 0x1p-4}) {
      const double distance = std::numbers::pi * h / (std::sqrt(n * n + h) + n);
      const double expected = 2.0 * std::pow(std::sin(distance), 2);
      check_within("N20 margin next to an edge after up to 1e5 turns (relative)",
                   std::abs(at(n * n + h, 0.0).margin / expected - 1.0), 2e-15);
    }
  }
}

}  // namespace strutt::test::verdict_test
