#include "strutt/free_pendulum/normal_form.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <tuple>

#include "free_pendulum/bivariate_polynomial.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

using Complex = std::complex<double>;
/// Polynomials in w = z1 - i z2 and its conjugate.
using Polynomial = BivariatePolynomial<Complex>;

constexpr Complex kI{0.0, 1.0};
// About thirty complex operations lie between a coefficient and the result; their products add up to less
// than half of the magnitude that this factor meets.
constexpr double kRounding = 32 * std::numeric_limits<double>::epsilon();

/// The conjugate of a polynomial: of its coefficients, and w changes place with conj(w).
Polynomial conjugate(const Polynomial& p) {
  Polynomial result;
  Polynomial::each(0, Polynomial::kDegree, [&](int j, int k) { result(k, j) = std::conj(p(j, k)); });
  return result;
}

/// F = f1 - i f2 at y1 - i y2 = zeta(w), as a polynomial in w.
Polynomial nonlinear_part(const PlanarCoefficients& system, const Polynomial& zeta) {
  const Polynomial bar = conjugate(zeta);
  const Polynomial y1 = Complex(0.5) * (zeta + bar);
  const Polynomial y2 = Complex(0.0, 0.5) * (zeta + Complex(-1.0) * bar);
  return substitute(system.f1, y1, y2) + (-kI) * substitute(system.f2, y1, y2);
}

/// What is needed of (19): y1 - i y2 = zeta(w), and the one coefficient that stays.
struct Solution {
  Polynomial zeta;
  Complex resonant;
};

/// w' = i alpha w + c |w|^2 w turns the left-hand side of (19) into i alpha (j - k) h_jk w^j conj(w)^k, the
/// right-hand side is i alpha h_jk + F_jk. Terms of degree 2 first: F_jk of degree 3 contains them.
Solution solve_homological_equations(const PlanarCoefficients& system) {
  Solution s;
  s.zeta(1, 0) = 1.0;
  for (int degree = 2; degree <= 3; ++degree) {
    const Polynomial f = nonlinear_part(system, s.zeta);
    Polynomial::each(degree, degree, [&](int j, int k) {
      if (j - k == 1)
        s.resonant = f(j, k);
      else
        s.zeta(j, k) = f(j, k) / (kI * (system.alpha * (j - k - 1)));
    });
  }
  return s;
}

/// g of y = z + g(z): zeta(w) - w written in z1, z2.
std::pair<NonlinearTerms, NonlinearTerms> near_identity(const Polynomial& zeta) {
  Polynomial w, bar, g;
  w(1, 0) = bar(1, 0) = 1.0;
  w(0, 1) = -kI;
  bar(0, 1) = kI;
  Polynomial one;
  one(0, 0) = 1.0;
  Polynomial::each(2, 3, [&](int j, int k) {
    Polynomial term = one;
    for (int i = 0; i < j; ++i) term = term * w;
    for (int i = 0; i < k; ++i) term = term * bar;
    g = g + zeta(j, k) * term;
  });
  return {nonlinear_terms(g, [](const Complex& c) { return c.real(); }),
          nonlinear_terms(g, [](const Complex& c) { return -c.imag(); })};
}

/// Sums of the absolute values of the quadratic and of the cubic coefficients.
struct Sizes {
  double quadratic = 0.0, cubic = 0.0;
};

Sizes sizes(const PlanarCoefficients& system) {
  Sizes s;
  for (const auto* f : {&system.f1, &system.f2})
    each_term(*f, [&](const double& c, int degree) { (degree == 2 ? s.quadratic : s.cubic) += std::abs(c); });
  return s;
}

/// Exponents of two: time in units of 2^-time, y in units of 2^length.
struct Units {
  int time = 0, length = 0;
};

/// The units in which alpha is about 1 and no coefficient is above 1. Half exponents are rounded up.
Units natural_units(const PlanarCoefficients& system) {
  constexpr int kNone = std::numeric_limits<int>::min() / 4;
  const int time = std::ilogb(system.alpha);
  int quadratic = kNone, cubic = kNone;
  for (const auto* f : {&system.f1, &system.f2}) {
    each_term(*f, [&](const double& c, int degree) {
      if (c != 0.0)
        (degree == 2 ? quadratic : cubic) = std::max(degree == 2 ? quadratic : cubic, std::ilogb(c) + 1);
    });
  }
  if (quadratic == kNone && cubic == kNone) return {time, 0};
  const int of_cubic = cubic == kNone ? kNone : static_cast<int>(std::ceil(0.5 * (cubic - time)));
  return {time, -std::max(quadratic == kNone ? kNone : quadratic - time, of_cubic)};
}

/// A term of degree d scales with length^(d-1)/time; exact unless it falls below the smallest normal number,
/// where it is 2^-1000 of the largest.
PlanarCoefficients scaled(PlanarCoefficients system, const Units& units) {
  system.alpha = std::ldexp(system.alpha, -units.time);
  for (auto* f : {&system.f1, &system.f2})
    each_term(*f,
              [&](double& c, int degree) { c = std::ldexp(c, units.length * (degree - 1) - units.time); });
  return system;
}

void scale_back(NonlinearTerms& g, const Units& units) {
  each_term(g, [&](double& c, int degree) { c = std::ldexp(c, -units.length * (degree - 1)); });
}

bool is_finite(const NonlinearTerms& g) {
  bool finite = true;
  each_term(g, [&](const double& c, int) { finite = finite && std::isfinite(c); });
  return finite;
}

void validate(const PlanarCoefficients& system) {
  require(system.alpha > 0.0 && std::isfinite(system.alpha), "alpha", system.alpha, "a positive number");
  for (const auto* f : {&system.f1, &system.f2})
    each_term(*f,
              [](const double& c, int) { require(std::isfinite(c), "coefficient", c, "a finite number"); });
}

}  // namespace

NormalForm normal_form(const PlanarCoefficients& system) {
  const DefaultFloatingPoint environment;
  validate(system);
  const Units units = natural_units(system);
  const PlanarCoefficients natural = scaled(system, units);
  const Solution solution = solve_homological_equations(natural);
  const Sizes size = sizes(natural);
  // c is a sum of products whose absolute values add up to at most this; |J^-1| = 1/alpha.
  const double magnitude = size.cubic + size.quadratic * size.quadratic / natural.alpha;

  NormalForm form;
  const auto restored = [&](double value) { return std::ldexp(value, units.time - 2 * units.length); };
  form.alpha = system.alpha;
  form.delta = restored(solution.resonant.real());
  form.beta = restored(solution.resonant.imag());
  // One more subnormal spacing for a result that was rounded on its way back.
  form.delta_error = form.beta_error =
      magnitude == 0.0 ? 0.0 : restored(kRounding * magnitude) + std::numeric_limits<double>::denorm_min();
  std::tie(form.g1, form.g2) = near_identity(solution.zeta);
  scale_back(form.g1, units);
  scale_back(form.g2, units);
  const bool finite =
      std::isfinite(form.delta) && std::isfinite(form.beta) && is_finite(form.g1) && is_finite(form.g2);
  form.outcome = finite ? Outcome::converged : Outcome::non_finite;
  return form;
}

NormalForm normal_form(const PlanarSystem& system) {
  const DefaultFloatingPoint environment;
  return normal_form(jordan_form(system).system);
}

double normal_form_period(const NormalForm& form, double r) {
  const DefaultFloatingPoint environment;
  require(r >= 0.0, "amplitude", r, "r >= 0");
  const double frequency = std::fma(form.beta * r, r, form.alpha);
  return frequency > 0.0 ? 2.0 * std::numbers::pi / frequency : std::numeric_limits<double>::infinity();
}

}  // namespace strutt
