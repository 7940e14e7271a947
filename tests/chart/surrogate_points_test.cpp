// A surrogate at scattered points, many at once.
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>

#include "chart/surrogate_box.hpp"
#include "strutt/chart/surrogate.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt::test::surrogate_points_test {

namespace {

using Points = std::vector<std::array<double, 2>>;
using Real = boost::multiprecision::cpp_bin_float_50;

Points scattered(const Axis& x, const Axis& y, std::size_t count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back({std::lerp(x.from, x.to, share(random)), std::lerp(y.from, y.to, share(random))});
  return points;
}

bool same_bits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

/// T_k(s), k < terms.
std::vector<Real> polynomials(double s, Eigen::Index terms) {
  std::vector<Real> t{1, s};
  for (Eigen::Index k = 2; k < terms; ++k) t.push_back(2 * Real(s) * t[t.size() - 1] - t[t.size() - 2]);
  return t;
}

const Scene kMathieu = parse_scene("[mathieu]\nepsilon = 0.5\ndamping = 0.2\n", "scene").scene;
const Axis kDelta{"mathieu.delta", -20.0, 60.0, 512}, kEpsilon{"mathieu.epsilon", 0.0, 40.0, 512};

}  // namespace

TEST_CASE("a surrogate at many points has the bits of one after the other", "[chart][surrogate][simd]") {
  const Surrogate surrogate(kMathieu, kDelta, kEpsilon, {.tolerance = 1e-8});
  REQUIRE(surrogate.boxes().size() > 1);
  Points points = scattered(kDelta, kEpsilon, 301);  // not a multiple of any register
  points[7] = {100.0, 1.0};                          // outside
  const auto many = surrogate.hill_monodromies(points);
  const auto wide = surrogate.monodromies(points);
  REQUIRE(many.size() == points.size());
  CHECK_FALSE(many[7]);
  CHECK_FALSE(wide[7]);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto one = surrogate.hill_monodromy(points[p][0], points[p][1]);
    INFO("point " << p);
    REQUIRE(one.has_value() == many[p].has_value());
    REQUIRE(one.has_value() == wide[p].has_value());
    if (!one) continue;
    CHECK(same_bits(one->matrix.value.mantissa, many[p]->matrix.value.mantissa));
    CHECK(same_bits(one->matrix.value.mantissa, wide[p]->matrix.value.mantissa));
    CHECK(one->matrix.value.exponent == many[p]->matrix.value.exponent);
    CHECK(same_bits(one->half->error, many[p]->half->error));
    CHECK(one->error == many[p]->error);
  }
}

TEST_CASE("many points of a system are its points one by one", "[chart][surrogate][simd]") {
  const Scene scene =
      parse_scene(
          "[linear]\nperiod = 3\nmass = [[1, 0], [0, 1]]\nstiffness = { mean = [[1, 0], [0, 3]], "
          "harmonics = [{ order = 1, cos = [[0.4, 0.3], [0.3, 0.1]] }] }\n",
          "scene")
          .scene;
  const Axis x{"linear.stiffness.mean.0.0", 0.5, 4.0, 300},
      y{"linear.stiffness.harmonics.1.cos.0.0", 0.0, 1.0, 300};
  const Surrogate surrogate(scene, x, y, {.tolerance = 1e-7});
  const Points points = scattered(x, y, 37);
  const auto many = surrogate.monodromies(points);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto one = surrogate.monodromy(points[p][0], points[p][1]);
    REQUIRE(one);
    REQUIRE(many[p]);
    CHECK(same_bits(one->matrix.value.mantissa, many[p]->matrix.value.mantissa));
    CHECK(one->error == many[p]->error);
  }
  CHECK_FALSE(surrogate.hill_monodromies(points)[0]);
}

TEST_CASE("entries are the sums of Chebyshev polynomials, within their bound", "[chart][surrogate][simd]") {
  const Surrogate surrogate(kMathieu, kDelta, kEpsilon, {.tolerance = 1e-8});
  Points points = scattered(kDelta, kEpsilon, 60);
  points.push_back({-20.0, 40.0});  // corners, where Clenshaw's recurrence loses most
  points.push_back({60.0, 40.0});
  const auto entries = surrogate.entries(points);
  for (std::size_t p = 0; p < points.size(); ++p) {
    REQUIRE(entries.box[p] != SurrogateEntries::kNone);
    const auto& box = surrogate.boxes()[entries.box[p]];
    const auto local = [&](std::size_t axis) {  // as rounded, which has a place of its own in the bound
      const double middle = 0.5 * (box.low[axis] + box.high[axis]);
      return (points[p][axis] - middle) / (0.5 * (box.high[axis] - box.low[axis]));
    };
    const auto s = polynomials(local(0), box.coefficients[0].rows()),
               t = polynomials(local(1), box.coefficients[0].cols());
    const Eigen::MatrixXd bound = evaluation_error(box);
    for (std::size_t f = 0; f < 4; ++f) {
      Real sum = 0;
      for (Eigen::Index k = 0; k < box.coefficients[f].rows(); ++k)
        for (Eigen::Index l = 0; l < box.coefficients[f].cols(); ++l)
          sum += box.coefficients[f](k, l) * s[static_cast<std::size_t>(k)] * t[static_cast<std::size_t>(l)];
      const auto rounding =
          bound(static_cast<Eigen::Index>(f / 2), static_cast<Eigen::Index>(f % 2)) - box.error[f];
      INFO("point " << p << ", entry " << f);
      CHECK(static_cast<double>(Real(abs(sum - entries.values[f * points.size() + p]))) <= rounding);
    }
  }
}

}  // namespace strutt::test::surrogate_points_test
