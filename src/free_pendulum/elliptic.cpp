#include "strutt/free_pendulum/elliptic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "free_pendulum/agm.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

double checked(ComplementaryModulus k_prime, bool zero_allowed) {
  const double k = k_prime.value;
  require((zero_allowed ? k >= 0.0 : k > 0.0) && k <= 1.0, "complementary modulus", k,
          zero_allowed ? "from 0 to 1" : "> 0 and <= 1");
  return k;
}

double other(double k) {
  return sqrt((DoubleDouble(1.0) - DoubleDouble(k)) * (DoubleDouble(1.0) + DoubleDouble(k))).hi;
}

}  // namespace

ComplementaryModulus complementary(Modulus k) {
  const DefaultFloatingPoint environment;
  require(k.value >= 0.0 && k.value <= 1.0, "modulus", k.value, "from 0 to 1");
  return ComplementaryModulus(other(k.value));
}

Modulus modulus(ComplementaryModulus k_prime) {
  const DefaultFloatingPoint environment;
  return Modulus(other(checked(k_prime, true)));
}

double arithmetic_geometric_mean(double a, double b) {
  const DefaultFloatingPoint environment;
  require(a >= 0.0 && std::isfinite(a), "a", a, "finite and >= 0");
  require(b >= 0.0 && std::isfinite(b), "b", b, "finite and >= 0");
  if (a == 0.0 || b == 0.0) return 0.0;
  // The first step by hand, scaled away from overflow and underflow.
  const double large = std::max(a, b), small = std::min(a, b);
  const int scale = large > 0x1p1000 ? -30 : large < 0x1p-500 ? 600 : 0;
  const DoubleDouble arithmetic =
      DoubleDouble(std::ldexp(large, scale - 1)) + DoubleDouble(std::ldexp(small, scale - 1));
  const DoubleDouble geometric = ldexp(sqrt(DoubleDouble(large)) * sqrt(DoubleDouble(small)), scale);
  return std::ldexp(AgmSteps(arithmetic, geometric).mean().hi, -scale);
}

double complete_integral(ComplementaryModulus k_prime) {
  const DefaultFloatingPoint environment;
  const double k = checked(k_prime, true);
  if (k == 0.0) return std::numeric_limits<double>::infinity();
  return (kPi / ldexp(AgmSteps(1.0, k).mean(), 1)).hi;
}

double complete_integral_second_kind(ComplementaryModulus k_prime) {
  const DefaultFloatingPoint environment;
  const double k = checked(k_prime, true);
  constexpr double kNegligible = 1e-20;  // E = 1 + (k'^2/2) (ln(4/k') - 1/2) + ...
  if (k < kNegligible) return 1.0;
  const AgmSteps agm(1.0, k);
  const DoubleDouble k_squared =
      (DoubleDouble(1.0) - DoubleDouble(k)) * (DoubleDouble(1.0) + DoubleDouble(k));
  const DoubleDouble bracket = DoubleDouble(1.0) - k_squared * (DoubleDouble(0.5) + agm.gap_sum());
  return (kPi / ldexp(agm.mean(), 1) * bracket).hi;
}

double incomplete_integral(double psi, ComplementaryModulus k_prime) {
  const DefaultFloatingPoint environment;
  constexpr double kFurthest = 1e9;
  require(std::abs(psi) <= kFurthest, "psi", psi, "from -1e9 to 1e9");
  const AgmSteps agm(1.0, checked(k_prime, false));
  const auto [count, s] = half_turns(psi);
  const double sign = s.sine.hi < 0.0 ? -1.0 : 1.0;
  const DoubleDouble rest = s.sine.hi == 0.0 ? DoubleDouble() : agm.turns_of(s.cosine / abs(s.sine));
  const DoubleDouble turns = DoubleDouble(0.5 * count) + DoubleDouble(sign) * rest;
  return (ldexp(kPi, 1) / agm.mean() * turns).hi;
}

JacobiFunctions jacobi_functions(double turns, ComplementaryModulus k_prime) {
  const DefaultFloatingPoint environment;
  require(std::abs(turns) <= 0x1p52, "turns", turns, "from -2^52 to 2^52");
  const AgmSteps::Amplitude a = AgmSteps(1.0, checked(k_prime, false)).amplitude(turns - std::round(turns));
  return {a.sn.hi, a.cn.hi, a.dn.hi};
}

}  // namespace strutt
