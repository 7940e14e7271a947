#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

#include "strutt/model/scene.hpp"

/// The judge of the methods: the same question answered in 50 digits, from the numbers of the scene on, by
/// code that shares nothing with them.
namespace strutt::judge {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// rows x columns, by rows.
struct Matrix {
  int rows = 0, columns = 0;
  std::vector<Real> entries;

  Matrix() = default;
  Matrix(int r, int c)
      : rows(r), columns(c), entries(static_cast<std::size_t>(r) * static_cast<std::size_t>(c)) {}
  Real& operator()(int i, int j) { return entries[static_cast<std::size_t>(i * columns + j)]; }
  const Real& operator()(int i, int j) const { return entries[static_cast<std::size_t>(i * columns + j)]; }
};
Matrix operator*(const Matrix& a, const Matrix& b);

/// cosine cos(order theta) + sine sin(order theta); the mean has order 0.
struct Term {
  int order = 0;
  Matrix cosine, sine;
};

/// q'' + C(theta) q' + K(theta) q = 0, d x d, on [from, to], where C and K are trigonometric polynomials.
struct Piece {
  Real from, to;
  std::vector<Term> damping, stiffness;
};

/// The linear equation of a scene over one period in the phase theta = Omega t, with pieces that cover [0, 2
/// pi].
struct Equation {
  int degrees_of_freedom = 1;
  Real angular_frequency = 1;  ///< Omega, in the scene's unit of time
  Real kappa = 1;              ///< by which x' is made comparable with x (docs/conventions.md), same unit
  std::vector<Piece> pieces;
};

/// For a scene that validate() accepts. The numbers of the scene are taken as exact.
Equation equation_of(const Scene& scene);

}  // namespace strutt::judge
