// Tongues of Meissner's equation, the closed forms behind tongue_edges and tongue_width.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/floquet/stability.hpp"
#include "strutt/floquet/tongue_width.hpp"
#include "support/ratchet.hpp"
#include "support/reference.hpp"

namespace strutt::test::square_wave_test {
namespace {

using std::numbers::pi;
using Real = reference::Real;

PeriodicFunction square(double amplitude, double shift = 0.0) {
  return PeriodicFunction::square(0.0, amplitude, shift);
}

/// Trace of the monodromy matrix in 50 digits, both pieces oscillating or not.
Real discriminant(const Real& mean, const Real& amplitude) {
  const Real length = boost::math::constants::pi<Real>(), w1 = mean + amplitude, w2 = mean - amplitude;
  const auto cosine = [&](const Real& w) {
    return w > 0 ? cos(sqrt(w) * length) : cosh(sqrt(Real(-w)) * length);
  };
  const auto sine = [&](const Real& w) {  // over s
    return w > 0 ? Real(sin(sqrt(w) * length) / sqrt(w))
                 : Real(sinh(sqrt(Real(-w)) * length) / sqrt(Real(-w)));
  };
  return 2 * cosine(w1) * cosine(w2) - (w1 + w2) * sine(w1) * sine(w2);
}

}  // namespace

TEST_CASE("edges of Meissner's tongues are where |D| = 2, within their errors",
          "[floquet][tongues][ratchet]") {
  for (const double amplitude : {1e-3, 0.3, 0.5, 2.0, 7.5, 40.0})
    for (const TongueEdges& edges : tongue_edges(square(amplitude), 0, 12)) {
      const Real side = edges.order % 2 == 0 ? 1 : -1;
      const auto excess = [&](double mean) { return Real(side * discriminant(mean, amplitude) - 2); };
      const auto check = [&](const CharacteristicValue& edge, int sign_above) {
        CAPTURE(amplitude, edges.order, edge.value, edge.error);
        check_within("bound of an edge of Meissner's equation over 1/20 + |edge| + A",
                     edge.error / (0.05 + std::abs(edge.value) + amplitude), 2e-14);
        const TongueWidth width =
            edges.order > 0 ? tongue_width(square(amplitude), edges) : TongueWidth{1.0, 0.0};
        if (width.value < 4.0 * edge.error) return;
        CHECK(sign_above * excess(edge.value + edge.error) > 0);
        CHECK(sign_above * excess(edge.value - edge.error) < 0);
      };
      check(edges.upper, -1);
      if (edges.lower) check(*edges.lower, 1);
    }
}

TEST_CASE("the index of Meissner's tongues is the winding number", "[floquet][tongues]") {
  MonodromyEngine engine;
  for (const double amplitude : {0.3, 4.3, 25.0})
    for (const TongueEdges& edges : tongue_edges(square(amplitude, 0.7), 1, 9)) {
      const double middle = 0.5 * (edges.lower->value + edges.upper.value);
      const auto s =
          analyse(engine, hill_equation(2.0 * pi, square(amplitude, 0.7).plus(middle)), {.tolerance = 1e-13});
      CAPTURE(amplitude, edges.order, middle);
      CHECK(s.verdict == Verdict::unstable);
      CHECK(s.winding == 0.5 * edges.order);
    }
}

TEST_CASE("verdicts of the references with square waves follow from the edges",
          "[floquet][tongues][reference]") {
  int checked = 0;
  for (const auto& row : reference::read("square")) {
    if (row.input("damping") != 0.0) continue;
    const double unit = row.input("period") / (2.0 * pi);
    const double mean = row.input("mean") * unit * unit,
                 amplitude = std::abs(row.input("amplitude")) * unit * unit;
    if (amplitude == 0.0 || abs(row.result("margin")) < 1e-9) continue;
    bool unstable = false;
    for (const TongueEdges& edges :
         tongue_edges(square(amplitude), 0, 2 * static_cast<int>(std::sqrt(std::abs(mean) + amplitude)) + 3))
      unstable = unstable || (mean < edges.upper.value && (!edges.lower || mean > edges.lower->value));
    CAPTURE(row.text("mean"), row.text("amplitude"));
    CHECK(unstable == (row.result("margin") < 0));
    ++checked;
  }
  CHECK(checked >= 10);
}

TEST_CASE("widths of Meissner's tongues keep their relative accuracy",
          "[floquet][tongues][extreme][N06][ratchet]") {
  // first order: the amplitude 4 A/(pi n) of harmonic n for odd n; D(mean) = 2 at second order for even n
  for (const double amplitude : {1e-3, 1e-6, 1e-12, 1e-100, 1e-300})
    for (const int n : {1, 3, 7}) {
      const TongueWidth width =
          tongue_width(square(amplitude), tongue_edges(square(amplitude), n, n).front());
      const double first = 4.0 * amplitude / (pi * n);
      check_within("N06 width of Meissner's odd tongues: difference from first order over A + 2.5e-15",
                   std::abs(width.value / first - 1.0) / (amplitude + 2.5e-15), 0.3);
      check_within("N06 bound of a width of Meissner's odd tongues (relative)", width.relative_error, 8e-14);
    }
  // n = 2 at A = 1e-4 and 1e-2: both zeros of D - 2 by Newton's method in 50 digits
  for (const double amplitude : {1e-4, 1e-2})
    for (const int n : {2, 4}) {
      const TongueEdges edges = tongue_edges(square(amplitude), n, n).front();
      const auto zero = [&](Real x) {
        const Real h("1e-20");
        for (int i = 0; i < 60; ++i) {
          const Real f = discriminant(x, amplitude) - 2;
          const Real slope = (discriminant(x + h, amplitude) - discriminant(x - h, amplitude)) / (2 * h);
          x -= f / slope;
        }
        return x;
      };
      const TongueWidth width = tongue_width(square(amplitude), edges);
      const Real apart = width.value;
      const Real exact = zero(edges.upper.value + apart / 8) - zero(edges.lower->value - apart / 8);
      CAPTURE(amplitude, n, width.value, width.relative_error);
      CHECK(abs(Real(width.value) / exact - 1) <= width.relative_error);
      check_within("N06 bound of a width of Meissner's even tongues (relative)", width.relative_error, 2e-14);
    }
}

TEST_CASE("Meissner's closed tongues are intervals that hold 0",
          "[floquet][tongues][extreme][N08][ratchet]") {
  // sqrt(mean + A) = 3, sqrt(mean - A) = 1: both pieces turn by whole half turns, n = 4
  for (const auto& [mean, amplitude, n] : {std::tuple{5.0, 4.0, 4}, {13.0, 12.0, 6}, {17.0, 8.0, 8}}) {
    const TongueEdges edges = tongue_edges(square(amplitude), n, n).front();
    const TongueWidth width = tongue_width(square(amplitude), edges);
    CAPTURE(mean, amplitude, n, width.value);
    CHECK(std::abs(edges.lower->value - mean) <= edges.lower->error);
    CHECK(std::abs(edges.upper.value - mean) <= edges.upper.error);
    CHECK(width.relative_error == 1.0);
    check_within("N08 bound of the width of a closed tongue of Meissner's equation", width.value, 1.5e-14);
  }
}

TEST_CASE("growth in narrow tongues of Meissner's equation", "[floquet][tongues][ratchet]") {
  MonodromyEngine engine;
  for (const int n : {1, 2, 5}) {
    const double amplitude = 1e-3;
    const TongueEdges edges = tongue_edges(square(amplitude), n, n).front();
    const double growth =
        narrow_tongue_growth(square(amplitude), edges, tongue_width(square(amplitude), edges));
    const double middle = 0.5 * (edges.lower->value + edges.upper.value);
    const auto s =
        analyse(engine, hill_equation(2.0 * pi, square(amplitude).plus(middle)), {.tolerance = 1e-13});
    check_close(
        "growth in a narrow tongue of Meissner's equation: closed form against multipliers (relative)",
        growth, s.growth, 6e-6);
  }
}

}  // namespace strutt::test::square_wave_test
