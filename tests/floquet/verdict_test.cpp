#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/floquet/stability.hpp"

using namespace strutt;

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

TEST_CASE("Equality is called boundary only where it is proved", "[floquet][verdict][N5]") {
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
  CHECK(analyse(engine, linearise(rod, Equilibrium::hanging, &support).equation).verdict == Verdict::unresolved);
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

TEST_CASE("Coexistence of the square wave is proved when both pieces are whole turns", "[floquet][verdict][N8]") {
  MonodromyEngine engine;  // w = 4 +- ... : sqrt(w) pi = whole turns over each half period
  const auto equation = hill_equation(2.0 * std::numbers::pi, PeriodicFunction::square(10.0, 6.0, 0.0));
  auto exact = equation;
  exact.coefficient_error = 0.0;
  exact.coefficient = PeriodicFunction::square(10.0, 6.0, 0.0);  // 16 and 4
  const auto result = analyse(engine, exact);
  CHECK(std::abs(result.margin) <= result.margin_error);
  CHECK(std::abs(result.margin) < 1e-28);
}

TEST_CASE("Tiny and huge damping", "[floquet][verdict][extreme][N22]") {
  // inside tongue 1 at its centre: growth of the undamped equation is about epsilon/2 * pi per period
  CHECK(at(0.25, 0.01).growth == Approx(0.01 * std::numbers::pi).epsilon(1e-3));
  for (const double c : {1e-12, 1e-9, 1e-4}) {
    const auto result = at(0.25, 0.01, c, 1e-12);
    CHECK(result.verdict == Verdict::unstable);
    const double undamped = at(0.25 - c * c / 4.0, 0.01, 0.0, 1e-12).growth;  // of exp(ct/2) x
    CHECK(result.growth == Approx(undamped - c * std::numbers::pi).epsilon(1e-9));
  }
  // on the stable side the margin is 1 - |D|/(2 cosh h): it sees c = 1e-9 only through h^2/2
  const auto slightly = at(1.0, 0.0, 1e-9);
  CHECK(slightly.verdict == Verdict::stable);
  CHECK(slightly.growth == Approx(-1e-9 * std::numbers::pi).epsilon(1e-12));
  const double h = 1e-9 * std::numbers::pi;
  // w = 1 - c^2/4 moves D away from 2 as well: D = 2 cos(2 pi sqrt(1 - c^2/4)), of higher order
  CHECK(slightly.margin == Approx(h * h / 2.0).epsilon(1e-9));
  const auto heavy = at(1.0, 0.5, 400.0, 1e-6);
  CHECK(heavy.verdict == Verdict::stable);
  CHECK(heavy.growth < 0.0);
  CHECK(heavy.growth > -0.1);
}

TEST_CASE("Growth has the sign of -margin and the closed form of constant coefficients", "[floquet][growth]") {
  for (const double delta : {-0.01, -1.0, -100.0, -12000.0, -1e6}) {
    const auto result = at(delta, 0.0);
    CHECK(result.growth == Approx(2.0 * std::numbers::pi * std::sqrt(-delta)).epsilon(1e-13));
    CHECK(result.verdict == Verdict::unstable);
  }
  // damped edge of a constant coefficient: delta = 0 is the edge for every damping
  for (const double delta : {1e-3, 1e-9, -1e-9, -1e-3}) {
    const auto result = at(delta, 0.0, 0.7);
    CHECK(result.growth * result.margin < 0.0);
    const double exponent = delta > 0.0 ? -delta / (0.35 + std::sqrt(0.1225 - delta)) : -0.35 + std::sqrt(0.1225 - delta);
    CHECK(result.growth == Approx(2.0 * std::numbers::pi * exponent).epsilon(1e-6));
  }
}

TEST_CASE("The margin is cut off, the growth is not", "[floquet][extreme][N1]") {
  const auto result = at(-2e5, 0.5, 0.0, 1e-6);
  CHECK(result.margin == kLowestMargin);
  CHECK(result.margin_error == 0.0);
  CHECK(result.verdict == Verdict::unstable);
  CHECK(result.growth > 2000.0);
  CHECK(std::isfinite(result.growth));
}
