#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "strutt/base/scaled_matrix.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::scaled_matrix_test {

using Eigen::MatrixXd;

namespace {

MatrixXd random_matrix(int n, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
}

bool is_normalised(const ScaledMatrix& m) {
  const double largest = m.mantissa.cwiseAbs().maxCoeff();
  return largest >= 0.5 && largest < 1.0;
}

}  // namespace

TEST_CASE("normalising moves powers of two only", "[base][scaled][ratchet]") {
  std::mt19937 random(2);
  for (const int exponent : {-300, -1, 0, 1, 2, 300}) {
    const MatrixXd m = std::ldexp(1.0, exponent) * random_matrix(3, random);
    ScaledMatrix scaled{m, 0};
    scaled.normalise();
    CHECK(is_normalised(scaled));
    for (int i = 0; i < 9; ++i) CHECK(scaled.entry(i / 3, i % 3) == m(i / 3, i % 3));
    check_close("logarithm of the largest entry of a scaled matrix (relative)", scaled.log_max_abs(),
                std::log(m.cwiseAbs().maxCoeff()), 8e-16);
  }
  ScaledMatrix one = ScaledMatrix::identity(2);
  CHECK(is_normalised(one));
  CHECK(one.entry(0, 0) == 1.0);
  CHECK(one.entry(0, 1) == 0.0);
}

TEST_CASE("products far outside the range of double", "[base][scaled][extreme][N01][ratchet]") {
  const ScaledMatrix factor{(MatrixXd(2, 2) << 0x1p1000, 0.0, 0.0, 0x1p998).finished(), 0};
  ScaledMatrix product = ScaledMatrix::identity(2);
  for (int i = 0; i < 5000; ++i) product = factor * product;
  CHECK(is_normalised(product));
  check_close("N01 logarithm of a product of 5000 matrices (relative)", product.log_max_abs(),
              5e6 * std::log(2.0), 8e-16);
  CHECK(product.entry(0, 0) == std::numeric_limits<double>::infinity());
  product.exponent = -product.exponent;
  CHECK(product.entry(0, 0) == 0.0);
}

TEST_CASE("an entry of a product has the rounding of one inner product", "[base][scaled]") {
  std::mt19937 random(3);
  for (int n = 1; n <= 5; ++n) {
    const ScaledMatrix a{random_matrix(n, random), 3}, b{random_matrix(n, random), -5};
    const ScaledMatrix c = a * b;
    const auto exact = (a.mantissa.cast<long double>() * b.mantissa.cast<long double>()).eval();
    const MatrixXd size = a.mantissa.cwiseAbs() * b.mantissa.cwiseAbs();
    for (int i = 0; i < n * n; ++i) {
      const double error = static_cast<double>(c.entry(i / n, i % n) * 4.0L - exact(i / n, i % n));
      CHECK(std::abs(error) <= 1.01 * n * 0x1p-53 * size(i / n, i % n));
    }
  }
}

TEST_CASE("zero and non-finite matrices keep what they are", "[base][scaled]") {
  ScaledMatrix zero{MatrixXd::Zero(2, 2), 4};
  zero.normalise();
  CHECK(zero.mantissa.isZero(0.0));
  CHECK(zero.log_max_abs() == -std::numeric_limits<double>::infinity());
  CHECK((zero * ScaledMatrix::identity(2)).mantissa.isZero(0.0));
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    ScaledMatrix m{MatrixXd::Ones(2, 2), 0};
    m.mantissa(1, 0) = bad;
    m.normalise();
    CHECK_FALSE(std::isfinite(m.entry(1, 0)));
    CHECK_FALSE((m * ScaledMatrix::identity(2)).mantissa.allFinite());
  }
}

}  // namespace strutt::test::scaled_matrix_test
