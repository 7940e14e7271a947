#include "floquet/lapack.hpp"

#include <lapacke.h>

#include "strutt/base/error.hpp"

namespace strutt::lapack {

Eigenvalues eigenvalues(Eigen::MatrixXd matrix) {
  if (!matrix.allFinite()) throw NumericalFailure("eigenvalues of a matrix that is not finite");
  const auto n = static_cast<lapack_int>(matrix.rows());
  Eigen::VectorXd real(n), imaginary(n), scale(n), condition(n), separation(n);
  Eigen::MatrixXd left(n, n), right(n, n);
  lapack_int low = 0, high = 0;
  double norm = 0.0;
  // condition numbers of eigenvalues need both sets of eigenvectors
  const auto info = LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'N', 'V', 'V', 'E', n, matrix.data(), n, real.data(),
                                   imaginary.data(), left.data(), n, right.data(), n, &low, &high, scale.data(), &norm,
                                   condition.data(), separation.data());
  if (info != 0) throw NumericalFailure("LAPACKE_dgeevx failed, info = " + std::to_string(info));
  Eigenvalues result{Eigen::VectorXcd(n), condition};
  result.values.real() = real;
  result.values.imag() = imaginary;
  return result;
}

}  // namespace strutt::lapack
