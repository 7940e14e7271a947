// What the reference programs share: the number type, the text files they pass
// to each other, and the equations themselves. No solution method lives here,
// so the methods stay independent of one another.
#pragma once
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// 100 digits: some monodromy matrices reach 1e122 and some margins are 1e-24,
// and the Fourier sums cancel up to forty digits before they are divided.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;
using Matrix = std::vector<std::vector<Real>>;
using Row = std::vector<std::string>;

inline Real pi() { return boost::math::constants::pi<Real>(); }
inline Matrix zeros(int rows, int columns) { return Matrix(rows, std::vector<Real>(columns, Real(0))); }
inline Matrix identity(int n) {
  Matrix result = zeros(n, n);
  for (int i = 0; i < n; ++i) result[i][i] = 1;
  return result;
}
inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix result = zeros(int(a.size()), int(b[0].size()));
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < b[0].size(); ++j)
      for (size_t k = 0; k < b.size(); ++k) result[i][j] += a[i][k] * b[k][j];
  return result;
}

inline Row split(const std::string& line) {
  Row fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}
inline std::vector<Row> read_rows(const std::string& name) {
  std::ifstream file(name);
  if (!file) throw std::runtime_error("cannot read " + name);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) rows.push_back(split(line));
  return rows;
}
// An input is the double nearest to its decimal text, and that double is exact.
inline Real input(const std::string& text) { return Real(std::strtod(text.c_str(), nullptr)); }
inline std::vector<Real> inputs(const Row& row, size_t first) {
  std::vector<Real> values;
  for (size_t i = first; i < row.size(); ++i) values.push_back(input(row[i]));
  return values;
}
inline std::string digits(const Real& x, int significant) {
  return x.str(significant - 1, std::ios_base::scientific);
}

// q'' + damping q' + K(t) q = 0 with K(t) = sum_k cosine[k] cos(k w t) + sine[k] sin(k w t),
// w = 2 pi / period; every K is n by n and cosine[0] is the mean.
struct Equation {
  int n = 1;
  Real period, damping;
  std::vector<Matrix> cosine, sine;
};
inline Matrix scalar(const Real& x) { return Matrix{{x}}; }

inline Equation mathieu(const Row& row) {  // family,delta,epsilon,damping
  const auto v = inputs(row, 1);
  return {1, 2 * pi(), v[2], {scalar(v[0]), scalar(v[1])}, {scalar(0), scalar(0)}};
}
inline Equation hill(const Row& row) {  // period,mean,cos1,sin1,cos2,sin2,cos3,sin3,damping
  const auto v = inputs(row, 0);
  return {1,
          v[0],
          v[8],
          {scalar(v[1]), scalar(v[2]), scalar(v[4]), scalar(v[6])},
          {scalar(0), scalar(v[3]), scalar(v[5]), scalar(v[7])}};
}
inline Equation pendulum(const Row& row) {  // about,length,gravity,amplitude,frequency,phase,damping
  const auto v = inputs(row, 1);
  const Real length = v[0], gravity = v[1], amplitude = v[2], frequency = v[3], phase = v[4];
  const Real stiffness = (row[0] == "inverted" ? -1 : 1) * 3 * gravity / (2 * length);
  // r'' = -amplitude frequency^2 sin(frequency t + phase), opened into cosine and sine.
  const Real swing = -stiffness * amplitude * frequency * frequency / gravity;
  return {1,
          2 * pi() / frequency,
          v[5],
          {scalar(stiffness), scalar(swing * sin(phase))},
          {scalar(0), scalar(swing * cos(phase))}};
}
inline Equation mathieu_box(const Row& row) {  // column,row,delta,epsilon
  return mathieu({"", row[2], row[3], "0"});
}
inline Equation pendulum_box(const Row& row) {  // column,row,frequency,amplitude
  return pendulum({"hanging", "1", "9.81", row[3], row[2], "0", "0"});
}
inline Equation linear4(const Row& row) {  // c,k1,k2,k12,p11,p12,p22
  const auto v = inputs(row, 0);
  return {2,
          2 * pi(),
          v[0],
          {Matrix{{v[1], v[3]}, {v[3], v[2]}}, Matrix{{v[4], v[5]}, {v[5], v[6]}}},
          {zeros(2, 2), zeros(2, 2)}};
}

// w = mean + amplitude sign(cos(2 pi t / period)): high for a quarter, low for a half, high again.
struct Square {
  Real period, mean, amplitude, damping;
};
inline Square square(const Row& row) {
  const auto v = inputs(row, 0);
  return {v[0], v[1], v[2], v[3]};
}

// phi'' + damping phi' + alpha^2 (1 + r''/gravity) sin phi = 0, r = amplitude sin(frequency t).
struct Motion {
  Real stiffness, swing, frequency, damping, angle, velocity, time;
  // The factor before sin phi is stiffness + swing sin(frequency t).
};
inline Motion motion(const Row& row) {  // length,gravity,amplitude,frequency,damping,angle0,velocity0,t
  const auto v = inputs(row, 0);
  const Real stiffness = 3 * v[1] / (2 * v[0]);
  return {stiffness, -stiffness * v[2] * v[3] * v[3] / v[1], v[3], v[4], v[5], v[6], v[7]};
}

// Angle and velocity of a motion, then the largest |entry| of d(phi, phi'/alpha)/d(phi0, phi0'/alpha), at
// least 1, by differences: the step leaves 25 digits of it.
template <typename Solve>
std::vector<Real> with_sensitivity(const Motion& m, const Solve& solve) {
  const Real step("1e-25"), alpha = sqrt(m.stiffness);
  std::vector<Real> result = solve(m);
  Motion turned = m, pushed = m;
  turned.angle += step;
  pushed.velocity += alpha * step;
  Real largest = 1;
  for (const Motion& neighbour : {turned, pushed}) {
    const std::vector<Real> state = solve(neighbour);
    largest = std::max(
        {largest, Real(abs(state[0] - result[0]) / step), Real(abs(state[1] - result[1]) / (alpha * step))});
  }
  result.push_back(largest);
  return result;
}

// The numbers recorded for a monodromy matrix: its entries by rows and, for one degree
// of freedom, the trace and the stability margin 1 - |D| / (2 cosh(cT/2)), D = exp(cT/2) trace.
inline std::vector<Real> record(const Matrix& m, const Real& damping, const Real& period) {
  std::vector<Real> values;
  for (const auto& row : m) values.insert(values.end(), row.begin(), row.end());
  if (m.size() != 2) return values;
  const Real trace = m[0][0] + m[1][1], half = damping * period / 2;
  values.push_back(trace);
  values.push_back(1 - abs(exp(half) * trace) / (2 * cosh(half)));
  return values;
}

// Of a record, the trace alone.
inline std::vector<Real> trace_of(const std::vector<Real>& record) { return {record[4]}; }

// Reads FOLDER/KIND.in, writes FOLDER/KIND.METHOD: one line of 70-digit numbers per case,
// or "-" where the method does not apply (an empty answer).
inline void answer(const std::string& folder, const std::string& kind, const std::string& method,
                   const std::function<std::vector<Real>(const Row&)>& solve) {
  std::ofstream out(folder + "/" + kind + "." + method);
  for (const Row& row : read_rows(folder + "/" + kind + ".in")) {
    const auto values = solve(row);
    for (size_t i = 0; i < values.size(); ++i) out << (i ? "," : "") << digits(values[i], 70);
    out << (values.empty() ? "-\n" : "\n");
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + kind + "." + method);
}
