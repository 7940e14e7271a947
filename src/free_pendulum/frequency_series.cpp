#include "strutt/free_pendulum/frequency_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/constants.hpp"
#include "free_pendulum/lindstedt.hpp"
#include "free_pendulum/rational_series.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

std::size_t size_of(int order) {
  require(order >= 0, "order of the series", order, "0 or more");
  return static_cast<std::size_t>(order) + 1;
}

Rational rational(const Exact& x) {
  return {numerator(x).str(), denominator(x).str(), x.convert_to<double>()};
}

std::vector<Rational> rationals(const Series& series) {
  std::vector<Rational> result;
  for (const Exact& c : series) result.push_back(rational(c));
  return result;
}

/// T/T0 of V = phi^2/2 + ... (`potential` up to order + 2). By Lagrange's inversion coefficient n of
/// phi(xi), xi = phi S^(1/2), is 1/n times coefficient n - 1 of S^(-n/2).
Series period_by_energy(const Series& potential, std::size_t size) {
  Series shape(size);  // S = 2 V/phi^2 = 1 + ...
  for (std::size_t n = 0; n < size; ++n) shape[n] = 2 * potential[n + 2];
  Series by_energy((size - 1) / 2 + 1);  // T/T0 in powers of 2 E
  for (std::size_t n = 0; n < by_energy.size(); ++n) {
    const Series needed(shape.begin(), shape.begin() + static_cast<std::ptrdiff_t>(2 * n + 1));
    by_energy[n] = power(needed, -Exact(2 * n + 1) / 2).back() * binomial_central(static_cast<int>(n));
  }
  Series twice_energy(size);  // 2 V(A)
  for (std::size_t n = 0; n < size; ++n) twice_energy[n] = 2 * potential[n];
  return composition(by_energy, twice_energy);
}

/// The same by way of omega^2.
Series period_by_lindstedt(const Series& potential, int order) {
  Series force(potential.size() - 1);
  for (std::size_t n = 1; n < potential.size(); ++n) force[n - 1] = potential[n] * n;
  return power(lindstedt_frequency_squared(force, order), -Exact(1) / 2);
}

FrequencySeries series_of(const Series& potential, int order, SeriesMethod method) {
  const Series period = method == SeriesMethod::lindstedt
                            ? period_by_lindstedt(potential, order)
                            : period_by_energy(potential, static_cast<std::size_t>(order) + 1);
  return {.frequency = rationals(reciprocal(period)), .period = rationals(period)};
}

double estimated_radius(const FrequencySeries& series) {
  double radius = kInfinity;
  for (const auto* coefficients : {&series.frequency, &series.period}) {
    for (std::size_t n = std::max<std::size_t>(1, coefficients->size() / 2); n < coefficients->size(); ++n) {
      const double c = std::abs((*coefficients)[n].value);
      if (c > 0.0) radius = std::min(radius, std::pow(c, -1.0 / static_cast<double>(n)));
    }
  }
  return radius;
}

}  // namespace

FrequencySeries frequency_series(const std::vector<double>& potential, int order, SeriesMethod method) {
  const DefaultFloatingPoint environment;
  const std::size_t size = size_of(order);
  for (const double c : potential)
    require(std::isfinite(c), "coefficient of the potential", c, "a finite number");
  require(potential.size() > 2 && potential[2] > 0.0, "potential[2]",
          potential.size() > 2 ? potential[2] : 0.0, "positive: phi = 0 must be a minimum");
  for (const std::size_t n : {0, 1})
    require(potential[n] == 0.0, "potential[0] and potential[1]", potential[n],
            "zero: phi = 0 must be a minimum");
  Series exact(size + 2);
  const Exact scale = 2 * Exact(potential[2]);
  for (std::size_t n = 2; n < std::min(exact.size(), potential.size()); ++n)
    exact[n] = Exact(potential[n]) / scale;
  FrequencySeries series = series_of(exact, order, method);
  series.radius = estimated_radius(series);
  return series;
}

FrequencySeries pendulum_frequency_series(int order, SeriesMethod method) {
  const DefaultFloatingPoint environment;
  Series potential(size_of(order) + 2);  // 1 - cos(phi)
  Exact term = -1;
  for (std::size_t n = 2; n < potential.size(); n += 2) {
    term /= -static_cast<long>(n * (n - 1));
    potential[n] = term;
  }
  FrequencySeries series = series_of(potential, order, method);
  series.radius = std::numbers::pi;
  return series;
}

std::vector<Rational> pendulum_period_series(int order) {
  const DefaultFloatingPoint environment;
  Series modulus_squared(size_of(order));  // sin^2(A/2) = (1 - cos A)/2
  Exact term = -1;
  term /= 2;
  for (std::size_t n = 2; n < modulus_squared.size(); n += 2) {
    term /= -static_cast<long>(n * (n - 1));
    modulus_squared[n] = term;
  }
  Series hypergeometric(modulus_squared.size() / 2 + 1);
  for (std::size_t n = 0; n < hypergeometric.size(); ++n) {
    const Exact c = binomial_central(static_cast<int>(n));
    hypergeometric[n] = c * c;
  }
  return rationals(composition(hypergeometric, modulus_squared));
}

SeriesValue evaluate(const std::vector<Rational>& coefficients, double radius, double amplitude) {
  const DefaultFloatingPoint environment;
  require(radius > 0.0, "radius of convergence", radius, "a positive number");
  require(amplitude >= 0.0, "amplitude", amplitude, "A >= 0");
  const double q = radius == kInfinity ? 0.0 : amplitude / radius;
  if (!(q < 1.0) || !std::isfinite(amplitude))
    return {std::numeric_limits<double>::quiet_NaN(), kInfinity, Outcome::failed};

  const std::size_t size = coefficients.size();
  double sum = 0.0, absolute = 0.0, largest = 0.0;
  for (std::size_t n = size; n-- > 0;) {
    const double c = coefficients[n].value;
    sum = sum * amplitude + c;
    absolute = absolute * amplitude + std::abs(c);
    if (2 * n >= size && radius != kInfinity)
      largest = std::max(largest, std::abs(c) * std::pow(radius, static_cast<double>(n)));
  }
  // Horner's rule: 2 size operations, and the coefficients were rounded.
  const double rounding =
      (2.0 * static_cast<double>(size) + 1.0) * std::numeric_limits<double>::epsilon() * absolute;
  return {sum, largest * std::pow(q, static_cast<double>(size)) / (1.0 - q) + rounding};
}

}  // namespace strutt
