#pragma once

#include <Eigen/Core>

namespace strutt::lapack {

/// Eigenvalues of a general real matrix with the reciprocal condition number of each (1: normal, 0: defective).
struct Eigenvalues {
  Eigen::VectorXcd values;
  Eigen::VectorXd condition;
};

/// LAPACK dgeevx. The matrix must be finite (checked: throws NumericalFailure, as it does when the QR iteration fails).
Eigenvalues eigenvalues(Eigen::MatrixXd matrix);

}  // namespace strutt::lapack
