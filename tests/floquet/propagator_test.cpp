// M is the propagator over one period: against the equation as it stands, against itself over two periods,
// and against the matrix exponential, within the error bounds that the results themselves state.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

#include "floquet/every_model.hpp"

namespace strutt::test::propagator_test {

using Eigen::MatrixXd;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 0x1p-53;

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// exp(A T) of a constant model for the state (q, q'/kappa), in long double.
LongMatrix exponential(const LinearModel& model, long double kappa) {
  LongMatrix stiffness, damping;
  long double period = 2.0L * std::numbers::pi_v<long double>;
  if (const auto* equation = std::get_if<HillEquation>(&model)) {  // over one turn of the phase
    stiffness = LongMatrix::Constant(1, 1, equation->delta());
    damping =
        LongMatrix::Constant(1, 1, static_cast<long double>(equation->damping) / equation->angular_frequency);
    kappa /= equation->angular_frequency;
  } else {
    const auto& system = std::get<LinearPeriodicSystem>(model);
    const LongMatrix inverse = system.mass.cast<long double>().inverse();
    stiffness = inverse * system.stiffness.mean.cast<long double>();
    damping = system.has_damping() ? LongMatrix(inverse * system.damping.mean.cast<long double>())
                                   : LongMatrix(LongMatrix::Zero(stiffness.rows(), stiffness.cols()));
    period = system.period;
  }
  const Eigen::Index d = stiffness.rows();
  LongMatrix a = LongMatrix::Zero(2 * d, 2 * d);
  a.topRightCorner(d, d).diagonal().setConstant(kappa);
  a.bottomLeftCorner(d, d) = -stiffness / kappa;
  a.bottomRightCorner(d, d) = -damping;
  return (a * period).exp();
}

/// Both sides of a first-order form of the equation as the scene has it: time, (q, q'), column by column.
Integrator::PiecewiseRightHandSide equation_of(const LinearModel& model) {
  if (const auto* equation = std::get_if<HillEquation>(&model)) {
    return [e = *equation](double t, double interior, StateView y, StateOut dydt) {
      const double omega = e.angular_frequency,
                   w = omega * omega * e.coefficient.piece(omega * interior)(omega * t);
      for (const int column : {0, 2}) {
        dydt[column] = y[column + 1];
        dydt[column + 1] = -e.damping * y[column + 1] - w * y[column];
      }
    };
  }
  return [s = std::get<LinearPeriodicSystem>(model)](double t, double, StateView y, StateOut dydt) {
    const Eigen::Index d = s.degrees_of_freedom(), n = s.states();
    const auto at = [&](const PeriodicMatrix& matrix) {
      MatrixXd sum = matrix.mean.size() > 0 ? matrix.mean : MatrixXd(MatrixXd::Zero(d, d));
      for (const auto& h : matrix.harmonics) {
        const double angle = h.order * 2.0 * kPi * t / s.period;
        if (h.cosine.size() > 0) sum += h.cosine * std::cos(angle);
        if (h.sine.size() > 0) sum += h.sine * std::sin(angle);
      }
      return sum;
    };
    const auto state = y.reshaped(n, n);
    auto rate = dydt.reshaped(n, n);
    rate.topRows(d) = state.bottomRows(d);
    rate.bottomRows(d) =
        -s.mass.inverse() * (at(s.damping) * state.bottomRows(d) + at(s.stiffness) * state.topRows(d));
  };
}

/// M for (q, q') by one plain integration over the period in the scene's time.
MatrixXd integrated(const LinearModel& model, int states) {
  double period = 0.0;
  std::vector<double> jumps;
  if (const auto* equation = std::get_if<HillEquation>(&model)) {
    period = equation->period();
    for (const double theta : equation->coefficient.breakpoints(0.0, 2.0 * kPi))
      jumps.push_back(theta / equation->angular_frequency);
  } else {
    period = std::get<LinearPeriodicSystem>(model).period;
  }
  Integrator integrator(states * states, {.relative_tolerance = 1e-13, .absolute_tolerance = 1e-13});
  const Eigen::VectorXd identity = MatrixXd::Identity(states, states).reshaped();
  const auto run = integrator.trajectory(equation_of(model), 0.0, identity, std::vector{period}, jumps);
  CHECK(run.result.outcome == Outcome::converged);
  return run.states.col(0).reshaped(states, states);
}

}  // namespace

TEST_CASE("M is the propagator of the equation as it stands", "[floquet][law]") {
  on_every_model([](const ModelCase& entry, Method, const Monodromy& m) {
    auto value = plain(m.matrix);
    const Eigen::Index n = value.value.rows(), d = n / 2;
    auto direct = integrated(entry.model, static_cast<int>(n));
    direct.topRightCorner(d, d) *= m.kappa;
    direct.bottomLeftCorner(d, d) /= m.kappa;
    // the plain integration is good to 1e-11 of the largest entry
    const double allowed = 1e-11 * std::max(1.0, value.value.cwiseAbs().maxCoeff());
    CHECK(((value.value - direct).cwiseAbs() - value.error).maxCoeff() <= allowed);
  });
}

TEST_CASE("M over two periods is M squared", "[floquet][law]") {
  on_every_model([](const ModelCase& entry, Method method, const Monodromy& once) {
    const auto* equation = std::get_if<HillEquation>(&entry.model);
    if (equation != nullptr && !equation->coefficient.is_constant() &&
        equation->coefficient.harmonics().empty())
      return;
    const auto twice = computed(
        std::visit([](const auto& e) { return LinearModel(over_two_periods(e)); }, entry.model), method);
    const auto m = plain(once.matrix), longer = plain(twice.matrix);
    const MatrixXd size = m.value.cwiseAbs();
    MatrixXd square = m.value * m.value;
    MatrixXd allowed = (size + m.error) * (size + m.error) - size * size + 8.0 * kUnit * size * size;
    // to the scaled state of the other: kappa may differ
    const Eigen::Index d = size.rows() / 2;
    const double ratio = once.kappa / twice.kappa;
    for (auto* scaled : {&square, &allowed}) {
      scaled->topRightCorner(d, d) /= ratio;
      scaled->bottomLeftCorner(d, d) *= ratio;
    }
    CHECK(((square - longer.value).cwiseAbs() - allowed - longer.error).maxCoeff() <= 0.0);
  });
}

TEST_CASE("Constant coefficients have the matrix exponential", "[floquet][law][known]") {
  int count = 0;
  const auto check = [&count](const LinearModel& model, const Monodromy& m) {
    const auto value = plain(m.matrix);
    const LongMatrix truth = exponential(model, m.kappa);
    const MatrixXd distance = (truth - value.value.cast<long double>()).cwiseAbs().cast<double>();
    // of a rounded model the truth is uncertain by its own coefficients, which m.error contains
    CHECK((distance - value.error).maxCoeff() <= 4.0 * kUnit * value.value.cwiseAbs().maxCoeff());
    ++count;
  };
  on_every_model([&](const ModelCase& entry, Method, const Monodromy& m) {
    if (is_constant(entry.model)) check(entry.model, m);
  });
  CHECK(count >= 11);
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  for (int i = 0; i < 12; ++i) {
    LinearPeriodicSystem system;
    const auto matrix = [&] { return MatrixXd(MatrixXd::NullaryExpr(2, 2, [&] { return any(random); })); };
    system.period = 2.0;
    system.mass = 3.0 * MatrixXd::Identity(2, 2) + matrix();
    system.stiffness.mean = matrix() * (i % 3 == 0 ? 1e-9 : 4.0);
    if (i % 2 == 0) system.damping.mean = matrix();
    for (const auto method : {Method::propagator, Method::arkode, Method::cvode}) {
      check(system, computed(system, method));
    }
  }
}

}  // namespace strutt::test::propagator_test
