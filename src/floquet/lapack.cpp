#include "floquet/lapack.hpp"

#include <lapacke.h>

#include "strutt/base/error.hpp"

namespace strutt::lapack {

namespace {

/// `left`, `right`: as LAPACK writes them, real and imaginary parts of a pair in two columns.
Eigenvalues general_eigenvalues(Eigen::MatrixXd& matrix, Eigen::MatrixXd& left, Eigen::MatrixXd& right) {
  if (!matrix.allFinite()) throw NumericalFailure("eigenvalues of a matrix that is not finite");
  const auto n = static_cast<lapack_int>(matrix.rows());
  Eigen::VectorXd real(n), imaginary(n), scale(n), condition(n), separation(n);
  left.resize(n, n);
  right.resize(n, n);
  lapack_int low = 0, high = 0;
  double norm = 0.0;
  // condition numbers of eigenvalues need both sets of eigenvectors
  const auto info = LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'N', 'V', 'V', 'E', n, matrix.data(), n, real.data(),
                                   imaginary.data(), left.data(), n, right.data(), n, &low, &high,
                                   scale.data(), &norm, condition.data(), separation.data());
  if (info != 0) throw NumericalFailure("LAPACKE_dgeevx failed, info = " + std::to_string(info));
  Eigenvalues result{Eigen::VectorXcd(n), condition};
  result.values.real() = real;
  result.values.imag() = imaginary;
  return result;
}

Eigen::MatrixXcd complex_columns(const Eigen::MatrixXd& packed, const Eigen::VectorXcd& values) {
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(packed.rows(), packed.cols());
  result.real() = packed;
  for (Eigen::Index j = 0; j + 1 < packed.cols(); ++j) {
    if (values(j).imag() == 0.0) continue;
    result.col(j).imag() = packed.col(j + 1);
    result.col(j + 1) = result.col(j).conjugate();
    ++j;
  }
  return result;
}

}  // namespace

Eigenvalues eigenvalues(Eigen::MatrixXd matrix) {
  Eigen::MatrixXd left, right;
  return general_eigenvalues(matrix, left, right);
}

Eigensystem eigensystem(Eigen::MatrixXd matrix) {
  Eigen::MatrixXd left, right;
  Eigenvalues found = general_eigenvalues(matrix, left, right);
  Eigensystem result{found, complex_columns(left, found.values), complex_columns(right, found.values)};
  return result;
}

Eigen::VectorXd banded_eigenvalues(Eigen::MatrixXd band) {
  if (!band.allFinite()) throw NumericalFailure("eigenvalues of a banded matrix that is not finite");
  const auto n = static_cast<lapack_int>(band.cols()), rows = static_cast<lapack_int>(band.rows());
  Eigen::VectorXd values(n);
  double none = 0.0;
  const auto info =
      LAPACKE_dsbev(LAPACK_COL_MAJOR, 'N', 'L', n, rows - 1, band.data(), rows, values.data(), &none, 1);
  if (info != 0) throw NumericalFailure("LAPACKE_dsbev failed, info = " + std::to_string(info));
  return values;
}

Eigen::VectorXd banded_eigenvalues(Eigen::MatrixXcd band) {
  if (!band.allFinite()) throw NumericalFailure("eigenvalues of a banded matrix that is not finite");
  const auto n = static_cast<lapack_int>(band.cols()), rows = static_cast<lapack_int>(band.rows());
  Eigen::VectorXd values(n);
  lapack_complex_double none = 0.0;
  auto* entries = reinterpret_cast<lapack_complex_double*>(band.data());
  const auto info =
      LAPACKE_zhbev(LAPACK_COL_MAJOR, 'N', 'L', n, rows - 1, entries, rows, values.data(), &none, 1);
  if (info != 0) throw NumericalFailure("LAPACKE_zhbev failed, info = " + std::to_string(info));
  return values;
}

}  // namespace strutt::lapack
