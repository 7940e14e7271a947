#pragma once

#include <Eigen/Core>
#include <vector>

#include "strutt/base/scaled_matrix.hpp"

namespace strutt {

/// A scaled matrix with an entrywise bound of its error, in units of the mantissa:
/// |true - value| <= error * 2^value.exponent, entry by entry. An empty error says that none is kept.
/// `Matrix` as in BasicScaledMatrix; a 2 x 2 always keeps one.
template <typename Matrix>
struct BasicBoundedMatrix {
  BasicScaledMatrix<Matrix> value;
  Matrix error = cleared<Matrix>();

  static BasicBoundedMatrix identity(int size);

  /// Moves powers of two from the mantissa (and with it the error) into the exponent.
  void normalise();
};

using BoundedMatrix = BasicBoundedMatrix<Eigen::MatrixXd>;
using BoundedMatrix2 = BasicBoundedMatrix<Eigen::Matrix2d>;

/// The product last * ... * first of factors given in order of application (first factor acts first).
/// The error of factor j is carried as |S| error_j |P|, with P the product of the factors before it and S of
/// those after it: one overestimate per factor instead of one per multiplication, so long products of
/// rotations keep a bound that grows with their number only. Second-order terms and the rounding of the
/// products are included. An empty list gives the identity of `size`. Without an error in the first factor
/// the product has none.
template <typename Matrix>
BasicBoundedMatrix<Matrix> ordered_product(const std::vector<BasicBoundedMatrix<Matrix>>& factors, int size);

}  // namespace strutt
