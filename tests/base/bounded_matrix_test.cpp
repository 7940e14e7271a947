#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "strutt/base/bounded_matrix.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::bounded_matrix_test {

using Eigen::MatrixXd;
using MatrixXl = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

namespace {

MatrixXd random_matrix(int n, double size, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
}

BoundedMatrix rotation(double angle, double error) {
  MatrixXd m(2, 2);
  m << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
  return {{m, 0}, MatrixXd::Constant(2, 2, error)};
}

/// How far |true - value| passes the bound, over all entries (<= 0: nowhere).
long double excess(const BoundedMatrix& m, const MatrixXl& truth) {
  const long double unit = std::ldexp(1.0L, static_cast<int>(m.value.exponent));
  const MatrixXl value = m.value.mantissa.cast<long double>() * unit;
  return ((truth - value).cwiseAbs() - m.error.cast<long double>() * unit).maxCoeff();
}

}  // namespace

TEST_CASE("identity and the empty product", "[base][bounded]") {
  for (const BoundedMatrix& one :
       {BoundedMatrix::identity(3), ordered_product(std::vector<BoundedMatrix>{}, 3)}) {
    for (int i = 0; i < 9; ++i) CHECK(one.value.entry(i / 3, i % 3) == (i % 4 == 0 ? 1.0 : 0.0));
    CHECK(one.error.isZero(0.0));
  }
}

TEST_CASE("normalising keeps the bound with the value", "[base][bounded]") {
  BoundedMatrix m{{MatrixXd::Constant(2, 2, 48.0), 7}, MatrixXd::Constant(2, 2, 3.0)};
  m.normalise();
  CHECK(m.value.mantissa(0, 0) == 0.75);
  CHECK(m.value.exponent == 13);
  CHECK(m.error(1, 1) == 3.0 / 64.0);
}

TEST_CASE("the first factor acts first, and one factor is exact", "[base][bounded]") {
  MatrixXd a(2, 2), b(2, 2);
  a << 1, 2, 3, 4;
  b << 0, 1, 1, 1;
  const MatrixXd none = MatrixXd::Zero(2, 2), expected = b * a;
  const auto product = ordered_product(std::vector<BoundedMatrix>{{{a, 0}, none}, {{b, 0}, none}}, 2);
  for (int i = 0; i < 4; ++i) CHECK(product.value.entry(i / 2, i % 2) == expected(i / 2, i % 2));
  const std::vector<BoundedMatrix> single(1, BoundedMatrix{{a, 0}, none});
  CHECK(ordered_product(single, 2).error.isZero(0.0));
}

TEST_CASE("the product of any matrices within the bounds lies within the bound", "[base][bounded]") {
  std::mt19937 random(4);
  for (int run = 0; run < 300; ++run) {
    const int n = 1 + run % 4, count = 1 + run % 12;
    const double size = run % 3 == 0   ? 0.0
                        : run % 3 == 1 ? 1e-12
                                       : 1e-5;  // 0: the rounding of the products alone
    std::vector<BoundedMatrix> factors;
    MatrixXl truth = MatrixXl::Identity(n, n);
    for (int j = 0; j < count; ++j) {
      const MatrixXd m = random_matrix(n, 2.0, random), deviation = random_matrix(n, size, random);
      factors.push_back({{m, 0}, deviation.cwiseAbs()});
      truth = ((m.cast<long double>() + deviation.cast<long double>()) * truth).eval();
    }
    CHECK(excess(ordered_product(factors, n), truth) <= 0.0L);
  }
}

TEST_CASE("the bound of a long product of rotations grows with their number only", "[base][bounded]") {
  constexpr int count = 200;
  constexpr double error = 1e-14;
  std::vector<BoundedMatrix> factors;
  for (int j = 0; j < count; ++j) factors.push_back(rotation(0.1 + 0.37 * j, error));
  const auto product = ordered_product(factors, 2);
  // |S| E |P| <= 2 (error + rounding) for rotations S and P
  const double rounding = 2 * 0x1p-53;
  CHECK(std::ldexp(product.error.maxCoeff(), static_cast<int>(product.value.exponent)) <=
        count * 2.0 * (1.01 * error + rounding) * 1.001);
}

TEST_CASE("growth far beyond double keeps value and relative bound", "[base][bounded][ratchet]") {
  const MatrixXd m = (MatrixXd(2, 2) << 0x1p40, 0.0, 0.0, 0x1p-40).finished();
  const BoundedMatrix factor{{m, 0}, 1e-13 * m};
  const auto product = ordered_product(std::vector<BoundedMatrix>(300, factor), 2);
  check_close("logarithm of a product of 300 bounded matrices (relative)", product.value.log_max_abs(),
              12000.0 * std::log(2.0), 8e-16);
  const double relative = product.error(0, 0) / product.value.mantissa(0, 0);
  CHECK(relative >= 300e-13);
  CHECK(relative <= 300.0 * (1.01e-13 + 0x1p-52) * 1.001);
}

}  // namespace strutt::test::bounded_matrix_test
