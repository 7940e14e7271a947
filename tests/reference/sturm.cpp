// Characteristic values of Mathieu's equation by bisection on Sturm's count. Usage: sturm FOLDER
//
// Counts in doubles find where to begin; counts in multi-precision prove that the value is there, and
// go on.
//
// The Fourier coefficients of a solution of one parity obey a three-term recurrence: a symmetric
// tridiagonal matrix T with the squares of the frequencies on its diagonal and q beside it. The
// number of negative pivots of T - x is that of the eigenvalues below x. Of the infinite matrix the
// first rows are kept; two counts enclose the value: cutting the coupling off cannot lower an
// eigenvalue, and lowering the last diagonal entry by q cannot leave it too high, since the rows cut
// off, lowered by q, are above x.
#include "common.hpp"

namespace {

template <typename Number>
struct Jacobi {
  int lowest;
  Number corner, coupling, first_coupling;  // couplings squared
};

template <typename Number>
Jacobi<Number> matrix_of(bool even, int order, const Number& q) {
  const Number square = q * q;
  if (order % 2 != 0) return {1, even ? q : Number(-q), square, square};
  return even ? Jacobi<Number>{0, 0, square, 2 * square} : Jacobi<Number>{2, 0, square, square};
}

// Eigenvalues below x of the first `rows` rows, the last diagonal entry lowered.
template <typename Number>
int count(const Jacobi<Number>& m, int rows, const Number& x, const Number& lowered) {
  int negative = 0;
  Number pivot;
  for (int i = 0; i < rows; ++i) {
    const Number frequency = m.lowest + 2 * i;
    Number next = frequency * frequency - x;
    if (i == 0) next += m.corner;
    if (i == rows - 1) next -= lowered;
    if (i > 0) next -= (i == 1 ? m.first_coupling : m.coupling) / pivot;
    pivot = next == 0 ? Number(1e-300) : next;
    negative += pivot < 0;
  }
  return negative;
}

// Rows after which the product of q / (diagonal - x - q), about the last coefficient, is below 1e-60.
int rows_for(int lowest, double x, double q) {
  double logarithm = 0;
  for (int i = 0;; ++i) {
    const double frequency = lowest + 2.0 * i, gap = frequency * frequency - x;
    if (gap > 2.5 * q) logarithm += std::log10((gap - q) / q);
    if (logarithm > 60) return i + 2;
  }
}

template <typename Number>
void bisect(const Jacobi<Number>& m, int rows, int index, const Number& width, Number& low, Number& high) {
  while (high - low > width) {
    const Number x = (low + high) / 2;
    (count(m, rows, x, Number(0)) <= index ? low : high) = x;
  }
}

std::vector<Real> solve(const Row& row) {  // kind,order,q
  const int order = std::atoi(row[1].c_str());
  const bool even = row[0] == "a";
  const double q = std::strtod(row[2].c_str(), nullptr), size = std::abs(q);
  const double scale = 1.0 * order * order + 2 * size + 1;
  const auto doubles = matrix_of(even, order, q);
  const int index = (order - doubles.lowest) / 2;
  double near = 1.0 * order * order - 2 * size - 1, far = scale;
  bisect(doubles, rows_for(doubles.lowest, far, size), index, 1e-13 * scale, near, far);

  const auto m = matrix_of(even, order, Real(q));
  const int rows = rows_for(m.lowest, far + 1e-12 * scale, size);
  Real low = near - 1e-12 * scale, high = far + 1e-12 * scale;
  if (count(m, rows, low, Real(size)) > index || count(m, rows, high, Real(0)) <= index)
    throw std::runtime_error("not where the doubles say: order " + row[1] + ", q " + row[2]);
  bisect(m, rows, index, Real(scale * Real("1e-45")), low, high);
  const Real margin = scale * Real("1e-42");
  if (count(m, rows, Real(low - margin), Real(size)) > index ||
      count(m, rows, Real(high + margin), Real(0)) <= index)
    throw std::runtime_error("not enclosed: order " + row[1] + ", q " + row[2]);
  return {(low + high) / 2};
}

}  // namespace

int main(int argc, char** argv) { answer(argc > 1 ? argv[1] : ".", "characteristic", "sturm", solve); }
