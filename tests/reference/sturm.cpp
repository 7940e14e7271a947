// Characteristic values of Mathieu's equation by bisection on Sturm's count. Usage: sturm FOLDER
//
// The Fourier coefficients of a solution of one parity obey a three-term recurrence: a symmetric
// tridiagonal matrix T with the squares of the frequencies on its diagonal and q beside it. The
// number of negative pivots of T - x is that of the eigenvalues below x. Of the infinite matrix the
// first rows are kept; two counts enclose the value: cutting the coupling off cannot lower an
// eigenvalue, and lowering the last diagonal entry by q cannot leave it too high, since the rows cut
// off, lowered by q, are above x.
#include "common.hpp"

namespace {

struct Matrix3 {
    int lowest;
    Real corner, coupling, first_coupling;  // couplings squared
};

Matrix3 matrix_of(bool even, int order, const Real& q) {
    const Real square = q * q;
    if (order % 2 != 0) return {1, even ? q : Real(-q), square, square};
    return even ? Matrix3{0, 0, square, 2 * square} : Matrix3{2, 0, square, square};
}

// Eigenvalues below x of the first `rows` rows, the last diagonal entry lowered.
int count(const Matrix3& m, int rows, const Real& x, const Real& lowered) {
    int negative = 0;
    Real pivot;
    for (int i = 0; i < rows; ++i) {
        const Real frequency = m.lowest + 2 * i;
        Real next = frequency * frequency - x;
        if (i == 0) next += m.corner;
        if (i == rows - 1) next -= lowered;
        if (i > 0) next -= (i == 1 ? m.first_coupling : m.coupling) / pivot;
        pivot = next == 0 ? Real("1e-300") : next;
        negative += pivot < 0;
    }
    return negative;
}

// Rows after which the product of q / (diagonal - x - q), about the last coefficient, is below 1e-60.
int rows_for(const Matrix3& m, const Real& x, double q) {
    double logarithm = 0;
    for (int i = 0;; ++i) {
        const double frequency = m.lowest + 2.0 * i, gap = frequency * frequency - double(x);
        if (gap > 2.5 * q) logarithm += std::log10((gap - q) / q);
        if (logarithm > 60) return i + 2;
    }
}

std::vector<Real> solve(const Row& row) {  // kind,order,q
    const int order = std::atoi(row[1].c_str());
    const Real q = input(row[2]), size = abs(q), scale = Real(order) * order + 2 * size + 1;
    const Matrix3 m = matrix_of(row[0] == "a", order, q);
    const int index = (order - m.lowest) / 2;
    Real low = Real(order) * order - 2 * size - 1, high = Real(order) * order + 2 * size + 1;
    const int rows = rows_for(m, high, double(size));
    while (high - low > scale * Real("1e-50")) {
        const Real x = (low + high) / 2;
        (count(m, rows, x, Real(0)) <= index ? low : high) = x;
    }
    const Real margin = scale * Real("1e-45");
    if (count(m, rows, low - margin, size) > index || count(m, rows, high + margin, Real(0)) <= index)
        throw std::runtime_error("not enclosed: order " + row[1] + ", q " + row[2]);
    return {(low + high) / 2};
}

}  // namespace

int main(int argc, char** argv) { answer(argc > 1 ? argv[1] : ".", "characteristic", "sturm", solve); }
