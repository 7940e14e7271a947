#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace strutt {

/// The functions in which a solution is expanded: exp(i (k + exponent) theta) for all k, or only the cosines
/// or sines of the frequencies k + exponent, where exponent is 0 or 1/2.
enum class HillBasis { bloch, cosine, sine };

/// The infinite banded matrix of -X'' - V X, V = sum over m of harmonic[m] e^{i m theta} + conjugate, m >= 1.
struct HillMatrix {
  HillBasis basis = HillBasis::bloch;
  double exponent = 0.0;                        ///< in [0, 1)
  std::vector<std::complex<double>> harmonics;  ///< [0] is not used

  int width() const { return static_cast<int>(harmonics.size()) - 1; }  ///< of the band on either side
  bool real() const;
  double frequency(int k) const { return k + exponent; }
  /// A bound of the norm of V.
  double norm() const;
  /// Entry (k, k - distance), 0 <= distance <= width.
  std::complex<double> entry(int k, int distance) const;
};

/// The eigenvalues mu_0 <= mu_1 <= ... of the Schur complement S(x) of (matrix - x) on a core of rows, all
/// rows outside being positive definite. The number of eigenvalues of the matrix below x is that of the mu
/// below 0; mu_j falls with x, by 1 or more, and is 0 at the eigenvalue j: |x - eigenvalue j| <= |mu_j(x)|.
struct CoreEigenvalues {
  Eigen::VectorXd values;
  double error = 0.0;  ///< bound of the error of each
};

/// x <= `highest`, which fixes the core: the rows with frequency^2 <= highest + 4 norm.
CoreEigenvalues core_eigenvalues(const HillMatrix& matrix, double x, double highest);

}  // namespace strutt
