#include "support/models.hpp"

#include <cmath>
#include <random>

namespace strutt::test {
namespace {

using Eigen::MatrixXd;

MatrixXd symmetric(double a, double b, double c) { return MatrixXd{{a, b}, {b, c}}; }

LinearPeriodicSystem two_pendulums(double epsilon) {
  LinearPeriodicSystem system;
  system.period = 2.6;
  system.mass = symmetric(1.0, 0.2, 1.5);
  system.stiffness = {symmetric(2.0, -0.3, 3.1),
                      {{1, symmetric(0.4, 0.7, -0.2) * epsilon, symmetric(0.0, 0.3, 0.1) * epsilon}}};
  return system;
}

void add_hill_equations(std::vector<ModelCase>& table) {
  const auto add = [&](const char* name, const HillEquation& equation) {
    table.push_back({name, equation, true});
  };
  add("Mathieu", mathieu_delta_epsilon(1.0, 0.5));
  add("Mathieu, growing", mathieu_delta_epsilon(-0.4, 2.0));
  add("Mathieu, many turns", mathieu_delta_epsilon(40.0, 15.0, 0.02));
  add("Mathieu (a, q), damped", mathieu_a_q(3.0, 1.5, 0.1));
  add("Mathieu, epsilon = 0", mathieu_delta_epsilon(0.3, 0.0));
  add("Mathieu, epsilon tiny", mathieu_delta_epsilon(0.3, 1e-300));
  add("Mathieu, all tiny", mathieu_delta_epsilon(1e-12, -1e-12, 1e-12));
  add("Hill, no symmetry",
      hill_equation(1.7, PeriodicFunction::fourier(2.0, {{1, 0.7, 0.2}, {2, -0.3, 0.9}, {5, 0.1, 0.4}})));
  add("Hill, no symmetry, damped",
      hill_equation(1.7, PeriodicFunction::fourier(2.0, {{1, 0.7, 0.2}, {2, -0.3, 0.9}}), 0.3));
  add("Meissner", hill_equation(3.0, PeriodicFunction::square(1.0, 3.0, 0.0)));
  add("Meissner, damped", hill_equation(3.0, PeriodicFunction::square(-0.2, 1.3, 0.0), 0.4));
  const auto rod = PhysicalPendulum::uniform_rod(1.0, 1.0, 9.81, 0.1);
  const auto sine = sinusoidal_support(0.1, 7.0, 0.4), square = square_acceleration_support(0.05, 20.0, 1.0);
  for (const auto about : {Equilibrium::hanging, Equilibrium::inverted}) {
    add(about == Equilibrium::hanging ? "rod, hanging" : "rod, inverted",
        linearise(rod, about, &sine).equation);
    add("rod, square acceleration", linearise(rod, about, &square).equation);
    add("rod, fixed support", linearise(rod, about, nullptr).equation);
  }
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 4; ++i) {
    std::vector<Harmonic> harmonics;
    for (int k = 1; k <= 4; ++k) harmonics.push_back({k, any(random), any(random)});
    add("Hill, random",
        hill_equation(2.0 + any(random), PeriodicFunction::fourier(3.0 * any(random), harmonics),
                      0.3 * (i % 2)));
  }
}

void add_systems(std::vector<ModelCase>& table) {
  table.push_back({"4 states, symmetric", two_pendulums(1.0), true});
  table.push_back({"4 states, constant", two_pendulums(0.0), true});
  table.push_back({"4 states, tiny excitation", two_pendulums(1e-300), true});
  auto system = two_pendulums(1.0);
  system.damping.mean = 0.25 * system.mass;
  table.push_back({"4 states, proportional damping", system, true});
  system.damping.mean = MatrixXd{{0.3, -0.1}, {0.2, 0.05}};
  table.push_back({"4 states, general damping", system, false});
  system.damping.harmonics = {{2, {}, MatrixXd{{0.1, 0.3}, {0.0, -0.4}}}};
  table.push_back({"4 states, periodic damping", system, false});
  system.damping = {MatrixXd{{0.0, 0.6}, {-0.6, 0.0}}, {}};
  table.push_back({"4 states, gyroscopic", system, true});
  system = two_pendulums(1.0);
  system.stiffness.harmonics.push_back({2, MatrixXd{{0.0, 0.5}, {-0.5, 0.0}}, {}});
  table.push_back({"4 states, circulatory", system, false});
  std::mt19937_64 random(13);
  for (int i = 0; i < 2; ++i) {
    const auto any = [&] {
      return MatrixXd(
          MatrixXd::NullaryExpr(2, 2, [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); }));
    };
    system.mass = 2.0 * MatrixXd::Identity(2, 2) + any();
    system.stiffness = {any(), {{1, any(), any()}, {3, any(), {}}}};
    system.damping = {any(), {}};
    table.push_back({"4 states, random", system, false});
  }
}

PeriodicMatrix shifted(PeriodicMatrix matrix, double phase) {
  const MatrixXd zero = MatrixXd::Zero(matrix.mean.rows(), matrix.mean.cols());
  for (auto& h : matrix.harmonics) {
    const double c = std::cos(h.order * phase), s = std::sin(h.order * phase);
    const MatrixXd cosine = h.cosine.size() > 0 ? h.cosine : zero, sine = h.sine.size() > 0 ? h.sine : zero;
    h.cosine = c * cosine + s * sine;
    h.sine = c * sine - s * cosine;
  }
  return matrix;
}

}  // namespace

std::vector<ModelCase> every_model() {
  std::vector<ModelCase> table;
  add_hill_equations(table);
  add_systems(table);
  return table;
}

HillEquation over_two_periods(const HillEquation& equation) {
  std::vector<Harmonic> harmonics;
  for (const auto& h : equation.coefficient.harmonics())
    harmonics.push_back({2 * h.order, 4.0 * h.cosine, 4.0 * h.sine});
  return {equation.angular_frequency / 2.0, equation.damping,
          PeriodicFunction::fourier(4.0 * equation.coefficient.mean(), harmonics),
          equation.coefficient_error};
}

LinearPeriodicSystem over_two_periods(LinearPeriodicSystem system) {
  system.period *= 2.0;
  for (auto& h : system.stiffness.harmonics) h.order *= 2;
  for (auto& h : system.damping.harmonics) h.order *= 2;
  return system;
}

HillEquation shifted(HillEquation equation, double phase) {
  equation.coefficient = equation.coefficient.shifted(phase);
  equation.coefficient_error += (4.0 + equation.coefficient.highest_order() * std::abs(phase)) * 0x1p-53;
  return equation;
}

LinearPeriodicSystem shifted(LinearPeriodicSystem system, double phase) {
  system.stiffness = shifted(system.stiffness, phase);
  system.damping = shifted(system.damping, phase);
  return system;
}

bool is_constant(const LinearModel& model) {
  if (const auto* equation = std::get_if<HillEquation>(&model)) return equation->coefficient.is_constant();
  const auto& system = std::get<LinearPeriodicSystem>(model);
  return system.stiffness.is_constant() && system.damping.is_constant();
}

}  // namespace strutt::test
