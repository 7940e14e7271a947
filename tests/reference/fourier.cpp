// Method 2a: Fourier-Floquet for one harmonic, closed form for constant pieces.
// Usage: fourier FOLDER [KIND]
//
// In s = w t the undamped equation is y'' + (delta + epsilon cos s) y = 0 and has a solution
// y = sum_k c_k exp(i (nu + k) s), where (delta - (nu + k)^2) c_k + epsilon/2 (c_{k-1} + c_{k+1}) = 0.
// No time stepping happens here: nu is a root of an algebraic equation. See README.md.
#include <complex>
#include <iostream>
#include "common.hpp"

namespace {

using Complex = std::complex<Real>;

Complex cosine(const Complex& z) { return {cos(z.real()) * cosh(z.imag()), -sin(z.real()) * sinh(z.imag())}; }
Complex sine(const Complex& z) { return {sin(z.real()) * cosh(z.imag()), cos(z.real()) * sinh(z.imag())}; }

// exp of [[0, 1], [-w, 0]] times length: the equation y'' + w y = 0 solved by hand.
Matrix constant_piece(const Real& w, const Real& length) {
  if (w == 0) return {{Real(1), length}, {Real(0), Real(1)}};
  const Real root = sqrt(abs(w)), angle = root * length;
  const Real c = w > 0 ? Real(cos(angle)) : Real(cosh(angle));
  const Real s = (w > 0 ? Real(sin(angle)) : Real(sinh(angle))) / root;
  return {{c, s}, {-w * s, c}};
}

// x = exp(-c t / 2) y removes the damping; this puts it back: (x, x') = exp(-c t / 2) B (y, y').
Matrix put_damping_back(const Matrix& y, const Real& damping, const Real& period) {
  const Real half = damping / 2;
  Matrix x = Matrix{{Real(1), Real(0)}, {-half, Real(1)}} * y * Matrix{{Real(1), Real(0)}, {half, Real(1)}};
  for (auto& row : x)
    for (auto& value : row) value *= exp(-half * period);
  return x;
}

// A first value of cos(2 pi nu) from Hill's determinant. With the rows divided by
// delta - (mu + k)^2 it equals (cos 2 pi mu - cos 2 pi nu) / (cos 2 pi mu - cos 2 pi sqrt(delta)).
// mu = 0 or 1/2, whichever keeps the divisor away from zero. The cut at +-kRows costs about
// epsilon^2 / kRows^3, of which the leading part is put back; Newton below does the rest.
Real hill_determinant(const Real& delta, const Real& epsilon) {
  constexpr int kRows = 2000;
  const Real free = constant_piece(delta, 2 * pi())[0][0];
  const Real mu = free > 0 ? Real(0.5) : Real(0), cos_mu = free > 0 ? Real(-1) : Real(1);
  const int first = -kRows - (free > 0 ? 1 : 0);  // symmetric about mu = 1/2 too
  Real before = 0, now = 1, beta_before = 0;
  for (int k = first; k <= kRows; ++k) {
    const Real beta = epsilon / 2 / (delta - (mu + k) * (mu + k));
    const Real next = now - beta * beta_before * before;
    before = now;
    now = next;
    beta_before = beta;
  }
  const Real tail = epsilon * epsilon / (6 * pow(Real(kRows + 0.5), 3));
  return cos_mu - now * exp(-tail) * (cos_mu - free);
}

Complex first_exponent(const Real& cosine_value) {
  const Real turn = 2 * pi();
  // Close to a tongue edge the guess may be on its wrong side; leaving both axes
  // lets Newton reach the real as well as the complex root.
  const Real size = abs(cosine_value);
  const Complex nudge = abs(size - 1) < Real(0.001) ? Complex(Real(1e-3), Real(1e-3)) : Complex(Real(0));
  if (size <= 1) return Complex(acos(cosine_value) / turn) + nudge;
  return Complex(cosine_value > 0 ? Real(0) : Real(0.5), log(size + sqrt(size * size - 1)) / turn) + nudge;
}

struct Floquet {
  Complex nu;
  int first;               // index of the first coefficient
  std::vector<Complex> c;  // largest about 1
};

// One Newton step. The continued fractions from both ends (p upwards, q downwards) leave one
// number gamma_k = p_k + q_k - d_k that must vanish; the row where it is smallest gives the best
// conditioned vector c, and d gamma / d nu = sum_k -2 (nu + k) c_k^2. Returns the size of the change.
Real improve(Floquet& f, const Real& delta, const Real& half) {
  const int n = int(f.c.size());
  std::vector<Complex> d(n), p(n), q(n);
  for (int k = 0; k < n; ++k) {
    const Complex m = f.nu + Complex(Real(f.first + k));
    d[k] = Complex(delta) - m * m;
  }
  const Complex square(half * half);
  p[0] = d[0];
  q[n - 1] = d[n - 1];
  for (int k = 1; k < n; ++k) {
    p[k] = d[k] - square / p[k - 1];
    q[n - 1 - k] = d[n - 1 - k] - square / q[n - k];
  }
  int best = 0;
  for (int k = 0; k < n; ++k)
    if (norm(p[k] + q[k] - d[k]) < norm(p[best] + q[best] - d[best])) best = k;
  f.c[best] = Complex(Real(1));
  for (int k = best - 1; k >= 0; --k) f.c[k] = -half * f.c[k + 1] / p[k];
  for (int k = best + 1; k < n; ++k) f.c[k] = -half * f.c[k - 1] / q[k];
  Complex slope(Real(0));
  for (int k = 0; k < n; ++k) slope -= Real(2) * (f.nu + Complex(Real(f.first + k))) * f.c[k] * f.c[k];
  const Complex change = (p[best] + q[best] - d[best]) / slope;
  f.nu -= change;
  return sqrt(norm(change));
}

Floquet solve(const Real& delta, const Real& epsilon) {
  // Beyond sqrt(delta + epsilon) the coefficients die off faster than any power.
  const int reach = 90 + int(2 * sqrt(abs(delta) + abs(epsilon)));
  Floquet f{first_exponent(hill_determinant(delta, epsilon)), -reach, std::vector<Complex>(2 * reach + 1)};
  // The change is first order in the error of c, so one more step after 1e-60 settles c as well.
  for (int round = 0; round < 200; ++round)
    if (improve(f, delta, epsilon / 2) < Real("1e-60")) {
      improve(f, delta, epsilon / 2);
      return f;
    }
  throw std::runtime_error("Newton for the characteristic exponent did not settle");
}

// M over 2 pi of y'' + (delta + epsilon cos(s - shift)) y = 0 from s = 0.
Matrix one_harmonic(const Real& delta, const Real& epsilon, const Real& shift) {
  if (epsilon == 0) return constant_piece(delta, 2 * pi());
  const Floquet f = solve(delta, epsilon);
  // Even and odd parts u1 = sum c cos((nu+k) s) / S0 and u2 = sum c sin((nu+k) s) / S1, and slopes.
  Complex s0(Real(0)), s1(Real(0)), u1(Real(0)), v1(Real(0)), u2(Real(0)), v2(Real(0));
  for (size_t k = 0; k < f.c.size(); ++k) {
    const Complex m = f.nu + Complex(Real(f.first + int(k)));
    s0 += f.c[k];
    s1 += m * f.c[k];
    if (shift == 0) continue;
    const Complex co = f.c[k] * cosine(m * -shift), si = f.c[k] * sine(m * -shift);
    u1 += co;
    v1 -= m * si;
    u2 += si;
    v2 += m * co;
  }
  const Complex turn = f.nu * (2 * pi());
  const Matrix even = {{cosine(turn).real(), (sine(turn) * s0 / s1).real()},
                       {(-sine(turn) * s1 / s0).real(), cosine(turn).real()}};
  if (shift == 0) return even;
  // U(-shift) carries the state from the symmetric point to s = 0; its determinant is one.
  const Real a = (u1 / s0).real(), b = (u2 / s1).real(), c = (v1 / s0).real(), d = (v2 / s1).real();
  return Matrix{{a, b}, {c, d}} * even * Matrix{{d, -b}, {-c, a}};
}

std::vector<Real> monodromy(const Equation& e) {
  for (size_t k = 2; k < e.cosine.size(); ++k)
    if (e.cosine[k][0][0] != 0 || e.sine[k][0][0] != 0) return {};
  const Real w = 2 * pi() / e.period, cos1 = e.cosine[1][0][0], sin1 = e.sine[1][0][0];
  const Real delta = (e.cosine[0][0][0] - e.damping * e.damping / 4) / (w * w);
  const bool even = sin1 == 0;
  const Real epsilon = even ? cos1 : Real(sqrt(cos1 * cos1 + sin1 * sin1));
  Matrix m = one_harmonic(delta, epsilon / (w * w), even ? Real(0) : Real(atan2(sin1, cos1)));
  m[0][1] /= w;  // from d/ds to d/dt
  m[1][0] *= w;
  return record(put_damping_back(m, e.damping, e.period), e.damping, e.period);
}

std::vector<Real> square_wave(const Square& s) {
  const Real lost = s.damping * s.damping / 4;
  const Matrix high = constant_piece(s.mean + s.amplitude - lost, s.period / 4);
  const Matrix low = constant_piece(s.mean - s.amplitude - lost, s.period / 2);
  return record(put_damping_back(high * low * high, s.damping, s.period), s.damping, s.period);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string folder = argc > 1 ? argv[1] : ".";
  const std::string only = argc > 2 ? argv[2] : "";
  const auto run = [&](const std::string& kind, const auto& solve) {
    if (only.empty() || only == kind) answer(folder, kind, "fourier", solve);
  };
  run("mathieu", [](const Row& row) { return monodromy(mathieu(row)); });
  run("hill", [](const Row& row) { return monodromy(hill(row)); });
  run("pendulum", [](const Row& row) { return monodromy(pendulum(row)); });
  run("mathieu_box", [](const Row& row) { return trace_of(monodromy(mathieu_box(row))); });
  run("pendulum_box", [](const Row& row) { return trace_of(monodromy(pendulum_box(row))); });
  run("square", [](const Row& row) { return square_wave(square(row)); });
} catch (const std::exception& error) {
  std::cerr << "fourier: " << error.what() << '\n';
  return 1;
}
