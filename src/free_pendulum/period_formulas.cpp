#include "strutt/free_pendulum/period_formulas.hpp"

#include <algorithm>
#include <cmath>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "base/minimum.hpp"
#include "free_pendulum/agm.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/free_pendulum/frequency_series.hpp"
#include "strutt/free_pendulum/krylov.hpp"

namespace strutt {
namespace {

// In units of 2^-53: formula 4, its amplitude rounded from another input 3 (the formulas are used where their
// ratio changes by less than 3 times the relative change of the amplitude), T0 and T = ratio T0 2; one to
// spare for the rounding of the error.
constexpr double kFormulaRounding = 11.0 * kUnit;
constexpr int kSeriesOrder = 14;
constexpr double kSeriesReach = 0.1;  // (0.1/pi)^12 = 1e-18 is cut off
constexpr int kRemainderOrder = 26;
constexpr double kRemainderReach = 0.3;  // (0.3/pi)^14 = 5e-15 of the remainder is cut off

const DoubleDouble kOne = 1.0;

/// A libration in twice the working precision; k' = cos(amplitude/2).
struct Libration {
  DoubleDouble amplitude, k_prime;
};

Libration from_amplitude(double amplitude) { return {amplitude, sin_cos(0.5 * amplitude).cosine}; }

Libration from_top_angle(double from_top) {
  return {kPi - DoubleDouble(from_top), sin_cos(0.5 * from_top).sine};
}

Libration from_excess(double excess) {
  const DoubleDouble k = ldexp(sqrt(two_sum(4.0, excess)), -1);
  const DoubleDouble k_prime = ldexp(sqrt(DoubleDouble(-excess)), -1);
  return {ldexp(atan2(k, k_prime), 1), k_prime};
}

/// The terms from A^4 on, over A^4, of omega/alpha = 1 - A^2/16 + ... and of its square 1 - A^2/8 + ...
struct FrequencyTails {
  std::array<double, kSeriesOrder - 3> frequency{}, square{};

  FrequencyTails() {
    const auto series = pendulum_frequency_series(kSeriesOrder).frequency;
    for (std::size_t n = 4; n <= kSeriesOrder; ++n) {
      frequency[n - 4] = series[n].value;
      for (std::size_t i = 0; i <= n; ++i) square[n - 4] += series[i].value * series[n - i].value;
    }
  }

  template <std::size_t N>
  static double sum(const std::array<double, N>& tail, double amplitude) {
    double value = 0.0;
    for (auto term = tail.rbegin(); term != tail.rend(); ++term) value = std::fma(value, amplitude, *term);
    return value * amplitude * amplitude * amplitude * amplitude;
  }
};

/// Coefficients of A^2, A^4, ... A^12 in the period, exact as quotients.
constexpr double kPeriodSeries[][2] = {{1.0, 16.0},
                                       {11.0, 3072.0},
                                       {173.0, 737280.0},
                                       {22931.0, 1321205760.0},
                                       {1319183.0, 951268147200.0},
                                       {233526463.0, 2009078326886400.0}};
constexpr std::size_t kFirstLeftOut = 14;

template <typename Number>
Number series_ratio(const Number& amplitude) {
  const Number square = amplitude * amplitude;
  Number sum = 0.0;
  for (auto k = std::size(kPeriodSeries); k-- > 0;)
    sum = square * (Number(kPeriodSeries[k][0]) / Number(kPeriodSeries[k][1]) + sum);
  return Number(1.0) + sum;
}

/// -(what is left out)/exact.
double series_error(const Libration& orbit) {
  const DoubleDouble frequency = AgmSteps(1.0, orbit.k_prime).mean();
  if (orbit.amplitude.hi >= kRemainderReach) return (series_ratio(orbit.amplitude) * frequency - kOne).hi;
  static const auto period = pendulum_frequency_series(kRemainderOrder).period;
  double left_out = 0.0;
  for (std::size_t n = period.size(); n-- > kFirstLeftOut;)
    left_out = std::fma(left_out, orbit.amplitude.hi, period[n].value);
  return -left_out * std::pow(orbit.amplitude.hi, kFirstLeftOut) * frequency.hi;
}

/// gamma/alpha of the formula, or its square: 1 - A^2/16 or 1 - A^2/8.
DoubleDouble denominator(PeriodMethod formula, DoubleDouble amplitude) {
  const int exponent = formula == PeriodMethod::krylov_squared ? -3 : -4;
  return kOne - ldexp(amplitude * amplitude, exponent);
}

double error_by_series(PeriodMethod formula, double amplitude) {
  static const FrequencyTails tails;
  const double below = denominator(formula, amplitude).hi;
  if (formula != PeriodMethod::krylov_squared) return tails.sum(tails.frequency, amplitude) / below;
  const double squared = tails.sum(tails.square, amplitude) / below;  // (1 + error)^2 - 1
  return squared / (std::sqrt(1.0 + squared) + 1.0);
}

double relative_error(PeriodMethod formula, const Libration& orbit) {
  if (formula == PeriodMethod::series) return series_error(orbit);
  if (orbit.amplitude.hi < kSeriesReach) return error_by_series(formula, orbit.amplitude.hi);
  const DoubleDouble below = denominator(formula, orbit.amplitude);
  const DoubleDouble gamma = formula == PeriodMethod::krylov_squared ? sqrt(below) : below;
  return ((AgmSteps(1.0, orbit.k_prime).mean() - gamma) / gamma).hi;
}

double ratio_of(PeriodMethod formula, double amplitude) {
  if (formula == PeriodMethod::series) return series_ratio(amplitude);
  if (formula == PeriodMethod::normal_form) return 1.0 / ((1.0 - amplitude / 4.0) * (1.0 + amplitude / 4.0));
  return krylov_period_ratio(
      formula == PeriodMethod::krylov ? KrylovVariant::frequency : KrylovVariant::frequency_squared,
      amplitude);
}

bool has_meaning(PeriodMethod formula, double amplitude) {
  return amplitude < krylov_limit(formula == PeriodMethod::krylov_squared ? KrylovVariant::frequency_squared
                                                                          : KrylovVariant::frequency);
}

FormulaError formula_of(PeriodMethod formula, const Libration& orbit) {
  if (!has_meaning(formula, orbit.amplitude.hi)) return {kNaN, kNaN};
  return {ratio_of(formula, orbit.amplitude.hi), relative_error(formula, orbit)};
}

void check_formula(PeriodMethod formula) {
  if (std::find(kPeriodFormulas.begin(), kPeriodFormulas.end(), formula) == kPeriodFormulas.end())
    throw InvalidInput(std::string(to_string(formula)) + " is not an approximate formula of the period");
}

void check_tolerance(double tolerance) {
  require(tolerance > 0.0 && std::isfinite(tolerance), "tolerance", tolerance, "a positive number");
}

double error_at(PeriodMethod formula, double amplitude) {
  return relative_error(formula, from_amplitude(amplitude));
}

/// Where sign * error passes the tolerance upwards in [low, high], rounded down. The unknown is A^4, in which
/// the error is nearly straight at first.
double crossing(PeriodMethod formula, double tolerance, double sign, double low, double high) {
  const auto amplitude_of = [](double fourth) { return std::sqrt(std::sqrt(fourth)); };
  const auto excess = [&](double fourth) {
    return sign * error_at(formula, amplitude_of(fourth)) / tolerance - 1.0;
  };
  const auto fourth_of = [](double amplitude) { return amplitude * amplitude * amplitude * amplitude; };
  const double from = fourth_of(low), to = fourth_of(high);
  const double below = excess(from), above = excess(to);
  if (below >= 0.0) return low;
  if (above <= 0.0) return high;
  const boost::math::tools::eps_tolerance<double> done(51);
  double amplitude = amplitude_of(bracketed_zero(excess, from, to, below, above, done, 200).low);
  while (sign * error_at(formula, amplitude) > tolerance) amplitude = std::nextafter(amplitude, 0.0);
  return amplitude;
}

/// Maximum of the error of (31), which is its only one.
struct Peak {
  double amplitude, error;
};
Peak peak_of_31() {
  constexpr double kFrom = 1.5, kTo = 2.4;
  const auto falling = [](double amplitude) { return -error_at(PeriodMethod::krylov, amplitude); };
  const auto [amplitude, value] = least_between(falling, kFrom, kTo, 50);
  return {amplitude, -value};
}

}  // namespace

double formula_ratio(PeriodMethod formula, double amplitude) {
  const DefaultFloatingPoint environment;
  check_formula(formula);
  require(amplitude >= 0.0 && amplitude <= kPi.hi, "amplitude", amplitude, "from 0 to 3.141592653589793");
  return has_meaning(formula, amplitude) ? ratio_of(formula, amplitude) : kNaN;
}

FormulaError formula_of_amplitude(PeriodMethod formula, double amplitude) {
  const DefaultFloatingPoint environment;
  check_formula(formula);
  require(amplitude >= 0.0 && amplitude <= kPi.hi, "amplitude", amplitude, "from 0 to 3.141592653589793");
  return formula_of(formula, from_amplitude(amplitude));
}

FormulaError formula_of_from_top(PeriodMethod formula, double from_top) {
  const DefaultFloatingPoint environment;
  check_formula(formula);
  require(from_top >= 0.0 && from_top <= kPi.hi, "from_top", from_top, "from 0 to pi");
  if (from_top == 0.0) return {kNaN, kNaN};
  return formula_of(formula, from_top_angle(from_top));
}

FormulaError formula_of_excess(PeriodMethod formula, double separatrix_excess) {
  const DefaultFloatingPoint environment;
  check_formula(formula);
  const double e = separatrix_excess;
  require(e >= -4.0 && std::isfinite(e), "separatrix_excess", e, "finite and >= -4");
  if (e >= 0.0) return {kNaN, kNaN};
  return formula_of(formula, from_excess(e));
}

double largest_amplitude(PeriodMethod formula, double tolerance) {
  const DefaultFloatingPoint environment;
  check_formula(formula);
  check_tolerance(tolerance);
  if (formula == PeriodMethod::krylov_squared) {
    // One double below the limit the error is 1e7 or more; it grows all the way.
    const double limit = std::nextafter(krylov_limit(KrylovVariant::frequency_squared), 0.0);
    return crossing(formula, tolerance, 1.0, 0.0, limit);
  }
  if (formula == PeriodMethod::series) return crossing(formula, tolerance, -1.0, 0.0, kPi.hi);
  static const Peak peak = peak_of_31();
  if (tolerance < peak.error) return crossing(formula, tolerance, 1.0, 0.0, peak.amplitude);
  return crossing(formula, tolerance, -1.0, peak.amplitude, kPi.hi);
}

CheapestPeriod::CheapestPeriod(double tolerance) {
  const DefaultFloatingPoint environment;
  check_tolerance(tolerance);
  for (std::size_t i = 0; i < kPeriodFormulas.size(); ++i)
    reach_[i] = tolerance > kFormulaRounding
                    ? largest_amplitude(kPeriodFormulas[i], tolerance - kFormulaRounding)
                    : -1.0;
}

PeriodMethod CheapestPeriod::method(double amplitude) const {
  require(amplitude >= 0.0, "amplitude", amplitude, "a number >= 0");
  for (std::size_t i = 0; i < kPeriodFormulas.size(); ++i)
    if (amplitude <= reach_[i]) return kPeriodFormulas[i];
  return PeriodMethod::elliptic;
}

double CheapestPeriod::ratio(double amplitude) const {
  const DefaultFloatingPoint environment;
  require(amplitude >= 0.0 && amplitude <= kPi.hi, "amplitude", amplitude, "from 0 to 3.141592653589793");
  const PeriodMethod chosen = method(amplitude);
  return chosen == PeriodMethod::elliptic ? period_ratio(amplitude) : ratio_of(chosen, amplitude);
}

namespace {

/// The period of a libration by `method`; `exact` if that is the closed form.
Period period_by(PeriodMethod method, const Libration& orbit, const Period& exact,
                 const Eigenfrequency& alpha) {
  if (method == PeriodMethod::elliptic) return exact;
  const FormulaError formula = formula_of(method, orbit);
  const double period = formula.ratio * period_of_amplitude(0.0, alpha).period;
  return {formula.ratio, period, 0.25 * period, std::abs(formula.relative_error) + kFormulaRounding, method};
}

}  // namespace

Period CheapestPeriod::of_amplitude(double amplitude, const Eigenfrequency& alpha) const {
  const DefaultFloatingPoint environment;
  const Period exact = period_of_amplitude(amplitude, alpha);
  const PeriodMethod chosen = method(amplitude);
  return chosen == PeriodMethod::elliptic ? exact
                                          : period_by(chosen, from_amplitude(amplitude), exact, alpha);
}

Period CheapestPeriod::of_from_top(double from_top, const Eigenfrequency& alpha) const {
  const DefaultFloatingPoint environment;
  const Period exact = period_of_from_top(from_top, alpha);
  if (exact.method == PeriodMethod::separatrix) return exact;
  const Libration orbit = from_top_angle(from_top);
  return period_by(method(orbit.amplitude.hi), orbit, exact, alpha);
}

Period CheapestPeriod::of_excess(double separatrix_excess, const Eigenfrequency& alpha) const {
  const DefaultFloatingPoint environment;
  const Period exact = period_of_excess(separatrix_excess, alpha);
  if (separatrix_excess >= 0.0) return exact;
  const Libration orbit = from_excess(separatrix_excess);
  return period_by(method(orbit.amplitude.hi), orbit, exact, alpha);
}

}  // namespace strutt
