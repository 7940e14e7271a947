#pragma once

#include <Eigen/Core>

namespace strutt::lapack {

/// Eigenvalues of a general real matrix with the reciprocal condition number of each (1: normal, 0:
/// defective).
struct Eigenvalues {
  Eigen::VectorXcd values;
  Eigen::VectorXd condition;
};

/// LAPACK dgeevx. The matrix must be finite (checked: throws NumericalFailure, as it does when the QR
/// iteration fails).
Eigenvalues eigenvalues(Eigen::MatrixXd matrix);

/// The same with eigenvectors as columns of length 1: A right = right diag(values), left^H A = diag(values)
/// left^H.
struct Eigensystem {
  Eigenvalues eigenvalues;
  Eigen::MatrixXcd left, right;
};
Eigensystem eigensystem(Eigen::MatrixXd matrix);

/// Eigenvalues, ascending, of a symmetric or Hermitian banded matrix: `band` (d, j) is the entry (j + d, j),
/// d = 0 ... bandwidth. LAPACK dsbev, zhbev; backward stable. Throws NumericalFailure as above.
Eigen::VectorXd banded_eigenvalues(Eigen::MatrixXd band);
Eigen::VectorXd banded_eigenvalues(Eigen::MatrixXcd band);

}  // namespace strutt::lapack
