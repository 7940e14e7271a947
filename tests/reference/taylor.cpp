// Method 1: Taylor series in time. Usage: taylor FOLDER [KIND]
//
// Each step expands the solution about the start of the step in the scaled time
// tau = (t - start) / h. The harmonics have known coefficients there, and the equation
// turns them into a recurrence for the coefficients of the solution.
#include <iostream>
#include "common.hpp"

namespace {

// A constant stiffness K gives terms like (sqrt(K) h)^k / k!. A harmonic grows like cosh(w |t|) off
// the real axis and the solution like its exponential, so w h has to be kept smaller. Each
// step checks that its last terms are indeed negligible.
constexpr int kOrder = 120;
constexpr int kRateTimesStep = 3;
constexpr double kWaveTimesStep = 0.5;
const Real kNegligible("1e-80");

// Coefficients in tau of cos(a + b tau) and sin(a + b tau).
struct Wave {
  std::vector<Real> cosine, sine;
  Wave(const Real& a, const Real& b) : cosine(kOrder), sine(kOrder) {
    const Real c = cos(a), s = sin(a);
    const Real cycle[4] = {c, -s, -c, s};  // the derivatives of cos at a; sin lags by one
    Real power = 1;
    for (int j = 0; j < kOrder; ++j) {
      cosine[j] = power * cycle[j % 4];
      sine[j] = power * cycle[(j + 3) % 4];
      power *= b / (j + 1);
    }
  }
};

// Coefficients in tau of h^2 K(start + h tau).
std::vector<Matrix> stiffness_series(const Equation& e, const Real& start, const Real& h) {
  const Real w = 2 * pi() / e.period;
  std::vector<Matrix> series(e.cosine.size() > 1 ? kOrder : 1, zeros(e.n, e.n));
  for (size_t k = 0; k < e.cosine.size(); ++k) {
    const Wave wave(k * w * start, k * w * h);
    for (size_t j = 0; j < (k ? series.size() : 1); ++j)
      for (int a = 0; a < e.n; ++a)
        for (int b = 0; b < e.n; ++b)
          series[j][a][b] += h * h * (e.cosine[k][a][b] * wave.cosine[j] + e.sine[k][a][b] * wave.sine[j]);
  }
  return series;
}

// Moves one solution (q, q') over a step: (k+2)(k+1) q_{k+2} = -c h (k+1) q_{k+1} - sum_j K_j q_{k-j}.
void step(const Equation& e, const std::vector<Matrix>& series, const Real& h, std::vector<Real>& state) {
  std::vector<std::vector<Real>> q(kOrder + 2, std::vector<Real>(e.n));
  for (int a = 0; a < e.n; ++a) {
    q[0][a] = state[a];
    q[1][a] = h * state[e.n + a];
  }
  for (int k = 0; k < kOrder; ++k)
    for (int a = 0; a < e.n; ++a) {
      Real sum = e.damping * h * (k + 1) * q[k + 1][a];
      for (int j = 0; j <= k && j < int(series.size()); ++j)
        for (int b = 0; b < e.n; ++b) sum += series[j][a][b] * q[k - j][b];
      q[k + 2][a] = -sum / ((k + 2) * (k + 1));
    }
  for (int a = 0; a < e.n; ++a) {
    Real value = 0, slope = 0, largest = 0;
    for (int k = kOrder + 1; k >= 0; --k) {  // smallest terms first
      largest = std::max(largest, Real(abs(q[k][a])));
      value += q[k][a];
      slope += k * q[k][a];
    }
    if (kOrder * (abs(q[kOrder][a]) + abs(q[kOrder + 1][a])) > kNegligible * largest)
      throw std::runtime_error("a step is too long for its series");
    state[a] = value;
    state[e.n + a] = slope / h;
  }
}

// Steps per unit of time, from the fastest growth or oscillation in the equation.
Real step_rate(const Equation& e) {
  Real size = 0;
  for (const auto* part : {&e.cosine, &e.sine})
    for (const Matrix& m : *part)
      for (const auto& row : m)
        for (const Real& x : row) size += abs(x);
  const Real wave = 2 * pi() / e.period * int(e.cosine.size() - 1);
  return std::max(
      {Real(sqrt(size) / kRateTimesStep), Real(wave / kWaveTimesStep), Real(e.damping / kRateTimesStep)});
}

// The matrix that carries (q, q') from time `from` to time `to`.
Matrix propagate(const Equation& e, const Real& from, const Real& to) {
  const int steps = 1 + int(step_rate(e) * (to - from));
  const Real h = (to - from) / steps;
  Matrix columns = identity(2 * e.n);  // each row here is one solution
  for (int i = 0; i < steps; ++i) {
    const auto series = stiffness_series(e, from + i * h, h);
    for (auto& state : columns) step(e, series, h, state);
  }
  Matrix result = zeros(2 * e.n, 2 * e.n);
  for (int i = 0; i < 2 * e.n; ++i)
    for (int j = 0; j < 2 * e.n; ++j) result[i][j] = columns[j][i];
  return result;
}

std::vector<Real> monodromy(const Equation& e) {
  return record(propagate(e, Real(0), e.period), e.damping, e.period);
}

std::vector<Real> square_wave(const Square& s) {
  const auto piece = [&](const Real& w, const Real& length) {
    return propagate({1, s.period, s.damping, {scalar(w)}, {scalar(0)}}, Real(0), length);
  };
  const Matrix high = piece(s.mean + s.amplitude, s.period / 4);
  const Matrix low = piece(s.mean - s.amplitude, s.period / 2);
  return record(high * low * high, s.damping, s.period);
}

// One step of the rod, of length h or less; returns how far it went. Besides the angle p the
// series of sin p and cos p are needed: (sin p)' = p' cos p and (cos p)' = -p' sin p.
Real motion_step(const Motion& m, const Real& start, const Real& h, Real& angle, Real& velocity) {
  const Wave wave(m.frequency * start, m.frequency * h);
  std::vector<Real> p(kOrder + 2), s(kOrder + 1), c(kOrder + 1);
  p[0] = angle;
  p[1] = h * velocity;
  s[0] = sin(angle);
  c[0] = cos(angle);
  for (int k = 0; k < kOrder; ++k) {
    Real force = m.stiffness * s[k];
    for (int j = 0; j <= k; ++j) force += m.swing * wave.sine[j] * s[k - j];
    p[k + 2] = -(m.damping * h * (k + 1) * p[k + 1] + h * h * force) / ((k + 2) * (k + 1));
    Real ds = 0, dc = 0;
    for (int j = 0; j <= k; ++j) {
      ds += (j + 1) * p[j + 1] * c[k - j];
      dc -= (j + 1) * p[j + 1] * s[k - j];
    }
    s[k + 1] = ds / (k + 1);
    c[k + 1] = dc / (k + 1);
  }
  // The series has a finite radius: go only as far as its last terms are below 1e-85.
  const Real last = std::max({Real(abs(p[kOrder + 1])), Real(abs(p[kOrder])), Real("1e-200")});
  const Real fraction = std::min(Real(1), Real(pow(Real("1e-85") / last, Real(1) / kOrder)));
  Real value = 0, slope = 0;
  for (int k = kOrder + 1; k >= 0; --k) value = value * fraction + p[k];
  for (int k = kOrder + 1; k >= 1; --k) slope = slope * fraction + k * p[k];
  angle = value;
  velocity = slope / h;
  return fraction * h;
}

std::vector<Real> rod(const Motion& m) {
  Real angle = m.angle, velocity = m.velocity, time = 0;
  while (time < m.time - Real("1e-90")) {
    const Real longest = Real(1) / 4;
    time += motion_step(m, time, std::min(longest, Real(m.time - time)), angle, velocity);
  }
  return {angle, velocity};
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string folder = argc > 1 ? argv[1] : ".";
  const std::string only = argc > 2 ? argv[2] : "";
  const auto run = [&](const std::string& kind, const auto& solve) {
    if (only.empty() || only == kind) answer(folder, kind, "taylor", solve);
  };
  run("mathieu", [](const Row& row) { return monodromy(mathieu(row)); });
  run("hill", [](const Row& row) { return monodromy(hill(row)); });
  run("pendulum", [](const Row& row) { return monodromy(pendulum(row)); });
  run("linear4", [](const Row& row) { return monodromy(linear4(row)); });
  run("mathieu_box", [](const Row& row) { return trace_of(monodromy(mathieu_box(row))); });
  run("pendulum_box", [](const Row& row) { return trace_of(monodromy(pendulum_box(row))); });
  run("square", [](const Row& row) { return square_wave(square(row)); });
  run("motion", [](const Row& row) { return rod(motion(row)); });
  run("long_motion", [](const Row& row) { return with_sensitivity(motion(row), rod); });
} catch (const std::exception& error) {
  std::cerr << "taylor: " << error.what() << '\n';
  return 1;
}
