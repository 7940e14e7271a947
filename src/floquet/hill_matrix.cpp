#include "floquet/hill_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "base/constants.hpp"
#include "floquet/lapack.hpp"

namespace strutt {
namespace {

/// Rows of a Hermitian banded matrix, column d of a row holding its entry d places left of the diagonal.
template <typename Scalar>
using Band = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <typename Scalar>
Scalar as(std::complex<double> z) {
  if constexpr (std::is_same_v<Scalar, double>)
    return z.real();
  else
    return z;
}

/// The rows of a core and of its surroundings.
struct Rows {
  int first, last;            // with the surroundings
  int core_first, core_last;  // inclusive
};

template <typename Scalar>
class Section {
 public:
  Section(const HillMatrix& matrix, const Rows& rows, double x)
      : rows_(rows), width_(matrix.width()), band_(rows.last - rows.first + 1, matrix.width() + 1) {
    for (int k = rows.first; k <= rows.last; ++k) {
      for (int d = 0; d <= width_; ++d)
        at(k, d) = k - d < rows.first ? Scalar(0) : as<Scalar>(matrix.entry(k, d));
      at(k, 0) -= x;
    }
  }

  /// Lowers the outermost rows by the most that the rows beyond them can do.
  void lower_ends(double upper_end, double lower_end) {
    for (int d = 0; d < width_; ++d) {
      at(rows_.last - d, 0) -= upper_end;
      if (rows_.first < rows_.core_first) at(rows_.first + d, 0) -= lower_end;
    }
  }

  /// Gaussian elimination from both ends towards the core; no row exchange, since all pivots are positive.
  void reduce_to_core() {
    for (int k = rows_.last; k > rows_.core_last; --k) eliminate_from_above(k, rows_.first);
    for (int k = rows_.first; k < rows_.core_first; ++k) eliminate_from_below(k, rows_.last);
  }

  /// The same through the core, up to the row `meeting`; counts the negative pivots. What is counted is the
  /// inertia of a matrix whose difference has entries of at most (2 width + 6) units of |L| |D| |L|^H, of
  /// which `growth` is the largest row sum.
  struct Inertia {
    int negative;
    double growth;
  };
  Inertia inertia(int meeting) {
    const int first = rows_.core_first, last = rows_.core_last;
    Inertia result{0, 0.0};
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(last - first + 1);
    const auto note = [&](int k, int direction) {
      const double pivot = std::abs(at(k, 0));
      result.negative += std::real(at(k, 0)) < 0.0;
      double beside = 0.0;
      const int reach = std::min(width_, direction < 0 ? k - first : last - k);
      const auto entry = [&](int a) { return std::abs(direction < 0 ? at(k, a) : at(k + a, a)); };
      for (int a = 1; a <= reach; ++a) beside += entry(a);
      sums[k - first] += pivot + beside;
      for (int a = 1; a <= reach; ++a) sums[k + direction * a - first] += entry(a) * (1.0 + beside / pivot);
    };
    for (int k = last; k > meeting; --k) note(k, -1), eliminate_from_above(k, first);
    for (int k = first; k < meeting; ++k) note(k, 1), eliminate_from_below(k, meeting);
    result.negative += std::real(at(meeting, 0)) < 0.0;
    sums[meeting - first] += std::abs(at(meeting, 0));
    result.growth = sums.maxCoeff();
    return result;
  }

  /// Lower band storage of LAPACK: (d, j) is the entry (j + d, j).
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> core() const {
    const int size = rows_.core_last - rows_.core_first + 1, width = std::min(width_, size - 1);
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> result(width + 1, size);
    result.setZero();
    for (int j = 0; j < size; ++j)
      for (int d = 0; d <= width && j + d < size; ++d)
        result(d, j) = band_(rows_.core_first + j + d - rows_.first, d);
    return result;
  }

 private:
  /// Row k from the rows below it, down to `lowest`; or from those above it, up to `highest`.
  void eliminate_from_above(int k, int lowest) {
    const int reach = std::min(width_, k - lowest);
    for (int a = 1; a <= reach; ++a)
      for (int b = a; b <= reach; ++b) at(k - a, b - a) -= conjugate(at(k, a)) * at(k, b) / at(k, 0);
  }
  void eliminate_from_below(int k, int highest) {
    const int reach = std::min(width_, highest - k);
    for (int a = 1; a <= reach; ++a)
      for (int b = 1; b <= a; ++b) at(k + a, a - b) -= at(k + a, a) * conjugate(at(k + b, b)) / at(k, 0);
  }
  static double conjugate(double x) { return x; }
  static std::complex<double> conjugate(std::complex<double> z) { return std::conj(z); }
  Scalar& at(int k, int distance) { return band_(k - rows_.first, distance); }

  Rows rows_;
  int width_;
  Band<Scalar> band_;
};

/// The largest sum of absolute values of a row of a Hermitian matrix in lower band storage.
template <typename Matrix>
double largest_row_sum(const Matrix& band) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(band.cols());
  for (Eigen::Index j = 0; j < band.cols(); ++j) {
    sums[j] += std::abs(band(0, j));
    for (Eigen::Index d = 1; d < band.rows() && j + d < band.cols(); ++d) {
      sums[j] += std::abs(band(d, j));
      sums[j + d] += std::abs(band(d, j));
    }
  }
  return sums.maxCoeff();
}

/// The core holds every row whose diagonal is not 4 norm above `highest`.
Rows rows_of(const HillMatrix& matrix, double highest, int surroundings) {
  const double reach = std::sqrt(std::max(highest + std::max(4.0 * matrix.norm(), 1.0), 1.0));
  const int last = static_cast<int>(std::ceil(reach - matrix.exponent));
  if (matrix.basis == HillBasis::bloch) {
    const int first = static_cast<int>(std::floor(-reach - matrix.exponent));
    return {first - surroundings, last + surroundings, first, last};
  }
  const int first = matrix.basis == HillBasis::sine && matrix.exponent == 0.0 ? 1 : 0;
  return {first, last + surroundings, first, std::max(last, first)};
}

/// The Schur complement of all that lies beyond an end is between 0 and this: |V|^2 / (the least of (diagonal
/// - x) - |V|).
double beyond(const HillMatrix& matrix, int k, double x) {
  const double norm = matrix.norm(), frequency = std::abs(matrix.frequency(k));
  return norm * norm / (frequency * frequency - norm - x);
}

/// The core of (matrix - x), its surroundings eliminated.
template <typename Scalar>
struct Core {
  Section<Scalar> section;
  Rows rows;
  double size;   ///< largest row sum
  double error;  ///< bound of the norm of what truncation and rounding have changed
};

template <typename Scalar>
Core<Scalar> core_of(const HillMatrix& matrix, double x, double highest) {
  for (int surroundings = matrix.width() + 8;; surroundings *= 2) {
    const Rows rows = rows_of(matrix, highest, surroundings);
    Section<Scalar> upper(matrix, rows, x), lower(matrix, rows, x);
    const auto plain = upper.core();
    lower.lower_ends(beyond(matrix, rows.last + 1, x), beyond(matrix, rows.first - 1, x));
    upper.reduce_to_core();
    lower.reduce_to_core();
    const auto core = upper.core();
    const double truncation = largest_row_sum((core - lower.core()).eval()), size = largest_row_sum(core);
    if (truncation > kUnit * size && surroundings < 100'000) continue;

    // Cholesky's backward error in the surroundings (Higham, Accuracy and Stability, theorem 10.3), scaled by
    // their diagonal, of which they are 3/4 at least; the subtractions; the entries
    const double width = matrix.width(), complement = largest_row_sum((core - plain).eval());
    const double rounding =
        kUnit * (3.0 * (2.0 * width + 1.0) * (width + 3.0) * complement + (width + 5.0) * size + std::abs(x));
    return {std::move(upper), rows, size, 1.01 * (rounding + truncation)};
  }
}

template <typename Scalar>
CoreEigenvalues eigenvalues(const HillMatrix& matrix, double x, double highest) {
  const auto core = core_of<Scalar>(matrix, x, highest);
  const auto band = core.section.core();
  // what LAPACK's documentation calls modest times unit roundoff, with a generous constant
  const double solver = (4.0 * static_cast<double>(band.cols()) + 10.0) * kUnit * core.size;
  return {lapack::banded_eigenvalues(band), core.error + solver, core.size};
}

template <typename Scalar>
CoreCount count(const HillMatrix& matrix, double x, double highest) {
  auto core = core_of<Scalar>(matrix, x, highest);
  // Elimination should end where the solutions are large: next to 0 for small x; of the two places of a
  // travelling wave one is passed in any case.
  const int length = core.rows.core_last - core.rows.core_first;
  const int meeting = core.rows.core_first + (matrix.basis == HillBasis::bloch ? length / 4 : 0);
  const auto [negative, growth] = core.section.inertia(meeting);
  return {negative, core.error + 1.01 * (2.0 * matrix.width() + 6.0) * kUnit * growth};
}

}  // namespace

bool HillMatrix::real() const {
  return std::all_of(harmonics.begin(), harmonics.end(), [](auto z) { return z.imag() == 0.0; });
}

double HillMatrix::norm() const {
  double sum = 0.0;
  for (int m = 1; m <= width(); ++m) sum += 2.0 * std::abs(harmonics[static_cast<std::size_t>(m)]);
  return sum * (1.0 + (width() + 4) * kUnit);
}

std::complex<double> HillMatrix::entry(int k, int distance) const {
  const auto harmonic = [&](int m) {
    return m >= 1 && m <= width() ? harmonics[static_cast<std::size_t>(m)] : std::complex<double>(0.0);
  };
  std::complex<double> result = -harmonic(distance);
  if (basis != HillBasis::bloch) {
    const auto sum = harmonic(2 * k - distance + (exponent == 0.0 ? 0 : 1));
    result += basis == HillBasis::cosine ? -sum : sum;
    // the constant function is normalised by itself
    if (exponent == 0.0 && basis == HillBasis::cosine && distance == k)
      result = -std::numbers::sqrt2 * harmonic(k);
  }
  return distance == 0 ? result + frequency(k) * frequency(k) : result;
}

CoreEigenvalues core_eigenvalues(const HillMatrix& matrix, double x, double highest) {
  return matrix.real() ? eigenvalues<double>(matrix, x, highest)
                       : eigenvalues<std::complex<double>>(matrix, x, highest);
}

CoreCount core_count(const HillMatrix& matrix, double x, double highest) {
  return matrix.real() ? count<double>(matrix, x, highest) : count<std::complex<double>>(matrix, x, highest);
}

}  // namespace strutt
