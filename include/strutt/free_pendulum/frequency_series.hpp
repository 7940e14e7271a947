#pragma once

#include <string>
#include <vector>

#include "strutt/base/outcome.hpp"

namespace strutt {

/// An exact rational number in lowest terms, denominator > 0, both in decimal.
struct Rational {
  std::string numerator = "0", denominator = "1";
  double value = 0.0;  ///< rounded to nearest, |value| up to the largest double

  friend bool operator==(const Rational&, const Rational&) = default;
};

/// Frequency and period of an oscillator as power series in its amplitude A, the turning point on the
/// positive side:
///
///     omega/omega0 = sum_n frequency[n] A^n,    T/T0 = sum_n period[n] A^n,    n = 0 ... order.
///
/// Coefficients are exact for the input taken as exact. For an even potential the odd ones vanish.
struct FrequencySeries {
  std::vector<Rational> frequency, period;
  /// Beyond this amplitude the series diverges: exact for the pendulum (pi, where the separatrix is);
  /// otherwise the smallest |c_n|^(-1/n) among the upper half of the coefficients of both series, an estimate
  /// from above (infinite if they vanish).
  double radius = 0.0;
};

/// Two ways that share only the arithmetic; they give the same rational numbers.
enum class SeriesMethod {
  /// xi = sqrt(2 V) sign(phi) makes phi(xi) = sum b_n xi^n; T/T0 = sum (2n+1) b_2n+1 binomial(2n, n)
  /// (V(A)/2)^n, after phi and t are scaled to V = phi^2/2 + ...: the period as an integral over the energy.
  /// Exact numbers of some 3 order digits: the pendulum to order 100 takes 0.3 s, to 200 8 s, to 400 3 min.
  energy_integral,
  /// phi = sum A^n phi_n(tau), tau = omega t, phi(0) = A, phi'(0) = 0; omega^2 is chosen order by order so
  /// that no resonant term is left. To order 40 4 s.
  lindstedt,
};

/// Series for phi'' = -V'(phi), V = potential[2] phi^2 + potential[3] phi^3 + ..., in Taylor coefficients of
/// V (no factorials): omega0^2 = 2 potential[2]. Missing coefficients are zero. The doubles are taken as
/// exact. Throws InvalidInput unless order >= 0, all coefficients are finite,
/// potential[0] = potential[1] = 0 and potential[2] > 0. Source: Landau & Lifshitz, Mechanics, sections 12
/// and 28; docs/normal-form.md.
FrequencySeries frequency_series(const std::vector<double>& potential, int order,
                                 SeriesMethod method = SeriesMethod::energy_integral);

/// The same for the pendulum phi'' = -alpha^2 sin(phi), whose coefficients 1/n! are exact rationals:
/// omega/alpha = 1 - A^2/16 + A^4/3072 - ..., T/T0 = 1 + A^2/16 + 11 A^4/3072 + ...
FrequencySeries pendulum_frequency_series(int order, SeriesMethod method = SeriesMethod::energy_integral);

/// The pendulum's T/T0 from 2 K(k)/pi = sum (binomial(2n, n)/4^n)^2 k^2n with k^2 = sin^2(A/2) expanded in A.
std::vector<Rational> pendulum_period_series(int order);

/// A truncated series at an amplitude.
struct SeriesValue {
  double value = 0.0;
  double error = 0.0;  ///< truncation and rounding, absolute
  Outcome outcome = Outcome::converged;
};

/// Sum of c_n A^n, n = 0 ... order. The truncation error is estimated by M q^(order+1)/(1 - q) with q =
/// A/radius and M the largest |c_n| radius^n in the upper half of the coefficients. It is an upper bound if
/// later coefficients obey M too, as those of the pendulum do (tested to order 100); for other oscillators it
/// is an estimate. A >= radius: value NaN, error infinite, outcome `failed`. Throws InvalidInput unless A >=
/// 0 and radius > 0.
SeriesValue evaluate(const std::vector<Rational>& coefficients, double radius, double amplitude);

}  // namespace strutt
