#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace strutt {

/// The infinite symmetric tridiagonal matrix of the Fourier coefficients of one parity class of Mathieu's
/// equation: diagonal lowest^2 + corner, (lowest + 2)^2, (lowest + 4)^2, ...; products of the entries beside
/// it first_coupling q^2, q^2, q^2, ...
struct MathieuMatrix {
  int lowest = 0;             ///< 0, 1 or 2: the lowest frequency
  double corner = 0.0;        ///< q, -q or 0
  double first_coupling = 1;  ///< 2 where the constant term is made symmetric, else 1
  double q = 1.0;             ///< 2^-60 <= q <= 1e8

  /// Every count below is exact for a matrix whose eigenvalues differ from the true ones by at most this.
  double perturbation() const;
};

inline constexpr std::size_t kSturmLanes = 8;
using SturmPoints = std::array<double, kSturmLanes>;
using SturmCounts = std::array<std::int64_t, kSturmLanes>;

/// How many eigenvalues lie below each point, |x| <= 1e9.
SturmCounts sturm_counts(const MathieuMatrix& matrix, const SturmPoints& points);

/// Newton's step from each point on the determinant, towards an eigenvalue, and the counts; no bound is kept.
/// What comes out for one point does not depend on the others.
struct NewtonSteps {
  SturmPoints step;
  SturmCounts below;
};
NewtonSteps newton_steps(const MathieuMatrix& matrix, const SturmPoints& points);

}  // namespace strutt
