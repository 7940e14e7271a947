#pragma once

namespace strutt {

/// The modulus k in [0, 1] of an elliptic integral (not the parameter m = k^2, not the modular angle).
struct Modulus {
  double value;
  explicit constexpr Modulus(double k) : value(k) {}
};

/// The complementary modulus k' = sqrt(1 - k^2) in [0, 1]. Next to the separatrix k rounds to 1 and
/// everything is lost; k' = cos(amplitude/2) = sin(from_top/2) keeps its digits (numerical extremes N23, N24,
/// N32).
struct ComplementaryModulus {
  double value;
  explicit constexpr ComplementaryModulus(double k_prime) : value(k_prime) {}
};

/// sqrt((1 - k)(1 + k)), and back.
ComplementaryModulus complementary(Modulus k);
Modulus modulus(ComplementaryModulus k_prime);

// All functions compute in twice the working precision: relative errors <= 2^-53 (half an ulp) and a little
// for the inputs as given, over the whole range. Arguments outside the ranges, NaN included, throw
// InvalidInput. Method: arithmetic-geometric mean with Landen's and Gauss' transformations; Bulirsch, Numer.
// Math. 7 (1965) 78-90.

/// The arithmetic-geometric mean, a, b >= 0 and finite; 0 if one is 0.
double arithmetic_geometric_mean(double a, double b);

/// K = int_0^(pi/2) dx/sqrt(1 - k^2 sin^2 x) = pi/(2 AGM(1, k')), 0 <= k' <= 1; +inf for k' = 0.
double complete_integral(ComplementaryModulus k_prime);

/// E = int_0^(pi/2) sqrt(1 - k^2 sin^2 x) dx, 0 <= k' <= 1.
double complete_integral_second_kind(ComplementaryModulus k_prime);

/// F(psi) = int_0^psi dx/sqrt(1 - k^2 sin^2 x), |psi| <= 1e9, 0 < k' <= 1. For psi next to an odd multiple of
/// pi/2 and k' next to 0 it is psi that lacks the digits: use the time of flight (period.hpp), which starts
/// from the angle.
double incomplete_integral(double psi, ComplementaryModulus k_prime);

struct JacobiFunctions {
  double sn, cn, dn;
};

/// sn, cn and dn at the phase 4K * turns, 0 < k' <= 1, |turns| <= 2^52. The phase is counted in turns, so
/// that nothing is lost at late times (N28); dn = sqrt(k'^2 + k^2 cn^2) has full relative accuracy everywhere
/// (N29).
JacobiFunctions jacobi_functions(double turns, ComplementaryModulus k_prime);

}  // namespace strutt
