#include "strutt/free_pendulum/planar_system.hpp"

#include <cmath>
#include <limits>

#include "free_pendulum/bivariate_polynomial.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kTraceTolerance = 8 * kEpsilon;
constexpr double kEquilibriumTolerance = 64 * kEpsilon;

void require_finite(const NonlinearTerms& f) {
  each_term(
      f, [](const double& c, int) { require(std::isfinite(c), "Taylor coefficient", c, "a finite number"); });
}

/// a d - b c with one rounding error of the result, not of the products (Kahan).
double determinant(const Eigen::Matrix2d& a) {
  const double bc = a(0, 1) * a(1, 0);
  const double rest = std::fma(-a(0, 1), a(1, 0), bc);
  return std::fma(a(0, 0), a(1, 1), -bc) + rest;
}

NonlinearTerms terms_of(const Jet& f) {
  return {f.coefficient(2, 0), f.coefficient(1, 1), f.coefficient(0, 2), f.coefficient(3, 0),
          f.coefficient(2, 1), f.coefficient(1, 2), f.coefficient(0, 3)};
}

}  // namespace

JordanForm jordan_form(const PlanarSystem& system) {
  const DefaultFloatingPoint environment;
  const auto& a = system.linear;
  require(a.allFinite(), "entry of A", a(0, 0), "a finite number");
  require_finite(system.f1);
  require_finite(system.f2);
  const double trace = a.trace();
  require(std::abs(trace) <= kTraceTolerance * (std::abs(a(0, 0)) + std::abs(a(1, 1))), "trace of A", trace,
          "zero: the eigenvalues of a centre are imaginary");
  const double det = determinant(a);
  require(det > 0.0 && std::isfinite(det), "determinant of A", det,
          "positive: the eigenvalues of a centre are imaginary");

  // det > 0 with zero trace means a12 a21 < 0: T can be inverted.
  const double alpha = std::sqrt(det), v1 = -a(0, 0) / alpha, v2 = -a(1, 0) / alpha;
  BivariatePolynomial<double> x1, x2;
  x1(1, 0) = 1.0;
  x1(0, 1) = v1;
  x2(0, 1) = v2;
  const auto f1 = substitute(system.f1, x1, x2), f2 = substitute(system.f2, x1, x2);
  const auto same = [](double c) { return c; };
  return {.transformation = Eigen::Matrix2d{{1.0, v1}, {0.0, v2}},
          .system = {.alpha = alpha,
                     .f1 = nonlinear_terms(f1 + (-v1 / v2) * f2, same),
                     .f2 = nonlinear_terms((1.0 / v2) * f2, same)}};
}

PlanarSystem taylor_expansion(const PlanarField& field, const Eigen::Vector2d& equilibrium) {
  const DefaultFloatingPoint environment;
  const JetPair f = field(Jet::first_variable(equilibrium(0)), Jet::second_variable(equilibrium(1)));
  PlanarSystem system{.linear = Eigen::Matrix2d{{f[0].coefficient(1, 0), f[0].coefficient(0, 1)},
                                                {f[1].coefficient(1, 0), f[1].coefficient(0, 1)}},
                      .f1 = terms_of(f[0]),
                      .f2 = terms_of(f[1])};
  require(system.linear.allFinite(), "entry of A", system.linear.sum(), "a finite number");
  require_finite(system.f1);
  require_finite(system.f2);
  const double most =
      kEquilibriumTolerance * (1.0 + equilibrium.lpNorm<1>()) * system.linear.lpNorm<Eigen::Infinity>();
  for (const Jet& component : f) {
    const double value = component.coefficient(0, 0);
    require(std::abs(value) <= most, "right-hand side at the equilibrium", value, "zero");
  }
  return system;
}

}  // namespace strutt
