#include "strutt/free_pendulum/period_formulas.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/elliptic.hpp"
#include "strutt/free_pendulum/krylov.hpp"

namespace strutt {
namespace {

constexpr double kPi = std::numbers::pi;

/// 1 + A^2/16 + ..., the exact coefficients of pendulum_frequency_series(12).period.
double series_ratio(double amplitude) {
  constexpr double c[] = {1.0 / 16.0,
                          11.0 / 3072.0,
                          173.0 / 737280.0,
                          22931.0 / 1321205760.0,
                          1319183.0 / 951268147200.0,
                          233526463.0 / 2009078326886400.0};
  const double a = amplitude * amplitude;
  double sum = 0.0;
  for (auto k = std::size(c); k-- > 0;) sum = a * (c[k] + sum);
  return 1.0 + sum;
}

double krylov_ratio(double amplitude) { return krylov_period_ratio(KrylovVariant::frequency, amplitude); }
double squared_ratio(double amplitude) {
  return krylov_period_ratio(KrylovVariant::frequency_squared, amplitude);
}

/// One line per formula, the cheapest first: a division, six products and sums, a root and a division.
struct Formula {
  PeriodMethod method;
  double (*ratio)(double);
  double limit;
  bool monotone;  // its error
};
const std::array<Formula, 4> kFormulas{
    {{PeriodMethod::krylov, krylov_ratio, kPi, false},
     {PeriodMethod::normal_form, krylov_ratio, kPi, false},
     {PeriodMethod::series, series_ratio, kPi, true},
     {PeriodMethod::krylov_squared, squared_ratio, krylov_limit(KrylovVariant::frequency_squared), true}}};

const Formula& formula_of(PeriodMethod method) {
  const auto found = std::find_if(kFormulas.begin(), kFormulas.end(),
                                  [&](const Formula& formula) { return formula.method == method; });
  if (found == kFormulas.end()) {
    throw InvalidInput("formula", to_string(method), "one of normal_form, krylov, krylov_squared, series");
  }
  return *found;
}

double signed_error(const Formula& formula, double amplitude) {
  const double exact_frequency = arithmetic_geometric_mean(1.0, std::cos(0.5 * amplitude));
  return std::fma(formula.ratio(amplitude), exact_frequency, -1.0);
}

/// Where the error changes its course: its maximum if it has one, else the end.
double turning_point(const Formula& formula) {
  const double end = std::nextafter(formula.limit, 0.0);
  if (formula.monotone) return end;
  // The maximum of (31); its zero lies beyond.
  const auto descending = [&](double amplitude) { return -signed_error(formula, amplitude); };
  return boost::math::tools::brent_find_minima(descending, 1.0, 2.5, 26).first;
}

/// The crossing of a monotone error with `level` in [from, to]; `to` if there is none.
double crossing(const Formula& formula, double level, double from, double to) {
  const auto f = [&](double amplitude) { return signed_error(formula, amplitude) - level; };
  const double first = f(from), last = f(to);
  if (first == 0.0) return from;
  if (std::signbit(first) == std::signbit(last)) return to;
  std::uintmax_t most = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      f, from, to, first, last, boost::math::tools::eps_tolerance<double>(48), most);
  return low;
}

}  // namespace

std::span<const PeriodMethod> period_formulas() {
  static const auto methods = [] {
    std::array<PeriodMethod, kFormulas.size()> result{};
    std::transform(kFormulas.begin(), kFormulas.end(), result.begin(),
                   [](const Formula& f) { return f.method; });
    return result;
  }();
  return methods;
}

double formula_limit(PeriodMethod formula) { return formula_of(formula).limit; }

FormulaError formula_error(PeriodMethod method, double amplitude) {
  const Formula& formula = formula_of(method);
  require(amplitude >= 0.0 && amplitude <= kPi, "amplitude", amplitude, "0 to 3.141592653589793");
  return {formula.ratio(amplitude),
          signed_error(formula, amplitude)};  // the ratio refuses what is beyond the pole
}

double formula_reach(PeriodMethod method, double tolerance) {
  require(tolerance > 0.0, "tolerance", tolerance, "positive");
  const double level = tolerance - kFormulaRounding;
  if (!(level > 0.0)) return 0.0;
  const Formula& formula = formula_of(method);
  const double end = std::nextafter(formula.limit, 0.0), turn = turning_point(formula);
  const double top = signed_error(formula, turn);
  if (std::abs(top) > level) return crossing(formula, std::copysign(level, top), 0.0, turn);
  return turn < end ? crossing(formula, -std::copysign(level, top), turn, end) : end;
}

CheapestPeriod::CheapestPeriod(double tolerance) {
  for (const auto& formula : kFormulas) {
    const double reach = formula_reach(formula.method, tolerance);
    if (reach > 0.0) reaches_.push_back({formula.method, reach});
  }
}

PeriodMethod CheapestPeriod::method(double amplitude) const {
  for (const auto& reach : reaches_) {
    if (amplitude <= reach.amplitude) return reach.formula;
  }
  return PeriodMethod::elliptic;
}

Period CheapestPeriod::replace(const Period& exact, double amplitude, const Eigenfrequency& alpha) const {
  const PeriodMethod chosen = std::isfinite(exact.ratio) ? method(amplitude) : exact.method;
  if (chosen == exact.method) return exact;
  const FormulaError formula = formula_error(chosen, amplitude);
  const double period = 2.0 * kPi / alpha.value * formula.ratio;
  return {formula.ratio, period, 0.25 * period, std::abs(formula.relative_error) + kFormulaRounding, chosen};
}

}  // namespace strutt
