// Widths of the tongues of x'' + (delta + epsilon cos t) x = 0 by two methods. Usage: width [TARGET]
//
// Both edges of a tongue in 200 digits, subtracted. First method: Sturm counts of the tridiagonal matrix of
// the Fourier coefficients, bisected. Second: no Fourier series; u1, u2 over half a period by Taylor series
// in time, and the secant method on the one of u1', u2, u1, u2' that vanishes at this edge.
#include <algorithm>
#include <iostream>

#include "common.hpp"

namespace {

using Long =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<200>, boost::multiprecision::et_off>;

// Eigenvalues below x of one parity: the pivots of the first 80 rows (the coefficients beyond are below
// 1e-200 at n <= 12).
int count(bool even, int order, const Long& epsilon, const Long& x) {
  const Long square = epsilon * epsilon / 4;
  const bool odd = order % 2 != 0;
  const Long lowest = odd ? Long(0.5) : even ? Long(0) : Long(1);
  int negative = 0;
  Long pivot;
  for (int i = 0; i < 80; ++i) {
    Long next = (lowest + i) * (lowest + i) - x;
    if (i == 0 && odd) next -= even ? Long(epsilon / 2) : Long(-epsilon / 2);
    if (i > 0) next -= (i == 1 && even && !odd ? Long(2 * square) : square) / pivot;
    pivot = next;
    negative += pivot < 0;
  }
  return negative;
}

Long bisected(bool even, int order, const Long& epsilon) {
  const int index = even ? order / 2 : (order - 1) / 2;
  Long low = Long(order) * order / 4 - epsilon - 1e-3, high = Long(order) * order / 4 + epsilon + 1e-3;
  const Long width = boost::multiprecision::pow(Long(10), -185);
  while (high - low > width) {
    const Long x = (low + high) / 2;
    (count(even, order, epsilon, x) <= index ? low : high) = x;
  }
  return (low + high) / 2;
}

// (u, u') at pi, from (u, u') = (1, 0) or (0, 1) at 0.
std::pair<Long, Long> half_period(const Long& delta, const Long& epsilon, bool cosine) {
  constexpr int steps = 16, terms = 150;
  static const Long h = boost::math::constants::pi<Long>() / steps;
  Long u = cosine ? 1 : 0, v = cosine ? 0 : 1;
  for (int s = 0; s < steps; ++s) {
    const Long c = cos(Long(s * h)), d = sin(Long(s * h));
    std::vector<Long> w(terms), x(terms + 2);
    Long power = 1;
    for (int j = 0; j < terms; ++j) {
      const Long cycle[] = {c, Long(-d), Long(-c), d};
      w[j] = epsilon * cycle[j % 4] * power;
      power *= h / (j + 1);
    }
    w[0] += delta;
    x[0] = u;
    x[1] = v * h;
    for (int k = 0; k < terms; ++k) {
      Long sum = 0;
      for (int j = 0; j <= k; ++j) sum += w[j] * x[k - j];
      x[k + 2] = -h * h * sum / ((k + 1) * (k + 2));
    }
    u = v = 0;
    for (int k = terms + 1; k >= 0; --k) u += x[k];
    for (int k = terms + 1; k >= 1; --k) v += k * x[k];
    v /= h;
  }
  return {u, v};
}

Long factor(bool even, int order, const Long& epsilon, const Long& delta) {
  const auto [u, v] = half_period(delta, epsilon, even);
  return (order % 2 == 0) == even ? v : u;  // u1', u2 for even orders; u1, u2' for odd ones
}

// The secant method from the double next to the bisected value: a start, nothing more.
Long secant(bool even, int order, const Long& epsilon, double start) {
  Long a = start, b = a + Long("1e-13");
  Long fa = factor(even, order, epsilon, a), fb = factor(even, order, epsilon, b);
  for (int i = 0; i < 14; ++i) {
    const Long next = b - fb * (b - a) / (fb - fa);
    a = b;
    fa = fb;
    b = next;
    if (abs(b - a) < boost::multiprecision::pow(Long(10), -180)) return b;
    fb = factor(even, order, epsilon, b);
  }
  throw std::runtime_error("the secant method does not converge");
}

}  // namespace

int main(int argc, char** argv) {
  std::ostringstream rows;
  Long worst = 0;
  for (const double epsilon : {1e-6, 0.01, 0.3, 2.0}) {
    for (int n = 1; n <= 12; ++n) {
      const Long a = bisected(true, n, epsilon), b = bisected(false, n, epsilon);
      const Long one = abs(a - b);
      const Long two = abs(secant(true, n, epsilon, a.convert_to<double>()) -
                           secant(false, n, epsilon, b.convert_to<double>()));
      worst = std::max(worst, Long(abs(one / two - 1)));
      rows.precision(17);
      rows << n << "," << epsilon << "," << one.str(39, std::ios_base::scientific) << "\n";
    }
  }
  if (worst > Long("1e-40")) throw std::runtime_error("the methods differ by " + worst.str(3));
  std::ofstream out(std::string(argc > 1 ? argv[1] : ".") + "/width.csv");
  out << "# x'' + (delta + epsilon cos t) x = 0: width in delta of the tongue n\n"
      << "# Inputs are exact IEEE doubles (read them with strtod); results have 40 digits.\n"
      << "# Made by width.cpp in 200-digit arithmetic, by Sturm counts and by Taylor series.\n"
      << "# Largest relative difference between methods: " << worst.str(2, std::ios_base::scientific) << ".\n"
      << "n,epsilon,width\n"
      << rows.str();
  return out.flush() ? 0 : 1;
}
