#pragma once

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <vector>

/// The free pendulum in 100 digits, each quantity by two methods that share no mathematics.
namespace exact {

using Real = boost::multiprecision::cpp_bin_float_100;
using Real50 = boost::multiprecision::cpp_bin_float_50;

template <typename R>
R pi() {
  return boost::math::constants::pi<R>();
}

template <typename R>
R agm(R a, R b) {
  const R enough = sqrt(std::numeric_limits<R>::epsilon());
  while (abs(a - b) > enough * a) {
    const R mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return (a + b) / 2;
}

/// T/T0 of the complementary modulus k', first method: the arithmetic-geometric mean.
template <typename R>
R ratio_by_agm(const R& k_prime) {
  return 1 / agm(R(1), k_prime);
}

/// Second method: the hypergeometric series in k^2, or the logarithmic series in k'^2,
///   (2/pi) K = (2/pi) sum ((1/2)_n/n!)^2 k'^(2n) (ln(1/k') + d_n), d_0 = 2 ln 2, d_n = d_(n-1) - 1/(n (2n -
///   1)).
template <typename R>
R ratio_by_series(const R& k_prime) {
  const bool near_top = k_prime < R(0.7);
  const R x = near_top ? R(k_prime * k_prime) : R((1 - k_prime) * (1 + k_prime));
  const R logarithm = near_top ? R(-log(k_prime)) : R(0);
  R factor = 1, shift = 2 * log(R(2)), sum = 0;
  for (int n = 0; n < 2000; ++n) {
    const R term = near_top ? R(factor * (logarithm + shift) * 2 / pi<R>()) : factor;
    sum += term;
    if (abs(term) < std::numeric_limits<R>::epsilon() * sum) break;
    const R ratio = R(2 * n + 1) / (2 * n + 2);
    factor *= ratio * ratio * x;
    shift -= R(1) / (R(n + 1) * (2 * n + 1));
  }
  return sum;
}

/// One unit in the last place of the double that is nearest to x.
template <typename R>
double ulp(const R& x) {
  const double value = std::abs(static_cast<double>(x));
  return std::nextafter(value, std::numeric_limits<double>::infinity()) - value;
}

template <typename R>
double error_in_ulp(double value, const R& truth) {
  return static_cast<double>(R(abs(R(value) - truth) / ulp(truth)));
}

struct State {
  Real angle, velocity;  // velocity = phi'/alpha
};

/// phi(tau) in closed form with the library functions of Boost.Math. Not for the separatrix.
inline State by_functions(const Real& angle, const Real& velocity, const Real& tau) {
  const Real two_pi = 2 * pi<Real>();
  const Real turns = round(angle / two_pi);
  const Real half = (angle - turns * two_pi) / 2;
  const Real s = sin(half), c = cos(half);
  const Real excess = (velocity - 2 * c) * (velocity + 2 * c);
  const Real w = sqrt(velocity * velocity + 4 * s * s);
  if (w == 0) return {angle, Real(0)};
  Real cn, dn;
  if (excess < 0) {
    const Real k = w / 2;
    const Real psi = atan2(s / k, velocity / (2 * k));
    const Real sn = boost::math::jacobi_elliptic(k, Real(tau + boost::math::ellint_1(k, psi)), &cn, &dn);
    return {turns * two_pi + 2 * asin(Real(k * sn)), 2 * k * cn};
  }
  const Real k = 2 / w, sign = velocity < 0 ? -1 : 1;
  const Real u = w * tau / 2 + boost::math::ellint_1(k, Real(sign * half));
  const Real quarter = pi<Real>() / (2 * agm(Real(1), Real(sqrt(excess) / w)));
  const Real sn = boost::math::jacobi_elliptic(k, u, &cn, &dn);
  const Real revolutions = round(u / (4 * quarter));
  return {turns * two_pi + sign * (2 * atan2(sn, cn) + 2 * two_pi * revolutions), sign * w * dn};
}

/// Taylor series of phi'' = -sin phi, `steps` of tau/steps.
inline State by_taylor(const Real& angle, const Real& velocity, const Real& tau, int steps) {
  constexpr int kTerms = 70;
  const Real h = tau / steps;
  State state{angle, velocity};
  std::vector<Real> p(kTerms + 2), s(kTerms + 1), c(kTerms + 1);
  for (int step = 0; step < steps; ++step) {
    p[0] = state.angle;
    p[1] = state.velocity * h;
    s[0] = sin(state.angle);
    c[0] = cos(state.angle);
    for (int n = 0; n < kTerms; ++n) {
      p[n + 2] = -h * h * s[n] / ((n + 1) * (n + 2));
      s[n + 1] = c[n + 1] = 0;
      for (int j = 0; j <= n; ++j) {
        s[n + 1] += (j + 1) * p[j + 1] * c[n - j];
        c[n + 1] -= (j + 1) * p[j + 1] * s[n - j];
      }
      s[n + 1] /= n + 1;
      c[n + 1] /= n + 1;
    }
    state = {Real(0), Real(0)};
    for (int n = kTerms + 1; n >= 0; --n) {
      state.angle += p[n];
      state.velocity += n * p[n] / h;
    }
  }
  return state;
}

}  // namespace exact
