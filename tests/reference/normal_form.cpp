// Amplitude decay and frequency of 30 random planar centres, measured on their orbits: no normal form is
// used. See README.md. Usage: normal_form TARGET
#include <random>

#include "common.hpp"

namespace {

constexpr int kOrder = 50;    // of the Taylor series in time
constexpr int kReturns = 20;  // to the section, for each orbit
constexpr int kRadii = 10;    // orbits of each system
constexpr int kSystems = 30;
const char* const kNames[] = {"20", "11", "02", "30", "21", "12", "03"};

using Series = std::vector<Real>;

struct System {
  Real alpha;
  Real f[2][7];  // coefficients in the order of kNames
};

/// Coefficient n of a product, from the coefficients 0 ... n of its factors.
Real product(const Series& a, const Series& b, int n) {
  Real sum = 0;
  for (int i = 0; i <= n; ++i) sum += a[i] * b[n - i];
  return sum;
}

/// Taylor series in time of the solution through `start`.
std::vector<Series> expand(const System& s, const Real start[2]) {
  std::vector<Series> y(2, Series(kOrder + 1)), monomial(7, Series(kOrder + 1));
  y[0][0] = start[0];
  y[1][0] = start[1];
  for (int n = 0; n < kOrder; ++n) {
    monomial[0][n] = product(y[0], y[0], n);
    monomial[1][n] = product(y[0], y[1], n);
    monomial[2][n] = product(y[1], y[1], n);
    monomial[3][n] = product(monomial[0], y[0], n);
    monomial[4][n] = product(monomial[0], y[1], n);
    monomial[5][n] = product(monomial[2], y[0], n);
    monomial[6][n] = product(monomial[2], y[1], n);
    Real rate[2] = {s.alpha * y[1][n], -s.alpha * y[0][n]};
    for (int i = 0; i < 2; ++i) {
      for (int m = 0; m < 7; ++m) rate[i] += s.f[i][m] * monomial[m][n];
      y[i][n + 1] = rate[i] / (n + 1);
    }
  }
  return y;
}

Real value(const Series& a, const Real& t) {
  Real sum = 0;
  for (int n = kOrder; n >= 0; --n) sum = sum * t + a[n];
  return sum;
}

Real slope(const Series& a, const Real& t) {
  Real sum = 0;
  for (int n = kOrder; n >= 1; --n) sum = sum * t + n * a[n];
  return sum;
}

/// Time to the zero of y2 inside a step, by Newton's method.
Real crossing(const Series& y2, Real t) {
  for (int i = 0; i < 60; ++i) {
    const Real change = value(y2, t) / slope(y2, t);
    t -= change;
    if (abs(change) < Real("1e-60")) return t;
  }
  throw std::runtime_error("no crossing");
}

struct Return {
  Real radius, time;
};

/// The series of small orbits have radii of convergence of some units of 1/alpha.
/// From (radius, 0) until y2 = 0 with y2' < 0 has been met kReturns times.
Return follow(const System& s, const Real& radius) {
  const Real step = Real(1) / 3 / s.alpha;
  Real state[2] = {radius, 0}, time = 0;
  int returns = 0;
  while (true) {
    const auto y = expand(s, state);
    const Real next[2] = {value(y[0], step), value(y[1], step)};
    if (abs(y[1][kOrder]) * pow(step, kOrder) > Real("1e-55"))
      throw std::runtime_error("the step is too long");
    if (state[1] > 0 && next[1] <= 0 && ++returns == kReturns) {
      const Real t = crossing(y[1], step * state[1] / (state[1] - next[1]));
      return {value(y[0], t), time + t};
    }
    state[0] = next[0];
    state[1] = next[1];
    time += step;
  }
}

/// The value at 0 of the polynomial through the first `count` points, by Neville's scheme.
Real extrapolate(const Series& x, Series f, int count) {
  for (int level = 1; level < count; ++level)
    for (int i = 0; i + level < count; ++i)
      f[i] = (x[i + level] * f[i] - x[i] * f[i + 1]) / (x[i + level] - x[i]);
  return f[0];
}

std::string number(double x) {
  std::ostringstream text;
  text.precision(17);
  text << x;
  return text.str();
}

}  // namespace

int main(int, char** argv) {
  std::ofstream file(std::string(argv[1]) + "/normal_form.csv");
  file << "# y1' = alpha y2 + f1, y2' = -alpha y1 + f2: r' = delta r^3, theta' = alpha + beta r^2\n";
  file << "# measured on orbits and extrapolated to r = 0; delta_error, beta_error: last change of it\nalpha";
  for (const char* f : {"f1_", "f2_"})
    for (const char* name : kNames) file << ',' << f << name;
  file << ",delta,beta,delta_error,beta_error\n";
  std::mt19937_64 random(20040101);
  for (int i = 0; i < kSystems; ++i) {
    // Multiples of 1/64: exact as doubles and in the table.
    const auto draw = [&](int least, int most) {
      return (least + int(random() % unsigned(most - least + 1))) / 64.0;
    };
    System s;
    const double alpha = draw(32, 192);
    s.alpha = alpha;
    file << number(alpha);
    for (auto& component : s.f)
      for (Real& c : component) {
        const double f = draw(-128, 128);
        c = f;
        file << ',' << number(f);
      }
    Series radii, decay, detuning;
    for (int k = 1; k <= kRadii; ++k) {
      const Real radius = s.alpha * k / 2000;
      const Return end = follow(s, radius);
      const Real mean = end.time / kReturns;  // of one return
      radii.push_back(radius);
      decay.push_back((end.radius - radius) / (radius * radius * radius * end.time));
      detuning.push_back((2 * pi() / mean - s.alpha) / (radius * radius));
    }
    const Real delta = extrapolate(radii, decay, kRadii), beta = extrapolate(radii, detuning, kRadii);
    file << ',' << digits(delta, 20) << ',' << digits(beta, 20) << ','
         << digits(abs(delta - extrapolate(radii, decay, kRadii - 1)), 3) << ','
         << digits(abs(beta - extrapolate(radii, detuning, kRadii - 1)), 3) << '\n';
  }
  if (!file.flush()) throw std::runtime_error("cannot write normal_form.csv");
}
