// Writes the inputs of every reference case. Usage: cases FOLDER
//
// Numbers are written in their shortest form that reads back as the same double, so the text
// is the exact input. The scatter comes from a fixed seed of a generator the standard pins down.
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <random>
#include "common.hpp"

namespace {

std::string text(double x) {
  char buffer[40];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
}
std::string join(const std::vector<double>& values) {
  std::string line;
  for (double x : values) line += (line.empty() ? "" : ",") + text(x);
  return line + "\n";
}

std::mt19937_64 generator(20240611);
// std::uniform_real_distribution may differ between libraries; the top 53 bits do not.
double uniform(double low, double high) {
  return low + (high - low) * std::ldexp(double(generator() >> 11), -53);
}

// Edge of the n-th tongue of x'' + (delta + epsilon cos t) x = 0: the delta with a solution of period
// 2 pi (n even) or 4 pi (n odd), even or odd in t. It is an eigenvalue of the tridiagonal matrix of the
// cosine or sine coefficients, found by counting signs of the pivots (Sturm) and halving.
Real tongue_edge(int n, bool even, const Real& epsilon) {
  constexpr int kSize = 60;
  const bool whole = n % 2 == 0;
  const int index = whole && !even ? n / 2 - 1 : n / 2;  // place among its own class, from 0
  std::vector<Real> diagonal(kSize), square(kSize, epsilon * epsilon / 4);
  for (int k = 0; k < kSize; ++k) {
    const Real frequency = whole ? Real(even ? k : k + 1) : k + Real(0.5);
    diagonal[k] = frequency * frequency;
  }
  if (whole && even) square[1] *= 2;  // the constant term, with its norm
  if (!whole) diagonal[0] += even ? Real(-epsilon / 2) : Real(epsilon / 2);
  const auto below = [&](const Real& x) {
    int count = 0;
    Real pivot = 1;
    for (int k = 0; k < kSize; ++k) {
      pivot = diagonal[k] - x - (k ? Real(square[k] / pivot) : Real(0));
      count += pivot < 0;
    }
    return count;
  };
  Real low = -20, high = 40;
  for (int round = 0; round < 150; ++round) {
    const Real middle = (low + high) / 2;
    (below(middle) > index ? high : low) = middle;
  }
  return low;
}

// Trace of M by plain Runge-Kutta: good to about 1e-12, enough to place a case near a damped edge.
double rough_trace(double delta, double epsilon, double damping) {
  constexpr int kSteps = 4000;
  const double h = 2 * 3.141592653589793 / kSteps;
  double trace = 0;
  for (int column = 0; column < 2; ++column) {
    double x = column == 0, v = column == 1;
    for (int i = 0; i < kSteps; ++i) {
      const double early = delta + epsilon * std::cos(i * h), late = delta + epsilon * std::cos((i + 1) * h);
      const double middle = delta + epsilon * std::cos((i + 0.5) * h);
      const double a1 = -damping * v - early * x, v2 = v + h / 2 * a1;
      const double a2 = -damping * v2 - middle * (x + h / 2 * v), v3 = v + h / 2 * a2;
      const double a3 = -damping * v3 - middle * (x + h / 2 * v2), v4 = v + h * a3;
      const double a4 = -damping * v4 - late * (x + h * v3);
      x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    trace += column == 0 ? x : v;
  }
  return trace;
}

// Where -trace = 1 + det M (a multiplier -1) between an unstable and a stable delta.
double damped_edge(double unstable, double stable, double epsilon, double damping) {
  const double limit = 1 + std::exp(-2 * 3.141592653589793 * damping);
  for (int round = 0; round < 60; ++round) {
    const double middle = (unstable + stable) / 2;
    (-rough_trace(middle, epsilon, damping) > limit ? unstable : stable) = middle;
  }
  return stable;
}

void mathieu_cases(std::ostream& out) {
  const auto add = [&](const char* family, double delta, double epsilon, double damping) {
    out << family << ',' << join({delta, epsilon, damping});
  };
  add("scatter", 1, 0.5, 0);
  for (int i = 0; i < 170; ++i) {
    const double delta = uniform(-1, 5);
    add("scatter", delta, uniform(0, 6), 0);
  }
  for (double delta : {0.3, 0.0, 1.0, 0.25, 2.25, -0.7, 4.5}) add("scatter", delta, 0, 0);
  for (int i = 0; i < 10; ++i) {
    const double delta = uniform(-1, 5);
    add("scatter", delta, uniform(-6, 0), 0);
  }
  for (int i = 0; i < 40; ++i) {
    const double delta = uniform(-50, 200);
    add("wide", delta, uniform(0, 200), 0);
  }
  for (double epsilon : {0.5, 10.0, 1e3}) add("extreme", 1e4, epsilon, 0);
  for (double epsilon : {0.0, 0.5, 20.0}) add("extreme", -50, epsilon, 0);
  for (double delta : {0.0, 1.0, 500.0, -200.0}) add("extreme", delta, 1e3, 0);
  for (double epsilon : {0.0, 0.5, 1e3}) add("extreme", -2000, epsilon, 0);
  for (double damping : {1e-9, 0.05, 0.3, 1.0, 10.0})
    for (int i = 0; i < 5; ++i) {
      const double delta = uniform(-1, 5);
      add("damped", delta, uniform(0, 6), damping);
    }
  add("damped", 1, 0.5, 0.05);
  add("damped", 0, 0, 0.3);
  add("damped", -0.5, 0, 1);
  add("damped", 25, 0, 10);  // critical damping: a double root
  add("damped", 1e4, 1e3, 0.3);
  add("damped", -50, 20, 1);
  const std::array<double, 6> offsets{1e-12, -1e-12, 1e-9, -1e-9, 1e-6, -1e-6};
  size_t turn = 0;
  for (double epsilon : {0.1, 0.5, 2.0, 5.0})
    for (int n = 0; n <= 6; ++n)
      for (bool even : {true, false}) {
        if (n == 0 && !even) continue;
        const double edge(tongue_edge(n, even, Real(epsilon)));
        // The stride gives an edge another offset at each epsilon.
        const double offset = offsets[turn++ * 5 % 6];
        add("edge", edge + offset * std::max(1.0, std::abs(edge)), epsilon, 0);
      }
  // Damping moves the edges of the first tongue inwards: from its middle, 1/4, out to the old edge.
  for (double epsilon : {0.1, 0.5, 2.0})
    for (bool even : {true, false}) {
      const double damping = 0.3 * epsilon;
      const double edge = damped_edge(0.25, double(tongue_edge(1, even, Real(epsilon))), epsilon, damping);
      for (double offset : {1e-9, -1e-6}) add("damped", edge + offset, epsilon, damping);
    }
}

void hill_cases(std::ostream& out) {
  const std::array<double, 3> periods{1, 3.141592653589793, 10};
  const std::array<double, 4> dampings{0, 0, 0.1, 0.7};
  for (int i = 0; i < 40; ++i) {
    const double period = periods[size_t(i) % 3], w = 2 * 3.141592653589793 / period, unit = w * w;
    // In units of w^2 the mean covers the first four tongues and a little below zero.
    std::vector<double> row{period, unit * uniform(-0.3, 4)};
    const std::string kind = i < 6    ? "cosine"
                             : i < 20 ? "even"
                             : i < 24 ? "sine"
                             : i < 29 ? "shifted"
                                      : "free";
    const double shift = uniform(-3, 3);
    for (int k = 1; k <= 3; ++k) {
      const double size = unit * uniform(-2, 2) / k, other = unit * uniform(-2, 2) / k;
      double c = size, s = other;
      if (kind == "even" || (kind == "cosine" && k == 1)) s = 0;
      if (kind == "sine" && k == 1) c = 0;
      if ((kind == "cosine" || kind == "sine") && k > 1) c = s = 0;
      // Even about theta0 = shift, up to the rounding of these products.
      if (kind == "shifted") s = size * std::sin(k * shift), c = size * std::cos(k * shift);
      row.push_back(c);
      row.push_back(s);
    }
    row.push_back(dampings[size_t(i) / 3 % 4]);
    out << join(row);
  }
}

void square_cases(std::ostream& out) {
  for (const std::vector<double>& row : std::vector<std::vector<double>>{{1, 2, 2, 0},
                                                                         {1, -2, 2, 0},
                                                                         {1, 2, -2, 0},
                                                                         {1, 0, 3, 0},
                                                                         {1, 40, 0, 0},
                                                                         {1, -40, 0, 0},
                                                                         {1, 0, 0, 0},
                                                                         {1, 0, 2000, 0},
                                                                         {1, -3000, 2000, 0},
                                                                         {1, 2000, 3000, 0.3},
                                                                         {10, 100, 300, 0},
                                                                         {6.283185307179586, 0.25, 0.1, 0},
                                                                         {6.283185307179586, 1, 0.5, 0},
                                                                         {6.283185307179586, 1, 0.5, 0.05},
                                                                         {6.283185307179586, 1, 1, 1},
                                                                         {6.283185307179586, 0.25, 0.25, 1}})
    out << join(row);
  for (int i = 0; i < 10; ++i) {
    const double mean = uniform(-1, 5), amplitude = uniform(-6, 6);
    out << join({6.283185307179586, mean, amplitude, i % 2 ? 0.1 * i : 0});
  }
}

void pendulum_cases(std::ostream& out) {
  const double alpha = std::sqrt(3 * 9.81 / 2);
  for (const std::string about : {"hanging", "inverted"}) {
    for (double ratio : {0.2, 0.5, 1.0, 1.9, 2.0, 2.1, 5.0, 20.0, 100.0})
      for (double amplitude : {0.0, 0.01, 0.05, 0.2, 0.5})
        out << about << ',' << join({1, 9.81, amplitude, ratio * alpha, 0, 0});
    for (int i = 0; i < 6; ++i) {
      const double length = uniform(0.1, 3), amplitude = uniform(0, 0.3) * length;
      const double frequency = uniform(1, 40), phase = uniform(-3, 3);
      out << about << ',' << join({length, i % 2 ? 9.81 : 1.62, amplitude, frequency, phase, i % 3 * 0.4});
    }
  }
}

void linear4_cases(std::ostream& out) {
  for (const std::vector<double>& row : std::vector<std::vector<double>>{
           {0, 0.16, 0.36, 0, 0, 0.1, 0},        // sum combination resonance: 0.4 + 0.6 = 1
           {0.05, 0.16, 0.36, 0, 0, 0.1, 0},     // the same, held down by damping
           {0, 0.16, 0.5, 0, 0, 0.05, 0},        // detuned: stable
           {0, 0.25, 2.25, 0, 0.02, 0.1, 0.02},  // difference 1.5 - 0.5 = 1 and principal resonances
           {0, 1, 2, 0, 0.5, 0, 0.3},            // two Mathieu equations side by side
           {0, 1, 2, 0.3, 0, 0, 0},              // constant stiffness
           {0, 1, 1, 0, 0, 0, 0},                // the same, double frequencies
           {0.3, -0.2, 3, 0.4, 1, -0.5, 2},
           {0, 5, 7, 1, 4, 2, -3},
           {1, 20, 30, -5, 15, 8, 9}})
    out << join(row);
  for (int i = 0; i < 6; ++i) {
    std::vector<double> row{i % 2 * 0.2};
    for (int k = 0; k < 2; ++k) row.push_back(uniform(0, 4));
    for (int k = 0; k < 4; ++k) row.push_back(uniform(-1, 1));
    out << join(row);
  }
}

void motion_cases(std::ostream& out) {
  for (const std::vector<double>& start : std::vector<std::vector<double>>{
           {1, 9.81, 0, 5, 0, 1, 0},             // no excitation: the plain rod
           {1, 9.81, 0, 5, 0, 3, 2},             // it goes over the top
           {1, 9.81, 0.05, 7.672, 0.1, 0.1, 0},  // principal resonance from a small angle
           {1, 9.81, 0.1, 3, 0.2, 2, 0},
           {0.5, 9.81, 0.02, 12, 0, 0.5, -1},
           {1, 9.81, 0.2, 40, 0.5, 3, 0},  // fast excitation holds the rod upright
           {1, 9.81, 0.2, 6, 0.05, 1, 0},  // tumbling: a change at the start grows 3e6-fold
           {1, 9.81, 0.3, 7, 0, 2.5, 1}})  // tumbling without damping: 5e8-fold
    for (double time : {1.0, 2.5, 5.0, 10.0, 20.0}) {
      std::vector<double> row = start;
      row.push_back(time);
      out << join(row);
    }
}

// a_n, b_n for all orders to 100, and what other libraries have wrong: q = 21, 600 ... 1500, 2000 (orders 69,
// 70), 1e5, 1e6, 1e7, 1e8; then orders up to 10000.
void characteristic_cases(std::ostream& out) {
  const auto write = [&](int order, double q) {
    for (const char* kind : {"a", "b"})
      if (order > 0 || *kind == 'a') out << kind << ',' << order << ',' << join({q});
  };
  const std::vector<double> parameters{
      1e-9, 1e-6, 1e-3, 1e-2, 0.1, 0.5, 1,   2,   3,   5,   -5,   7,    10,   15,   21,    25,  -25,
      40,   60,   80,   100,  140, 200, 300, 400, 600, 800, 1024, 1200, 1500, 2000, -2000, 3e3, 4e3,
      6e3,  8e3,  1e4,  -1e4, 2e4, 3e4, 5e4, 7e4, 1e5, 2e5, 3e5,  5e5,  1e6,  3e6,  1e7,   1e8};
  for (double q : parameters)
    for (int order = 0; order <= 100; ++order) write(order, q);
  for (double q : {1.0, 1e4, 1e8}) write(1000, q);
  for (double q : {1e4, 1e8}) write(10000, q);
}

// Fifty periods of the excitation: stable oscillations, the rod held upright, tumbling.
void long_motion_cases(std::ostream& out) {
  for (const std::vector<double>& start :
       std::vector<std::vector<double>>{{1, 9.81, 0.05, 7.672, 0.1, 0.1, 0},
                                        {0.5, 9.81, 0.02, 12, 0, 0.5, -1},
                                        {1, 9.81, 0.2, 40, 0.5, 3, 0},
                                        {1, 9.81, 0.1, 25, 0, 1, 3},
                                        {1, 9.81, 0.1, 14, 0.1, 2.5, 1}}) {
    std::vector<double> row = start;
    row.push_back(100 * std::numbers::pi / start[3]);
    out << join(row);
  }
}

// Random cells of charts of kBoxPoints x kBoxPoints points, by the formula for their axes
// (src/chart/axis.cpp).
constexpr int kBoxPoints = 2048, kBoxCells = 2000;
void box_cases(std::ostream& out, std::uint64_t seed, const std::array<double, 2>& x,
               const std::array<double, 2>& y) {
  std::mt19937_64 cells(seed);
  const auto value = [](const std::array<double, 2>& ends, std::uint64_t place) {
    if (place == 0) return ends[0];
    if (place == kBoxPoints - 1) return ends[1];
    return std::lerp(ends[0], ends[1], double(place) / double(kBoxPoints - 1));
  };
  for (int k = 0; k < kBoxCells; ++k) {
    const std::uint64_t column = cells() >> 53, row = cells() >> 53;  // 11 bits
    out << column << ',' << row << ',' << join({value(x, column), value(y, row)});
  }
}
void mathieu_box_cases(std::ostream& out) { box_cases(out, 1831, {-50, 200}, {0, 200}); }
// The rod of 1 m: omega/alpha in [0.1, 50], amplitude/length in [0, 0.5]. alpha is rounded.
void pendulum_box_cases(std::ostream& out) {
  const double alpha = std::sqrt(1.5 * 9.81);
  box_cases(out, 1868, {0.1 * alpha, 50 * alpha}, {0, 0.5});
}

}  // namespace

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : ".";
  const auto write = [&](const char* kind, void (*cases)(std::ostream&)) {
    std::ofstream out(folder + "/" + kind + ".in");
    cases(out);
  };
  write("mathieu", mathieu_cases);
  write("hill", hill_cases);
  write("square", square_cases);
  write("pendulum", pendulum_cases);
  write("linear4", linear4_cases);
  write("motion", motion_cases);
  write("characteristic", characteristic_cases);
  write("long_motion", long_motion_cases);
  write("mathieu_box", mathieu_box_cases);
  write("pendulum_box", pendulum_box_cases);
}
