#include <Eigen/LU>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/floquet/stability.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::stability_test {

using strutt::test::check_close;
using strutt::test::check_within;

namespace {

Stability at(const LinearModel& model, double tolerance = 1e-11) {
  MonodromyEngine engine;
  return analyse(engine, model, {.tolerance = tolerance});
}

/// Lame's equation x'' + (h - n(n+1) k^2 sn^2(t, k)) x = 0 over the period 2K of sn^2.
HillEquation lame(int n, double k, double h) {
  const double period = 2.0 * boost::math::ellint_1(k);
  std::vector<double> samples;
  constexpr int kSamples =
      32;  // the Fourier coefficients of sn^2 fall like nome^j, nome < 0.064 for k <= 0.8
  for (int j = 0; j < kSamples; ++j) {
    const double sn = boost::math::jacobi_sn(k, period * j / kSamples);
    samples.push_back(h - n * (n + 1) * k * k * sn * sn);
  }
  return hill_equation(period, PeriodicFunction::samples(samples));
}

/// The 2n + 1 edges of the n open gaps, ascending (Arscott, Periodic Differential Equations, 1964, ch. 9).
std::vector<double> lame_edges(int n, double k) {
  const double m = k * k;
  std::vector<double> edges;
  const auto pair = [&](double centre, double radicand) {
    edges.push_back(centre - 2.0 * std::sqrt(radicand));
    edges.push_back(centre + 2.0 * std::sqrt(radicand));
  };
  if (n == 1) edges = {m, 1.0, 1.0 + m};
  if (n == 2) {
    edges = {1.0 + m, 1.0 + 4.0 * m, 4.0 + m};
    pair(2.0 * (1.0 + m), 1.0 - m + m * m);
  }
  if (n == 3) {
    edges = {4.0 * (1.0 + m)};
    pair(5.0 * (1.0 + m), 4.0 - 7.0 * m + 4.0 * m * m);
    pair(5.0 + 2.0 * m, 4.0 - m + m * m);
    pair(2.0 + 5.0 * m, 1.0 - m + 4.0 * m * m);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

TEST_CASE("Lame's equation has exactly n open gaps, with the known edges",
          "[floquet][known][N08][extreme][ratchet]") {
  const int n = GENERATE(1, 2, 3);
  const double k = GENERATE(0.5, 0.8);
  const auto edges = lame_edges(n, k);
  REQUIRE(edges.size() == static_cast<std::size_t>(2 * n + 1));
  for (std::size_t j = 0; j < edges.size(); ++j) {
    // unstable below the first edge, then bands and gaps alternate
    const Verdict below = j % 2 == 0 ? Verdict::unstable : Verdict::stable;
    const Verdict above = j % 2 == 0 ? Verdict::stable : Verdict::unstable;
    CHECK(at(lame(n, k, edges[j] - 1e-7)).verdict == below);
    CHECK(at(lame(n, k, edges[j] + 1e-7)).verdict == above);
    check_within("N08 margin at the known edges of Lame's equation",
                 std::abs(at(lame(n, k, edges[j])).margin), 1.5e-13);
  }
  // Every later gap is closed. A gap can only be where the winding number is a half n/2; find these places,
  // and see that the margin only touches zero there, from above.
  const double from = edges.back() + 1e-3, to = edges.back() + 30.0;
  const auto halves = [&](double h) { return 2.0 * at(lame(n, k, h), 1e-9).winding; };
  const int first = static_cast<int>(std::ceil(halves(from))),
            last = static_cast<int>(std::floor(halves(to)));
  CHECK(first == n + 1);
  CHECK(last >= n + 3);
  for (int j = first; j <= last; ++j) {
    std::uintmax_t steps = 60;
    const auto [below, above] =
        boost::math::tools::toms748_solve([&](double h) { return halves(h) - j; }, from, to,
                                          [](double a, double b) { return b - a < 1e-9 * b; }, steps);
    const auto closed = at(lame(n, k, 0.5 * (below + above)));
    CHECK(closed.verdict != Verdict::unstable);
    check_within("N08 margin in the closed gaps of Lame's equation", std::abs(closed.margin), 1e-16);
    for (const double distance : {-1e-3, -1e-5, 1e-5, 1e-3}) {
      CHECK(at(lame(n, k, below + distance)).verdict == Verdict::stable);
    }
  }
  for (double h = from; h < to; h += 0.37) CHECK(at(lame(n, k, h), 1e-9).verdict == Verdict::stable);
}

TEST_CASE("Meissner's equation agrees with its closed form by both routes",
          "[floquet][known][N19][extreme][ratchet]") {
  MonodromyEngine engine;
  for (const double amplitude : {0.3, 1.5, 4.0}) {
    const auto equation =
        hill_equation(2.0 * std::numbers::pi, PeriodicFunction::square(1.1, amplitude, 0.0));
    // D = 2 c1 c2 - (s1/s2 + s2/s1) z1 z2, half a period of each piece
    const std::complex<double> a = std::sqrt(std::complex<double>(1.1 + amplitude));
    const std::complex<double> b = std::sqrt(std::complex<double>(1.1 - amplitude));
    const double pi = std::numbers::pi;
    const double expected =
        (2.0 * std::cos(a * pi) * std::cos(b * pi) - (a / b + b / a) * std::sin(a * pi) * std::sin(b * pi))
            .real();
    for (const auto method : {Method::exact, Method::propagator, Method::arkode, Method::cvode}) {
      const auto result = analyse(engine, equation, {.tolerance = 1e-9, .method = method});
      const double size = std::max(1.0, result.matrix.cwiseAbs().maxCoeff());
      const double error = std::abs(result.discriminant - expected) / size;
      CHECK(error <= result.error + 1e-13);
      if (method == Method::exact)
        check_within("N19 D of Meissner's equation in closed form (scaled)", error, 5e-15);
      if (method == Method::propagator)
        check_within("N19 D of Meissner's equation by the propagator (scaled)", error, 2e-11);
      CHECK(result.error <= (method == Method::exact ? 1e-12 : 1e-9));
    }
  }
}

TEST_CASE("Entries beyond 1e300 are given with a scale", "[floquet][extreme][N01][ratchet]") {
  const auto result = at(mathieu_delta_epsilon(-1.4e4, 0.0));  // exp(743)
  CHECK(result.log_scale > 0.0);
  CHECK(result.matrix.allFinite());
  CHECK(result.matrix.cwiseAbs().maxCoeff() > 0.1);
  const double growth = 2.0 * std::numbers::pi * std::sqrt(1.4e4);
  check_close("N01 growth up to exp(743) (relative)", result.growth, growth, 8e-16);
  check_close("N01 logarithm of D and of a multiplier up to exp(743) (relative)",
              std::log(result.discriminant) + result.log_scale, growth, 8e-16);
  check_close("N01 logarithm of D and of a multiplier up to exp(743) (relative)",
              std::log(result.multipliers[0].real()) + result.log_scale, growth, 8e-16);
  CHECK(at(mathieu_delta_epsilon(-1.0, 0.0)).log_scale == 0.0);
}

TEST_CASE("SI and canonical scenes of one rod give the same verdict and growth", "[floquet][law][ratchet]") {
  const double omega = GENERATE(3.0, 7.5, 8.1, 40.0);
  for (const auto about : {Equilibrium::hanging, Equilibrium::inverted}) {
    const auto rod = PhysicalPendulum::uniform_rod(2.5, 1.0, 9.81, 0.3);
    const auto support = sinusoidal_support(0.15, omega);
    const auto si = at(linearise(rod, about, &support).equation);
    const double sign = about == Equilibrium::hanging ? 1.0 : -1.0;
    const double delta = sign * 1.5 * 9.81 / (omega * omega), epsilon = -sign * 1.5 * 0.15;
    auto canonical = mathieu_delta_epsilon(delta, 0.0, 0.3 / omega);
    canonical.coefficient = PeriodicFunction::fourier(delta, {{1, 0.0, epsilon}});
    const auto reference = at(canonical);
    CHECK(si.verdict == reference.verdict);
    check_close("growth in SI and canonical units (relative)", si.growth, reference.growth, 8e-16);
    check_close("growth per time against growth per period (relative)", si.growth_per_time,
                si.growth * omega / (2.0 * std::numbers::pi), 8e-16);
    check_close("winding in SI and canonical units (relative)", si.winding, reference.winding, 8e-16);
    check_close("m12 in SI and canonical units (relative)", si.matrix(0, 1) * omega, reference.matrix(0, 1),
                1.5e-15);
  }
}

TEST_CASE("A system with one degree of freedom has the scaled error of a system, kappa = 2 pi/T",
          "[floquet][known]") {
  LinearPeriodicSystem system;
  system.period = 2.0 * std::numbers::pi;
  system.mass = Eigen::MatrixXd::Constant(1, 1, 1.0);
  system.stiffness.mean = Eigen::MatrixXd::Constant(1, 1, 2520.0);
  system.stiffness.harmonics.push_back({1, Eigen::MatrixXd::Constant(1, 1, 1.0), {}});
  const auto hill = as_hill_equation(system);
  REQUIRE(hill.has_value());
  CHECK(hill->canonical_kappa() == 1.0);

  const auto exact = at(system, 1e-10), coarse = at(system, 1e-6);
  REQUIRE(exact.outcome == Outcome::converged);
  const Eigen::Matrix2d difference = (coarse.matrix - exact.matrix).cwiseAbs();
  const double largest = std::max(1.0, exact.matrix.cwiseAbs().maxCoeff());
  REQUIRE(largest > 10.0);  // m21, which kappa = 50 would have divided
  CHECK(difference.maxCoeff() / largest <= coarse.error + exact.error);
  CHECK(coarse.error <= 1e-6);
}

TEST_CASE("One degree of freedom beyond the range of double is an outcome", "[floquet][extreme]") {
  MonodromyEngine engine;
  LinearPeriodicSystem system;
  system.mass = Eigen::MatrixXd::Identity(1, 1);
  system.period = 1e300;
  system.stiffness.mean = Eigen::MatrixXd::Constant(1, 1, 1e300);
  CHECK(analyse(engine, system, {}).outcome != Outcome::converged);
  system.period = 1e-320;
  CHECK(analyse(engine, system, {}).verdict == Verdict::unresolved);
  system.period = 1.0;
  system.stiffness.mean(0, 0) = 1.0;
  CHECK(analyse(engine, system, {}).outcome == Outcome::converged);
}

TEST_CASE("Parts that were not asked for are not computed", "[floquet][cost]") {
  MonodromyEngine engine;
  const auto result =
      analyse(engine, mathieu_delta_epsilon(1.0, 0.5), {}, {.winding = false, .matrix = false});
  CHECK(std::isnan(result.winding));
  CHECK(result.matrix.size() == 0);
  CHECK(result.verdict == Verdict::unstable);
}

}  // namespace strutt::test::stability_test
