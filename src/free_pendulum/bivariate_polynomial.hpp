#pragma once

#include <array>

#include "strutt/free_pendulum/planar_system.hpp"

namespace strutt {

/// A polynomial of degree 3 in two variables; products drop what is of higher degree.
template <typename Scalar>
class BivariatePolynomial {
 public:
  static constexpr int kDegree = 3;

  Scalar& operator()(int j, int k) { return c_[index(j)][index(k)]; }  ///< coefficient of x^j y^k
  const Scalar& operator()(int j, int k) const { return c_[index(j)][index(k)]; }

  /// Calls visit(j, k) for every term of degree `least` to `most`.
  template <typename Visit>
  static void each(int least, int most, const Visit& visit) {
    for (int j = 0; j <= most; ++j)
      for (int k = least > j ? least - j : 0; j + k <= most; ++k) visit(j, k);
  }

  friend BivariatePolynomial operator+(BivariatePolynomial a, const BivariatePolynomial& b) {
    each(0, kDegree, [&](int j, int k) { a(j, k) += b(j, k); });
    return a;
  }

  friend BivariatePolynomial operator*(const Scalar& factor, BivariatePolynomial a) {
    each(0, kDegree, [&](int j, int k) { a(j, k) *= factor; });
    return a;
  }

  friend BivariatePolynomial operator*(const BivariatePolynomial& a, const BivariatePolynomial& b) {
    BivariatePolynomial product;
    each(0, kDegree, [&](int j, int k) {
      each(0, kDegree - j - k, [&](int l, int m) { product(j + l, k + m) += a(j, k) * b(l, m); });
    });
    return product;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::array<std::array<Scalar, kDegree + 1>, kDegree + 1> c_{};
};

/// f(x(.), y(.)) up to degree 3.
template <typename Scalar>
BivariatePolynomial<Scalar> substitute(const NonlinearTerms& f, const BivariatePolynomial<Scalar>& x,
                                       const BivariatePolynomial<Scalar>& y) {
  const auto xx = x * x, xy = x * y, yy = y * y;
  return Scalar(f.c20) * xx + Scalar(f.c11) * xy + Scalar(f.c02) * yy + Scalar(f.c30) * (xx * x) +
         Scalar(f.c21) * (xx * y) + Scalar(f.c12) * (xy * y) + Scalar(f.c03) * (yy * y);
}

/// The terms of degree 2 and 3; `part` makes a double of a coefficient.
template <typename Scalar, typename Part>
NonlinearTerms nonlinear_terms(const BivariatePolynomial<Scalar>& p, const Part& part) {
  return {part(p(2, 0)), part(p(1, 1)), part(p(0, 2)), part(p(3, 0)),
          part(p(2, 1)), part(p(1, 2)), part(p(0, 3))};
}

/// Calls visit(coefficient, degree) for each coefficient.
template <typename Terms, typename Visit>
void each_term(Terms& f, const Visit& visit) {
  for (auto* c : {&f.c20, &f.c11, &f.c02}) visit(*c, 2);
  for (auto* c : {&f.c30, &f.c21, &f.c12, &f.c03}) visit(*c, 3);
}

}  // namespace strutt
