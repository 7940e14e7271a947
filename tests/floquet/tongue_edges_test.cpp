#include "strutt/floquet/tongue_edges.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::tongue_edges_test {

using strutt::test::check_within;

namespace {

constexpr double kPi = std::numbers::pi;

PeriodicFunction cosines(std::vector<double> amplitudes) {
  std::vector<Harmonic> harmonics;
  for (std::size_t k = 0; k < amplitudes.size(); ++k)
    harmonics.push_back({static_cast<int>(k) + 1, amplitudes[k], 0.0});
  return PeriodicFunction::fourier(0.0, harmonics);
}

/// X = exp(g), g = alpha cos theta + beta sin 2 theta, has no zeros and the period 2 pi: it belongs to the
/// upper edge of tongue 0 of W = -(g'' + g'^2), whose mean is this.
struct KnownGround {
  double alpha, beta;
  double edge() const { return -(0.5 * alpha * alpha + 2.0 * beta * beta); }
  PeriodicFunction coefficient() const {
    return PeriodicFunction::fourier(5.0, {{1, alpha, -2.0 * alpha * beta},
                                           {2, 0.5 * alpha * alpha, 4.0 * beta},
                                           {3, 0.0, 2.0 * alpha * beta},
                                           {4, -2.0 * beta * beta, 0.0}});
  }
};

/// 2 - |D| of X'' + (mean + V) X = 0, whose sign changes at the edge of an open tongue.
DiscriminantGap gap_at(MonodromyEngine& engine, const PeriodicFunction& v, double mean) {
  const HillEquation equation{.coefficient = v.plus(mean - v.mean())};
  return discriminant_gap(engine.compute(equation, {.tolerance = 1e-12}));
}

/// As in characteristic_values_test: how far from the edge both routes are sure of the sign, over the sum of
/// their bounds; 4 is the most that honest bounds give.
double disagreement(const PeriodicFunction& v, const CharacteristicValue& edge) {
  MonodromyEngine engine;
  for (double h = edge.error;; h *= 2.0) {
    const auto low = gap_at(engine, v, edge.value - h), high = gap_at(engine, v, edge.value + h);
    const double slope = std::abs(high.gap - low.gap) / (2.0 * h);
    const double allowed = edge.error + std::max(low.gap_error, high.gap_error) / slope;
    if (std::abs(low.gap) > low.gap_error && std::abs(high.gap) > high.gap_error)
      return (low.gap > 0.0) != (high.gap > 0.0) ? h / allowed : HUGE_VAL;
    if (h > 1e-3) return HUGE_VAL;
  }
}

}  // namespace

TEST_CASE("One harmonic: the edges are a_n(2 epsilon)/4 and b_n(2 epsilon)/4",
          "[floquet][tongue_edges][ratchet]") {
  for (const double epsilon : {0.0, 1e-6, 0.01, -0.5, 5.0, 200.0, 5000.0}) {
    const auto edges = tongue_edges(cosines({epsilon}), 0, 24);
    const auto values = characteristic_values(0, 24, 2.0 * std::abs(epsilon));
    for (std::size_t n = 0; n < edges.size(); ++n) {
      CAPTURE(epsilon, n);
      const auto& [order, a, b] = values[n];
      CHECK(std::abs(edges[n].upper.value - a.value / 4.0) <= edges[n].upper.error + a.error / 4.0);
      // measured: 1.3e-14 up to 5, 6e-14 at 200, 4.8e-13 at 5000
      const double share = std::abs(epsilon) <= 5.0 ? 2.5e-14 : std::abs(epsilon) <= 200.0 ? 1.2e-13 : 1e-12;
      const double size = 1.0 + std::abs(epsilon) + 0.25 * order * order;
      CHECK(edges[n].upper.error <= share * size);
      if (std::abs(epsilon) <= 5.0)
        check_within("bound of an edge over 1 + sum |V| + n^2/4 for sums up to 5",
                     edges[n].upper.error / size, 2.5e-14);
      CHECK(edges[n].lower.has_value() == (n > 0));
      if (b)
        CHECK(std::abs(edges[n].lower->value - b->value / 4.0) <= edges[n].lower->error + b->error / 4.0);
    }
  }
}

TEST_CASE("The edges do not depend on where the period begins, nor on the mean",
          "[floquet][tongue_edges][law]") {
  const auto v = cosines({0.7, -0.4, 0.0, 0.2});
  const auto edges = tongue_edges(v, 0, 10);
  for (const double shift : {0.3, 2.0, -1.1}) {
    const auto shifted = tongue_edges(v.shifted(shift).plus(17.0), 0, 10);
    for (std::size_t n = 0; n < edges.size(); ++n) {
      CAPTURE(shift, n);
      CHECK(std::abs(edges[n].upper.value - shifted[n].upper.value) <=
            edges[n].upper.error + shifted[n].upper.error);
      if (n > 0)
        CHECK(std::abs(edges[n].lower->value - shifted[n].lower->value) <=
              edges[n].lower->error + shifted[n].lower->error);
    }
  }
}

TEST_CASE("Without symmetry: an edge that is known exactly", "[floquet][tongue_edges][ratchet]") {
  for (const auto& [alpha, beta] : {std::pair{0.7, 0.4}, {1e-3, 0.5}, {3.0, -1.0}, {0.2, 4.0}}) {
    const KnownGround ground{alpha, beta};
    CAPTURE(alpha, beta);
    REQUIRE_FALSE(ground.coefficient().even_centre());
    const auto upper = tongue_edges(ground.coefficient(), 0, 0).at(0).upper;
    const double error = std::abs(upper.value - ground.edge()),
                 size = 1.0 + alpha * alpha + 8.0 * beta * beta;
    CHECK(error <= upper.error);
    check_within("error of an edge without symmetry over 1 + sum |V|", error / size, 1e-15);
    check_within("bound of an edge without symmetry over 1 + sum |V|", upper.error / size, 5e-14);
  }
}

TEST_CASE("Closed tongues of the Whittaker-Hill equation: the width is 0 within the errors",
          "[floquet][tongue_edges][extreme][N08]") {
  // V = t c cos theta + (c^2/2) cos 2 theta, t a whole number: the tongues n > t with n - t odd are closed,
  // all others are open (Magnus, Winkler, Hill's Equation, section 7.4)
  for (const double c : {0.3, 0.9, 2.0}) {
    CHECK(std::abs(tongue_edges(cosines({c, 0.5 * c * c}), 0, 0).at(0).upper.value + 0.5 * c * c) <=
          1e-14 * (1.0 + c * c));
    for (int t = 1; t <= 4; ++t) {
      for (const auto& [n, lower, upper] : tongue_edges(cosines({t * c, 0.5 * c * c}), 1, 8)) {
        CAPTURE(c, t, n);
        const double width = upper.value - lower->value, error = upper.error + lower->error;
        if (n > t && (n - t) % 2 != 0)
          CHECK(std::abs(width) <= error);
        else if (n <= t + 2)
          CHECK(width > error);
      }
    }
  }
}

TEST_CASE("Both routes agree within their bounds at the edges of Hill's equation",
          "[floquet][tongue_edges][law]") {
  const auto even = cosines({1.1, 0.7, -0.5}), strong = cosines({12.0, 0.0, 5.0});
  const auto skew = KnownGround{0.9, 0.35}.coefficient();
  for (const auto* v : {&even, &strong, &skew}) {
    for (const auto& [n, lower, upper] : tongue_edges(*v, 0, 6)) {
      CAPTURE(v == &even, v == &skew, n);
      if (lower && upper.value - lower->value < 1e-3) continue;  // the sign between the edges needs room
      CHECK(disagreement(*v, upper) <= 4.0);
      if (lower) CHECK(disagreement(*v, *lower) <= 4.0);
    }
  }
}

TEST_CASE("A curve of constant exponent: the discriminant there is 2 cos(2 pi winding)",
          "[floquet][tongue_edges][law][ratchet]") {
  MonodromyEngine engine;
  const auto skew = KnownGround{0.9, 0.35}.coefficient();
  for (const auto& v : {cosines({0.8}), cosines({3.0, -1.0}), skew}) {
    for (const double winding : {0.01, 0.1, 0.37, 0.63, 1.25, 2.8, 4.499}) {
      CAPTURE(winding);
      const auto found = mean_of_winding(v, winding);
      const auto at = [&](double mean) {
        return analyse(engine, HillEquation{.coefficient = v.plus(mean - v.mean())}, {.tolerance = 1e-12});
      };
      const auto result = at(found.value);
      const double slope = (at(found.value + 1e-6).discriminant - at(found.value - 1e-6).discriminant) / 2e-6;
      const double allowed = result.error * std::max(1.0, result.matrix.cwiseAbs().maxCoeff()) +
                             1.01 * std::abs(slope) * found.error + 1e-15;
      CHECK(std::abs(result.discriminant - 2.0 * std::cos(2.0 * kPi * winding)) <= allowed);
      check_within("winding on a curve of constant exponent", std::abs(result.winding - winding), 2e-11);
    }
  }
}

TEST_CASE("Curves of constant exponent lie between the tongues, in order",
          "[floquet][tongue_edges][law][ratchet]") {
  const auto v = cosines({2.0, 0.6});
  const auto edges = tongue_edges(v, 0, 6);
  for (std::size_t n = 0; n + 1 < edges.size(); ++n) {
    double before = edges[n].upper.value;
    for (const double part : {0.01, 0.3, 0.5, 0.9, 0.99}) {
      const double mean = mean_of_winding(v, 0.5 * (static_cast<double>(n) + part)).value;
      CHECK(mean > before);
      before = mean;
    }
    CHECK(before < edges[n + 1].lower->value);
  }
  check_close("mean of a winding number without excitation (relative)",
              mean_of_winding(cosines({}), 1.3).value, 1.69, 8e-16);
}

TEST_CASE("High tongues and many harmonics", "[floquet][tongue_edges][extreme][ratchet]") {
  std::vector<double> amplitudes(40);
  for (std::size_t k = 0; k < amplitudes.size(); ++k)
    amplitudes[k] = std::cos(3.0 * static_cast<double>(k)) / (1.0 + static_cast<double>(k));
  const auto v = cosines(amplitudes);
  for (const int order : {1, 30, 200, 1000}) {
    const auto edges = tongue_edges(v, order, order).at(0);
    CAPTURE(order);
    CHECK(std::abs(edges.upper.value - 0.25 * order * order) <= v.deviation());
    CHECK(edges.lower->value <= edges.upper.value + edges.upper.error + edges.lower->error);
    check_within("bound of an edge of up to tongue 1000 with 40 harmonics over 10 + n^2",
                 edges.upper.error / (10.0 + order * order), 6e-14);
    // to first order tongue n is |V_n| wide, the amplitude of harmonic n
    if (order == 30)
      check_close("width of tongue 30 with 40 harmonics against first order (relative)",
                  edges.upper.value - edges.lower->value, std::abs(amplitudes[29]), 0.1);
  }
}

TEST_CASE("Coefficients and orders that do not fit are refused by name", "[floquet][tongue_edges]") {
  using Catch::Matchers::Contains;
  const auto v = cosines({1.0});
  CHECK_THROWS_WITH(tongue_edges(v, -1, 2), Contains("first") && Contains("1000"));
  CHECK_THROWS_WITH(tongue_edges(v, 2, 1), Contains("last"));
  CHECK_THROWS_WITH(tongue_edges(v, 0, 1001), Contains("last") && Contains("1000"));
  CHECK_THROWS_WITH(tongue_edges(cosines({2e6}), 0, 1), Contains("1e6"));
  CHECK_THROWS_WITH(tongue_edges(PeriodicFunction::square(1.0, 2e6, 0.0), 0, 1), Contains("square"));
  for (int antiderivative = 1; antiderivative <= 2; ++antiderivative)
    CHECK_THROWS_WITH(tongue_edges(PeriodicFunction::square(1.0, 0.5, 0.0, antiderivative), 0, 1),
                      Contains("square"));
  for (const double winding : {0.0, -0.2, 0.5, 3.0, 500.2, std::nan("")})
    CHECK_THROWS_WITH(mean_of_winding(v, winding), Contains("winding"));
  CHECK(tongue_edges(PeriodicFunction::constant(3.0), 2, 2).at(0).upper.value == 1.0);
}

}  // namespace strutt::test::tongue_edges_test
