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
  std::vector<double> errors =
      {};  ///< of the harmonics; for the resonant block only, all others take them as exact

  int width() const { return static_cast<int>(harmonics.size()) - 1; }  ///< of the band on either side
  bool real() const;
  double frequency(int k) const { return k + exponent; }
  /// A bound of the norm of V.
  double norm() const;
  /// Entry (k, k - distance), 0 <= distance <= width.
  std::complex<double> entry(int k, int distance) const;
};

/// The Schur complement S(x) of (matrix - x) on a core of rows, all rows outside being positive definite: the
/// rows with frequency^2 <= highest + 4 norm; x <= highest. Its number of negative eigenvalues is that of the
/// eigenvalues of the infinite matrix below x (Sylvester). Its eigenvalue mu_j falls with x, by 1 or more,
/// and is 0 at the eigenvalue j: |x - eigenvalue j| <= |mu_j(x)|.
struct CoreEigenvalues {
  Eigen::VectorXd values;  ///< mu_0 <= mu_1 <= ..., by LAPACK
  double error = 0.0;      ///< an estimate from above of the error of each
  double size = 0.0;       ///< of S
};
CoreEigenvalues core_eigenvalues(const HillMatrix& matrix, double x, double highest);

/// The number of eigenvalues below x, right for a matrix whose eigenvalues differ by `error` at most: proved.
struct CoreCount {
  int below = 0;
  double error = 0.0;
};
CoreCount core_count(const HillMatrix& matrix, double x, double highest);

}  // namespace strutt
