#include "strutt/floquet/tongue_width.hpp"

#include <boost/math/tools/minima.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "strutt/base/error.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"
#include "support/reference.hpp"

namespace strutt::test::tongue_width_test {
namespace {

using reference::Real;

PeriodicFunction cosine(double epsilon) { return PeriodicFunction::fourier(0.0, {{1, epsilon, 0.0}}); }

TongueWidth width_of(const PeriodicFunction& v, int order) {
  return tongue_width(v, tongue_edges(v, order, order).front());
}

double relative_error(const TongueWidth& width, const Real& truth) {
  return static_cast<double>(abs(Real(width.value) / truth - 1));
}

}  // namespace

TEST_CASE("widths of Mathieu's tongues have relative accuracy",
          "[floquet][tongues][reference][extreme][N06][ratchet]") {
  int rows = 0, small = 0;
  for (const auto& row : reference::read("width")) {
    const int order = static_cast<int>(row.input("n"));
    const auto v = cosine(row.input("epsilon"));
    const TongueWidth width = width_of(v, order);
    INFO("n = " << order << ", epsilon = " << row.text("epsilon"));
    const double error = relative_error(width, row.result("width"));
    CHECK(error <= width.relative_error);
    check_within("N06 bound of a width (relative)", width.relative_error, kWidthAccuracy);
    check_within("N06 error of a width (relative)", error, 1.5e-13);
    if (row.text("epsilon") == "0.01") {
      check_within("N06 error of a width at epsilon = 0.01 for n = 1 to 12 (relative)", error, 1e-14);
      ++small;
    }
    ++rows;
  }
  CHECK(rows == 48);
  CHECK(small == 12);
}

TEST_CASE("coefficients that are known to a rounding leave a width of any size sharp",
          "[floquet][tongues][reference][extreme][N06][ratchet]") {
  for (const auto& row : reference::read("width")) {
    const int order = static_cast<int>(row.input("n"));
    const double epsilon = row.input("epsilon");
    for (const Harmonic& harmonic : {Harmonic{1, epsilon, 0.0}, Harmonic{1, 0.0, epsilon}}) {
      const auto v = PeriodicFunction::fourier(0.0, {harmonic});
      const TongueWidth width = tongue_width(v, tongue_edges(v, order, order).front(), 0x1p-52);
      INFO("n = " << order << ", epsilon = " << row.text("epsilon") << ", sine " << harmonic.sine);
      CHECK(relative_error(width, row.result("width")) <= width.relative_error);
      check_within("N06 bound of a width of coefficients known to a rounding (relative)",
                   width.relative_error, 1.5e-9);
    }
  }
}

TEST_CASE("a width of 1e-295 is as good as any", "[floquet][tongues][extreme][N06][ratchet]") {
  // 2 (epsilon/2)^n / ((n - 1)!)^2 but for a factor 1 + O(epsilon^2), DLMF 28.6.15
  const double epsilon = 1e-12;
  Real expected = 2;
  for (int k = 1; k <= 21; ++k) expected *= Real(epsilon) / 2;
  for (int k = 1; k <= 20; ++k) expected /= Real(k) * k;
  const TongueWidth width = width_of(cosine(epsilon), 21);
  CHECK(width.value < 1e-294);
  CHECK(width.value > 1e-296);
  check_within("N06 bound of a width of 1e-295 (relative)", width.relative_error, 2.5e-13);
  CHECK(relative_error(width, expected) <= width.relative_error);
}

TEST_CASE("a width does not depend on the phase", "[floquet][tongues][ratchet]") {
  const TongueWidth width = width_of(cosine(0.01), 7);
  for (const double phase : {0.5, 2.0}) {
    const auto shifted =
        PeriodicFunction::fourier(0.0, {{1, 0.01 * std::cos(phase), 0.01 * std::sin(phase)}});
    const TongueWidth same = width_of(shifted, 7);
    check_within("bound of a width seen from another phase (relative)", same.relative_error, 1e-13);
    check_close("width of a tongue seen from another phase (relative)", same.value, width.value, 8e-16);
  }
}

TEST_CASE("a coefficient without symmetry has the width of perturbation theory",
          "[floquet][tongues][ratchet]") {
  // a cos t + b sin 2t: two ways from the mode -3/2 to 3/2, over -1/2 or 1/2, whose distance is 2: width a
  // b/2
  const double a = 1e-12, b = 3e-12;
  const TongueWidth narrow = width_of(PeriodicFunction::fourier(0.0, {{1, a, 0.0}, {2, 0.0, b}}), 3);
  check_within("bound of a width without symmetry (relative)", narrow.relative_error, 2.5e-14);
  check_close("width without symmetry against perturbation theory (relative)", narrow.value, 0.5 * a * b,
              8e-16);
}

TEST_CASE("where the edges are apart the width is their difference", "[floquet][tongues][ratchet]") {
  const auto v = PeriodicFunction::fourier(0.0, {{1, 0.8, 0.1}, {2, 0.0, 0.5}, {3, -0.2, 0.3}});
  for (const TongueEdges& edges : tongue_edges(v, 1, 6)) {
    const TongueWidth width = tongue_width(v, edges);
    const double difference = edges.upper.value - edges.lower->value;
    check_within("bound of a width of three harmonics (relative)", width.relative_error, 3e-12);
    CHECK(std::abs(width.value - difference) <= edges.upper.error + edges.lower->error + 1e-15);
  }
}

TEST_CASE("a closed tongue has an interval around 0", "[floquet][tongues][extreme][N08][ratchet]") {
  // Whittaker-Hill: cos t + cos(2t)/2 has no even tongues [Magnus & Winkler, chapter 7]
  const auto closed = PeriodicFunction::fourier(0.0, {{1, 1.0, 0.0}, {2, 0.5, 0.0}});
  for (const int order : {2, 4, 6}) {
    const TongueWidth width = width_of(closed, order);
    CHECK(width.relative_error == 1.0);
    check_within("N08 bound of the width of a closed tongue of Whittaker and Hill", width.value, 1e-100);
  }
  for (const int order : {1, 3, 5})
    check_within("N08 bound of an open width of Whittaker and Hill (relative)",
                 width_of(closed, order).relative_error, 1e-12);
  // a change of the last bit opens it, and the width says so
  const auto open = PeriodicFunction::fourier(0.0, {{1, 1.0, 0.0}, {2, std::nextafter(0.5, 1.0), 0.0}});
  const TongueWidth width = width_of(open, 2);
  check_within("N08 bound of a width that a rounding opens (relative)", width.relative_error, 5e-15);
  CHECK(width.value > 1e-17);
  CHECK(width.value < 1e-15);
}

TEST_CASE("tongues that no harmonic reaches are closed, proved",
          "[floquet][tongues][extreme][N08][ratchet]") {
  const auto second = PeriodicFunction::fourier(0.0, {{2, 0.3, 0.0}});
  for (const int order : {1, 3, 5}) {
    const TongueWidth width = width_of(second, order);
    CHECK(width.value == 0.0);
    CHECK(width.relative_error == 0.0);
  }
  check_close("N08 width of tongue 2 of the second harmonic against first order (relative)",
              width_of(second, 2).value, 0.3, 0.0012);
  CHECK(width_of(PeriodicFunction::constant(0.0), 3).value == 0.0);
}

TEST_CASE("the growth by a narrow width is right to the square of its share of the way to the next tongue",
          "[floquet][tongues][ratchet]") {
  MonodromyEngine engine;
  std::mt19937 random(11);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int rows = 0;
  while (rows < 40) {
    std::vector<Harmonic> harmonics;
    const double size = std::exp(uniform(std::log(0.02), std::log(10.0)));
    for (int k = 1; k <= 1 + rows % 3; ++k)
      harmonics.push_back({k, size * uniform(-1.0, 1.0) / k, size * uniform(-1.0, 1.0) / k});
    const auto v = PeriodicFunction::fourier(0.0, harmonics);
    const int order = 1 + rows % 8;
    const auto edges = tongue_edges(v, order - 1, order + 1);
    const TongueWidth width = tongue_width(v, edges[1]);
    const double distance =
        std::min(edges[1].lower->value - edges[0].upper.value, edges[2].lower->value - edges[1].upper.value);
    const double share = width.value / distance;
    if (share < 2e-3 || share > 0.1) continue;
    const auto growth = [&](double mean) {
      const auto equation = hill_equation(2.0 * std::numbers::pi, v.plus(mean));
      return analyse(engine, equation, {.tolerance = 1e-13}).growth;
    };
    const auto [place, negative] = boost::math::tools::brent_find_minima(
        [&](double mean) { return -growth(mean); }, edges[1].lower->value, edges[1].upper.value, 30);
    const double by_width = narrow_tongue_growth(v, edges[1], width);
    check_within("growth by a narrow width against multipliers (in squares of width over distance)",
                 std::abs(-by_width / negative - 1.0) / (share * share), 16.0);
    ++rows;
  }
}

TEST_CASE("tongue 0 has no width", "[floquet][tongues]") {
  CHECK_THROWS_AS(width_of(cosine(0.1), 0), InvalidInput);
}

TEST_CASE("where the ways between the modes cancel the errors of the coefficients count",
          "[floquet][tongues][extreme][N08][ratchet]") {
  // tongue 2 of a cos(theta) + b cos(2 theta) is closed at b = a^2/2 (Whittaker, Hill); 1e-10 beside it
  constexpr double kError = 1e-15;
  const auto v = [](double a, double b) {
    return PeriodicFunction::fourier(0.0, {{1, a, 0.0}, {2, b, 0.0}});
  };
  const double a = 1.0, b = 0.5 * (1.0 + 1e-10);
  const TongueWidth width = tongue_width(v(a, b), tongue_edges(v(a, b), 2, 2).front(), kError);
  check_within("N08 bound of a width next to a closed tongue (relative)", width.relative_error, 0.0002);
  double largest = 0.0;
  for (const double one : {1.0 - kError, 1.0 + kError})
    for (const double two : {1.0 - kError, 1.0 + kError})
      largest = std::max(largest, std::abs(width_of(v(one * a, two * b), 2).value / width.value - 1.0));
  CHECK(largest > 1e-6);
  CHECK(largest <= width.relative_error);
  // at the closed tongue itself nothing but a bound is left
  const TongueWidth closed = tongue_width(v(1.0, 0.5), tongue_edges(v(1.0, 0.5), 2, 2).front(), kError);
  CHECK(closed.relative_error == 1.0);
  CHECK(2.0 * closed.value >= std::abs(width_of(v(1.0 + kError, 0.5), 2).value));
  check_within("N08 bound of the width of a closed tongue with uncertain coefficients", closed.value, 3e-15);
  // a single harmonic loses n times its error
  const TongueWidth single = tongue_width(cosine(0.01), tongue_edges(cosine(0.01), 9, 9).front(), kError);
  CHECK(single.relative_error >= 9.0 * kError);
  CHECK(single.relative_error <= 40.0 * kError);
}

}  // namespace strutt::test::tongue_width_test
