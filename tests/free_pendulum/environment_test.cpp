// What the host program does to the floating-point unit changes no closed form.
#include <cmath>
#include <numbers>

#include "strutt/free_pendulum/elliptic.hpp"
#include "strutt/free_pendulum/free_motion.hpp"
#include "strutt/free_pendulum/frequency_series.hpp"
#include "strutt/free_pendulum/krylov.hpp"
#include "strutt/free_pendulum/normal_form.hpp"
#include "strutt/free_pendulum/period_formulas.hpp"
#include "strutt/free_pendulum/phase_portrait.hpp"
#include "support/any_environment.hpp"

namespace strutt::test::environment_test {

namespace {

constexpr double kAmplitudes[] = {0.0, 1e-310, 1e-160, 0.3, 1.0, 2.5, 3.14, 3.141592653589793};
constexpr double kExcesses[] = {-4.0, -3.9, -1e-310, 1e-310, 0.7, 1e300};

void add(Numbers& numbers, const Period& p) {
  numbers.insert(numbers.end(), {p.ratio, p.period, p.quarter, p.error});
}

Numbers of_periods() {
  Numbers numbers(std::size(kAmplitudes)), from_top = numbers;
  const Eigenfrequency alpha = eigenfrequency({.length = 0.7});
  period_ratios(kAmplitudes, numbers);
  period_ratios_from_top(kAmplitudes, from_top);
  numbers.insert(numbers.end(), from_top.begin(), from_top.end());
  for (const double a : kAmplitudes) {
    numbers.insert(numbers.end(), {period_ratio(a), period_ratio_from_top(a)});
    add(numbers, period_of_amplitude(a, alpha));
    add(numbers, period_of_from_top(a, alpha));
    add(numbers, CheapestPeriod(1e-6).of_amplitude(a, alpha));
  }
  for (const double e : kExcesses) {
    add(numbers, period_of_excess(e, alpha));
    const auto slope = period_ratio_slope_magnitude(e);
    numbers.insert(numbers.end(), {slope.value, slope.error});
  }
  const auto libration = libration_of_period_ratio(1.7);
  const auto flight = libration_time_of_flight(2.0, 0.4, alpha),
             turn = rotation_time_of_flight(1e-5, 7.0, alpha);
  numbers.insert(numbers.end(),
                 {libration.amplitude, libration.from_top, flight.value, turn.value, turn.error});
  return numbers;
}

Numbers of_motions() {
  Numbers numbers;
  const Eigenfrequency alpha = eigenfrequency({.length = 0.7});
  for (const double angle : {1e-310, 1e-3, 2.0})
    for (const double velocity : {0.0, 1e-310, 3.0, 9.1}) {
      const FreeMotion motion(alpha, angle, velocity);
      for (const double t : {1e-310, 0.3, 1e9}) {
        const auto state = motion.at(t);
        numbers.insert(numbers.end(), {state.angle, state.velocity, state.error});
      }
      const auto energy = energy_integral(angle, velocity);
      numbers.insert(numbers.end(), {energy.separatrix_excess, energy.amplitude, energy.from_top});
    }
  for (const auto& curve : phase_portrait({.cells = 1, .points = 9}))
    for (const auto& point : curve.points) numbers.insert(numbers.end(), {point.angle, point.velocity});
  return numbers;
}

Numbers of_formulas() {
  Numbers numbers;
  for (const double k : {1e-310, 1e-8, 0.3, 1.0}) {
    const ComplementaryModulus modulus(k);
    const auto jacobi = jacobi_functions(0.37, modulus);
    numbers.insert(numbers.end(), {complete_integral(modulus), complete_integral_second_kind(modulus),
                                   incomplete_integral(0.9, modulus), jacobi.sn, jacobi.cn, jacobi.dn,
                                   arithmetic_geometric_mean(1.0, k)});
  }
  for (const double a : {1e-3, 0.5, 2.0}) {
    for (const auto formula : {PeriodMethod::normal_form, PeriodMethod::krylov, PeriodMethod::series}) {
      const auto found = formula_of_amplitude(formula, a);
      numbers.insert(numbers.end(), {found.ratio, found.relative_error});
    }
    const KrylovMotion motion(KrylovVariant::frequency, 3.7, a);
    numbers.insert(numbers.end(), {motion.period(), motion.angle(0.3), motion.velocity(0.3),
                                   cubic_period_ratio(a), linear_amplitude(3.7, a, 0.2)});
  }
  const auto series = pendulum_frequency_series(8);
  const auto value = evaluate(series.period, std::numbers::pi, 1.0);
  numbers.insert(numbers.end(), {value.value, value.error, largest_amplitude(PeriodMethod::krylov, 1e-7)});
  PlanarCoefficients system{.alpha = 1.3, .f1 = {}, .f2 = {}};
  system.f1 = {.c20 = 0.2, .c11 = 0.1, .c30 = 0.3, .c03 = 0.7};
  system.f2 = {.c02 = -0.4, .c21 = 0.3};
  const auto form = normal_form(system);
  numbers.insert(numbers.end(), {form.delta, form.beta, normal_form_period(form, 0.3)});
  return numbers;
}

}  // namespace

TEST_CASE("closed forms of the free pendulum do not depend on the environment of the host",
          "[free_pendulum][extreme][N35][N49]") {
  SECTION("periods") { check_same(of_periods); }
  SECTION("motions and portraits") { check_same(of_motions); }
  SECTION("elliptic functions and formulas") { check_same(of_formulas); }
}

}  // namespace strutt::test::environment_test
