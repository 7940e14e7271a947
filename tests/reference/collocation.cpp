// Method 2b: Gauss-Legendre collocation in time. Usage: collocation FOLDER
//
// On each sub-interval the unknowns are the accelerations at the Gauss nodes; positions and
// velocities follow by integrating the polynomial through them. The equation demanded at the
// nodes is a linear system, solved by elimination (for the rod: by Newton).
#include <iostream>
#include "common.hpp"

namespace {

// Nodes c and weights b on [0, 1]; a integrates the node polynomial from 0 to a node, a2 twice.
struct Gauss {
  int stages;
  std::vector<Real> c, b;
  Matrix a, a2;
  explicit Gauss(int n);
};

// Legendre polynomials P_0 .. P_n at x.
std::vector<Real> legendre(int n, const Real& x) {
  std::vector<Real> p{Real(1), x};
  for (int m = 1; m < n; ++m) p.push_back(((2 * m + 1) * x * p[m] - m * p[m - 1]) / (m + 1));
  return p;
}

Gauss::Gauss(int n) : stages(n), c(n), b(n), a(zeros(n, n)) {
  std::vector<std::vector<Real>> p(n);
  for (int i = 0; i < n; ++i) {
    Real x = -cos(pi() * (i + Real(0.75)) / (n + Real(0.5)));
    Real slope = 1;
    for (int round = 0; round < 12; ++round) {  // Newton on P_n, far more rounds than needed
      p[i] = legendre(n, x);
      slope = n * (x * p[i][n] - p[i][n - 1]) / (x * x - 1);
      x -= p[i][n] / slope;
    }
    c[i] = (1 + x) / 2;
    b[i] = 1 / ((1 - x * x) * slope * slope);  // half the usual weight: the interval is [0, 1]
    p[i] = legendre(n, x);
  }
  // The node polynomial of node j is b_j sum_m (2m+1) P_m(x_j) P_m(x), and the integral
  // of (2m+1) P_m from -1 is P_{m+1} - P_{m-1}; dx = 2 d(tau) gives the half.
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      Real sum = p[i][1] + 1;
      for (int m = 1; m < n; ++m) sum += p[j][m] * (p[i][m + 1] - p[i][m - 1]);
      a[i][j] = b[j] * sum / 2;
    }
  a2 = a * a;
}

// Solves system * x = right for several right sides by elimination with row exchange.
Matrix solve(Matrix system, Matrix right) {
  const int n = int(system.size()), columns = int(right[0].size());
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int i = k + 1; i < n; ++i)
      if (abs(system[i][k]) > abs(system[best][k])) best = i;
    std::swap(system[k], system[best]);
    std::swap(right[k], right[best]);
    const Real inverse = 1 / system[k][k];
    for (int i = k + 1; i < n; ++i) {
      const Real factor = system[i][k] * inverse;
      for (int j = k + 1; j < n; ++j) system[i][j] -= factor * system[k][j];
      for (int j = 0; j < columns; ++j) right[i][j] -= factor * right[k][j];
    }
  }
  for (int i = n - 1; i >= 0; --i)
    for (int j = 0; j < columns; ++j) {
      for (int k = i + 1; k < n; ++k) right[i][j] -= system[i][k] * right[k][j];
      right[i][j] /= system[i][i];
    }
  return right;
}

Matrix stiffness(const Equation& e, const Real& t) {
  Matrix result = zeros(e.n, e.n);
  for (size_t k = 0; k < e.cosine.size(); ++k) {
    const Real angle = k * t * 2 * pi() / e.period, c = cos(angle), s = sin(angle);
    for (int i = 0; i < e.n; ++i)
      for (int j = 0; j < e.n; ++j) result[i][j] += e.cosine[k][i][j] * c + e.sine[k][i][j] * s;
  }
  return result;
}

// Carries all columns of `state` (positions above velocities) over [start, start + h].
void step(const Equation& e, const Gauss& g, const Real& start, const Real& h, Matrix& state) {
  const int n = e.n, columns = 2 * n;
  Matrix system = identity(g.stages * n), right = zeros(g.stages * n, columns);
  for (int i = 0; i < g.stages; ++i) {
    const Matrix k = stiffness(e, start + g.c[i] * h);
    for (int a = 0; a < n; ++a) {
      for (int col = 0; col < columns; ++col) {
        right[i * n + a][col] = -e.damping * state[n + a][col];
        for (int b = 0; b < n; ++b)
          right[i * n + a][col] -= k[a][b] * (state[b][col] + g.c[i] * h * state[n + b][col]);
      }
      for (int j = 0; j < g.stages; ++j) {
        system[i * n + a][j * n + a] += e.damping * h * g.a[i][j];
        for (int b = 0; b < n; ++b) system[i * n + a][j * n + b] += k[a][b] * h * h * g.a2[i][j];
      }
    }
  }
  const Matrix acceleration = solve(system, right);
  for (int a = 0; a < n; ++a)
    for (int col = 0; col < columns; ++col) {
      state[a][col] += h * state[n + a][col];
      for (int j = 0; j < g.stages; ++j) {
        const Real weighted = h * g.b[j] * acceleration[j * n + a][col];
        state[a][col] += h * (1 - g.c[j]) * weighted;
        state[n + a][col] += weighted;
      }
    }
}

std::vector<Real> monodromy(const Equation& e) {
  static const Gauss gauss(
      36);  // order 72; the harmonics need the shorter steps, as they grow off the real axis
  Real size = 0;
  for (const auto* part : {&e.cosine, &e.sine})
    for (const Matrix& m : *part)
      for (const auto& row : m)
        for (const Real& x : row) size += abs(x);
  const Real waves = 2 * pi() / e.period * int(e.cosine.size() - 1);
  const Real rate = std::max({Real(sqrt(size)), Real(2 * waves), e.damping});
  const int steps = 1 + int(rate * e.period / 3);
  const Real h = e.period / steps;
  Matrix state = identity(2 * e.n);
  for (int i = 0; i < steps; ++i) step(e, gauss, i * h, h, state);
  return record(state, e.damping, e.period);
}

// One step of the rod: Newton on the accelerations at the nodes.
void motion_step(const Motion& m, const Gauss& g, const Real& start, const Real& h, Real& angle,
                 Real& velocity) {
  const int n = g.stages;
  std::vector<Real> factor(n);
  for (int i = 0; i < n; ++i) factor[i] = m.stiffness + m.swing * sin(m.frequency * (start + g.c[i] * h));
  std::vector<Real> acceleration(n, Real(0));
  for (Real change = 1; change > Real("1e-45");) {  // Newton squares this: 1e-90 when it stops
    Matrix system = identity(n), right = zeros(n, 1);
    for (int i = 0; i < n; ++i) {
      Real p = angle + g.c[i] * h * velocity, v = velocity;
      for (int j = 0; j < n; ++j) {
        p += h * h * g.a2[i][j] * acceleration[j];
        v += h * g.a[i][j] * acceleration[j];
      }
      const Real slope = factor[i] * cos(p);
      right[i][0] = -(acceleration[i] + m.damping * v + factor[i] * sin(p));
      for (int j = 0; j < n; ++j) system[i][j] += m.damping * h * g.a[i][j] + slope * h * h * g.a2[i][j];
    }
    const Matrix correction = solve(system, right);
    change = 0;
    for (int i = 0; i < n; ++i) {
      acceleration[i] += correction[i][0];
      change = std::max(change, Real(abs(correction[i][0])));
    }
  }
  angle += h * velocity;
  for (int j = 0; j < n; ++j) {
    angle += h * h * g.b[j] * (1 - g.c[j]) * acceleration[j];
    velocity += h * g.b[j] * acceleration[j];
  }
}

Real longest_step(const Motion& m) { return std::min(Real(0.1), Real(2 / m.frequency)); }

void advance(const Motion& m, const Gauss& gauss, const Real& begin, Real& angle, Real& velocity) {
  const int steps = 1 + int((m.time - begin) / longest_step(m));
  const Real h = (m.time - begin) / steps;
  for (int i = 0; i < steps; ++i) motion_step(m, gauss, begin + i * h, h, angle, velocity);
}

// Rows of one motion differ only in t and come with t rising, so a row goes on from the one before.
std::vector<Real> rod(const Row& row) {
  static const Gauss gauss(32);
  static Row begun;
  static Real time, angle, velocity;
  const Motion m = motion(row);
  const Row start(row.begin(), row.end() - 1);
  if (start != begun) {
    begun = start;
    time = 0;
    angle = m.angle;
    velocity = m.velocity;
  }
  advance(m, gauss, time, angle, velocity);
  time = m.time;
  return {angle, velocity};
}

std::vector<Real> rod_from_start(const Motion& m) {
  static const Gauss gauss(32);
  Real angle = m.angle, velocity = m.velocity;
  advance(m, gauss, 0, angle, velocity);
  return {angle, velocity};
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string folder = argc > 1 ? argv[1] : ".";
  const auto run = [&](const char* kind, const auto& solve) { answer(folder, kind, "collocation", solve); };
  run("mathieu", [](const Row& row) { return monodromy(mathieu(row)); });
  run("hill", [](const Row& row) { return monodromy(hill(row)); });
  run("pendulum", [](const Row& row) { return monodromy(pendulum(row)); });
  run("linear4", [](const Row& row) { return monodromy(linear4(row)); });
  run("motion", [](const Row& row) { return rod(row); });
  run("long_motion", [](const Row& row) { return with_sensitivity(motion(row), rod_from_start); });
} catch (const std::exception& error) {
  std::cerr << "collocation: " << error.what() << '\n';
  return 1;
}
