// Characteristic values of Mathieu's equation by continued fractions. Usage: fraction FOLDER
//
// The index comes from the order of the eigenvalues of a large matrix in doubles by the QR iteration
// (Eigen), the digits from Newton's method on the function whose zero the value is: with p the
// continued fraction of the recurrence from the first row down and r that from the last row up,
// f = p_k + r_k - (d_k - x) vanishes; the row k with the smallest |f| loses nothing, and f' is minus
// the squared length of the coefficients whose k-th is 1.
#include <Eigen/Eigenvalues>
#include <map>
#include "common.hpp"

namespace {

// a or b, even or odd order: the frequencies 0, 2, ... or 1, 3, ... or 2, 4, ...
struct Class {
  bool cosines;
  int parity;
  int lowest() const { return parity == 1 ? 1 : cosines ? 0 : 2; }
  double corner(double q) const { return parity == 0 ? 0 : cosines ? q : -q; }
  bool doubled() const { return cosines && parity == 0; }
};

const Eigen::VectorXd& doubles(const Class& c, double q, int rows) {
  static std::map<std::tuple<bool, int, double, int>, Eigen::VectorXd> known;
  auto& values = known[{c.cosines, c.parity, q, rows}];
  if (values.size() > 0) return values;
  Eigen::VectorXd diagonal(rows), beside = Eigen::VectorXd::Constant(rows - 1, q);
  for (int i = 0; i < rows; ++i) diagonal[i] = std::pow(c.lowest() + 2.0 * i, 2);
  diagonal[0] += c.corner(q);
  if (c.doubled()) beside[0] *= std::sqrt(2.0);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside, Eigen::EigenvaluesOnly);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the QR iteration failed");
  values = solver.eigenvalues();
  return values;
}

// One step of Newton's method from x.
Real step(const Class& c, const Real& q, int rows, const Real& x) {
  std::vector<Real> diagonal(rows), square(rows, q * q), down(rows), up(rows);
  for (int i = 0; i < rows; ++i) diagonal[i] = Real(c.lowest() + 2 * i) * (c.lowest() + 2 * i) - x;
  if (c.parity == 1) diagonal[0] += c.cosines ? q : Real(-q);
  if (c.doubled()) square[1] *= 2;  // square[i] couples the rows i - 1 and i
  down[0] = diagonal[0];
  for (int i = 1; i < rows; ++i) down[i] = diagonal[i] - square[i] / down[i - 1];
  up[rows - 1] = diagonal[rows - 1];
  for (int i = rows - 2; i >= 0; --i) up[i] = diagonal[i] - square[i + 1] / up[i + 1];
  int k = 0;
  const auto f = [&](int i) { return Real(down[i] + up[i] - diagonal[i]); };
  for (int i = 1; i < rows; ++i)
    if (abs(f(i)) < abs(f(k))) k = i;
  Real length = 1, part = 1;
  for (int i = k; i > 0; --i) length += part *= square[i] / (down[i - 1] * down[i - 1]);
  part = 1;
  for (int i = k + 1; i < rows; ++i) length += part *= square[i] / (up[i] * up[i]);
  return f(k) / length;
}

std::vector<Real> solve(const Row& row) {  // kind,order,q
  const int order = std::atoi(row[1].c_str());
  const double q = std::strtod(row[2].c_str(), nullptr);
  const Class c{row[0] == "a", order % 2};
  // the coefficients fall from the frequency sqrt(x + 2|q|) on
  const int rows = 120 + int(0.75 * std::sqrt(1.0 * order * order + 4 * std::abs(q)));
  const Real scale = Real(order) * order + 2 * std::abs(q) + 1;
  const Real start = doubles(c, q, std::min(rows, 12000))[(order - c.lowest()) / 2];
  Real x = start;
  for (int i = 0; i < 12; ++i) {
    const Real change = step(c, Real(q), rows, x);
    x += change;
    if (abs(change) > scale * Real("1e-50")) continue;
    if (abs(x - start) > scale * Real("1e-11")) break;
    return {x};
  }
  throw std::runtime_error("no convergence: order " + row[1] + ", q " + row[2]);
}

}  // namespace

int main(int argc, char** argv) { answer(argc > 1 ? argv[1] : ".", "characteristic", "fraction", solve); }
