#include "strutt/model/periodic_function.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::periodic_function_test {

using Real = boost::multiprecision::cpp_bin_float_50;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 0x1p-53;

/// mean + sum [a cos + b sin] in 50 digits.
Real series(double mean, const std::vector<Harmonic>& harmonics, const Real& theta) {
  Real sum = mean;
  for (const auto& h : harmonics) sum += h.cosine * cos(h.order * theta) + h.sine * sin(h.order * theta);
  return sum;
}

/// d^n/dtheta^n of the series by central differences in 50 digits, n = 1, 2.
Real difference(double mean, const std::vector<Harmonic>& harmonics, const Real& theta, int n) {
  const Real h = 1e-10, before = series(mean, harmonics, theta - h),
             after = series(mean, harmonics, theta + h);
  if (n == 1) return (after - before) / (2 * h);
  return (after - 2 * series(mean, harmonics, theta) + before) / (h * h);
}

/// The bound in the header: n terms, highest order k.
double rounding(const PeriodicFunction& f, double theta) {
  const auto terms = static_cast<double>(f.harmonics().size());
  return (3.0 * terms + 4.0 + f.highest_order() * std::abs(theta)) * kUnit * f.bound();
}

double distance(const Real& truth, double value) { return static_cast<double>(Real(abs(truth - value))); }

class Random {
 public:
  double operator()(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine_);
  }
  std::vector<Harmonic> harmonics(std::initializer_list<int> orders) {
    std::vector<Harmonic> result;
    for (const int k : orders) result.push_back({k, (*this)(-1.0, 1.0), (*this)(-1.0, 1.0)});
    return result;
  }

 private:
  std::mt19937_64 engine_{2};
};

/// The square wave (n = 0) or its n-th antiderivative by its Fourier series.
double square_series(int n, double tau) {
  double sum = 0.0;
  for (int m = 20000; m >= 0; --m) {
    const int k = 2 * m + 1;
    const double sign = m % 2 == 0 ? 1.0 : -1.0;
    const double wave = n == 0 ? std::cos(k * tau) : n == 1 ? std::sin(k * tau) : -std::cos(k * tau);
    sum += sign * wave / std::pow(k, n + 1);
  }
  return 4.0 / kPi * sum;
}

}  // namespace

TEST_CASE("A Fourier series and its derivatives carry their rounding only", "[model][periodic_function]") {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const double mean = random(-2.0, 2.0), theta = random(-20.0, 20.0);
    const auto harmonics = random.harmonics({7, 1, 3, 40});
    const auto f = PeriodicFunction::fourier(mean, harmonics);
    const auto slope = f.derivative(), curvature = slope.derivative();
    CHECK(distance(series(mean, harmonics, theta), f(theta)) <= rounding(f, theta));
    CHECK(distance(difference(mean, harmonics, theta, 1), slope(theta)) <= rounding(slope, theta));
    // its coefficients are rounded twice
    CHECK(distance(difference(mean, harmonics, theta, 2), curvature(theta)) <=
          rounding(curvature, theta) + 2.0 * kUnit * curvature.bound());
    CHECK(f.mean() == mean);
    CHECK(slope.mean() == 0.0);
    CHECK(f.highest_order() == 40);
    CHECK(f.harmonics().front().order == 1);
    CHECK_FALSE(f.is_constant());
    CHECK_FALSE(f.is_piecewise_constant());
  }
}

TEST_CASE("The zero function, constants and terms that are zero", "[model][periodic_function]") {
  CHECK(PeriodicFunction()(1.3) == 0.0);
  for (const auto& f :
       {PeriodicFunction::constant(2.5), PeriodicFunction::fourier(2.5, {{4, 0.0, 0.0}}),
        PeriodicFunction::square(2.5, 0.0, 1.0), PeriodicFunction::samples(std::vector{2.5})}) {
    CHECK(f.is_constant());
    CHECK(f.is_piecewise_constant());
    CHECK(f.highest_order() == 0);
    CHECK(f(-17.0) == 2.5);
    CHECK(f.derivative().is_constant());
    CHECK(f.derivative()(0.3) == 0.0);
    CHECK(f.even_centre() == 0.0);
    CHECK(f.bound() == 2.5);
    CHECK(f.lower_bound() == 2.5);
    CHECK(f.breakpoints(-100.0, 100.0).empty());
  }
}

TEST_CASE("Samples are met at the nodes, for odd and even numbers of them", "[model][periodic_function]") {
  Random random;
  for (const int count : {1, 2, 3, 4, 5, 8, 9, 31, 64, 200}) {
    std::vector<double> values;
    double largest = 0.0;
    for (int j = 0; j < count; ++j) values.push_back(random(-1.0, 1.0));
    for (const double v : values) largest = std::max(largest, std::abs(v));
    const auto f = PeriodicFunction::samples(values);
    INFO(count << " samples");
    CHECK(f.highest_order() == count / 2);
    for (int j = 0; j < count; ++j) {
      const double theta = 2.0 * kPi * j / count;
      // each coefficient carries the rounding of a sum of `count` terms, and so does the value
      CHECK(std::abs(f(theta) - values[static_cast<std::size_t>(j)]) <=
            2.0 * count * kUnit * largest + rounding(f, theta));
    }
    if (count % 2 == 0) CHECK(f.harmonics().back().sine == 0.0);
  }
}

TEST_CASE("Samples of a trigonometric polynomial give its coefficients back",
          "[model][periodic_function][ratchet]") {
  Random random;
  const auto harmonics = random.harmonics({1, 2, 3, 4});
  const auto f = PeriodicFunction::fourier(0.7, harmonics);
  for (const int count : {9, 10}) {
    std::vector<double> values;
    for (int j = 0; j < count; ++j)
      values.push_back(static_cast<double>(series(0.7, harmonics, 2.0 * acos(Real(-1)) * j / count)));
    const auto g = PeriodicFunction::samples(values);
    const auto check = [](double found, double expected) {
      check_within("coefficients from samples of a trigonometric polynomial", std::abs(found - expected),
                   1.5e-15);
    };
    check(g.mean(), 0.7);
    for (std::size_t k = 0; k < 4; ++k) {
      check(g.harmonics()[k].cosine, harmonics[k].cosine);
      check(g.harmonics()[k].sine, harmonics[k].sine);
    }
    for (const auto& h : g.harmonics().subspan(4))
      check_within("coefficients from samples that are not in a trigonometric polynomial",
                   std::hypot(h.cosine, h.sine), 2e-16);
  }
}

TEST_CASE("The square wave and its antiderivatives have their Fourier series",
          "[model][periodic_function][ratchet]") {
  for (const double theta : {-9.0, -2.0, -0.4, 0.0, 0.9, 1.2, 2.5, 3.1, 4.4, 6.0, 31.0}) {
    const double shift = 0.3;
    const auto error = [&](int n) {
      return std::abs(PeriodicFunction::square(0.0, 1.0, shift, n)(theta) - square_series(n, theta - shift));
    };
    check_within("square wave against its Fourier series", error(0), 8e-5);
    check_within("triangle wave against its Fourier series", error(1), 2.5e-9);
    check_within("parabolic arcs against their Fourier series", error(2), 5e-14);
  }
  const auto wave = PeriodicFunction::square(0.5, -2.0, 0.3);
  CHECK(wave.is_piecewise_constant());
  CHECK_FALSE(wave.is_constant());
  CHECK(wave.highest_order() == 1);
  CHECK(wave.mean() == 0.5);
  CHECK(wave(0.3) == -1.5);
  CHECK(wave(0.3 + kPi) == 2.5);
  CHECK_FALSE(PeriodicFunction::square(0.5, -2.0, 0.3, 1).is_piecewise_constant());
}

TEST_CASE("Derivatives lead back from the parabolic arcs to the square wave",
          "[model][periodic_function][ratchet]") {
  const auto arcs = PeriodicFunction::square(0.2, 1.5, -0.8, 2);
  const auto triangle = arcs.derivative(), wave = triangle.derivative();
  CHECK_THROWS_WITH(wave.derivative(), "a square wave has no derivative");
  const double h = 1e-3;  // central differences of parabolas are exact up to rounding
  for (const double theta : {-4.0, -1.0, 0.0, 0.5, 1.7, 2.0, 5.0}) {
    for (const auto& [f, slope] : {std::pair{&arcs, &triangle}, {&triangle, &wave}})
      check_within("slope of parabolic arcs and triangle waves against differences",
                   std::abs(((*f)(theta + h) - (*f)(theta - h)) / (2.0 * h) - (*slope)(theta)), 1e-12);
    CHECK(wave(theta) == PeriodicFunction::square(0.0, 1.5, -0.8)(theta));
  }
  // continuous at the ends of the arcs, and with mean 0.2 (Simpson's rule is exact on each arc)
  double mean = 0.0;
  for (const double start : {-0.8 - kPi / 2.0, -0.8 + kPi / 2.0}) {
    CHECK(std::abs(arcs(start - 1e-9) - arcs(start + 1e-9)) < 1e-8);
    mean += (arcs(start) + 4.0 * arcs(start + kPi / 2.0) + arcs(start + kPi)) / 12.0;
  }
  check_close("mean of parabolic arcs by Simpson's rule (relative)", mean, 0.2, 2.5e-15);
}

TEST_CASE("bound and lower_bound hold, and are met by a single wave", "[model][periodic_function]") {
  Random random;
  std::vector<PeriodicFunction> functions = {PeriodicFunction::fourier(-0.4, random.harmonics({1, 2, 5}))};
  for (int n = 0; n <= 2; ++n) functions.push_back(PeriodicFunction::square(0.4, -1.3, 0.7, n));
  const std::size_t several = 1;
  functions.push_back(PeriodicFunction::fourier(2.0, {{3, 0.6, 0.8}}));
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const auto& f = functions[i];
    double lowest = 1e9, largest = 0.0;
    for (int j = 0; j < 6000; ++j) {
      lowest = std::min(lowest, f(kPi * j / 3000.0));
      largest = std::max(largest, std::abs(f(kPi * j / 3000.0)));
    }
    CHECK(largest <= f.bound() * (1.0 + 1e-15));
    CHECK(lowest >= f.lower_bound() - 1e-15);
    if (i < several) continue;
    CHECK(largest >= f.bound() - 2e-3);
    CHECK(lowest <= f.lower_bound() + 2e-3);
  }
  // a mean that hides the wave must not hide it from the lower bound
  CHECK(PeriodicFunction::fourier(1e16, {{1, 40.0, 0.0}}).lower_bound() == 1e16 - 40.0);
  CHECK(PeriodicFunction::square(-1e16, 40.0, 0.0).lower_bound() == -1e16 - 40.0);
}

TEST_CASE("Shifting, scaling and adding are what they say, value by value",
          "[model][periodic_function][ratchet]") {
  Random random;
  std::vector<PeriodicFunction> functions = {PeriodicFunction::fourier(0.6, random.harmonics({1, 2, 9}))};
  for (int n = 0; n <= 2; ++n) functions.push_back(PeriodicFunction::square(0.6, 1.7, 0.4, n));
  for (const auto& f : functions) {
    for (const double theta0 : {-3.0, 0.0, 0.5, 12.0}) {
      for (const double tau : {-1.0, 0.0, 0.8, 2.2}) {
        check_within("periodic function shifted", std::abs(f.shifted(theta0)(tau) - f(theta0 + tau)),
                     1.2e-14);
        check_within("periodic function scaled", std::abs(f.scaled(-3.0)(tau) + 3.0 * f(tau)), 3e-15);
        check_within("periodic function with a constant added", std::abs(f.plus(0.25)(tau) - (f(tau) + 0.25)),
                     8e-16);
      }
    }
    CHECK(f.plus(0.25).mean() == 0.85);
    CHECK(f.scaled(-3.0).mean() == -3.0 * 0.6);
    CHECK(f.scaled(0.0).is_constant());
  }
  // about its own centre a square wave has its jumps at odd multiples of pi/2, to the last bit
  const auto centred =
      PeriodicFunction::square(1.0, 2.0, 0.7).centred(*PeriodicFunction::square(1.0, 2.0, 0.7).even_centre());
  CHECK(centred.breakpoints(0.0, 2.0 * kPi) == std::vector{kPi / 2.0, kPi + kPi / 2.0});
}

TEST_CASE("Breakpoints are the jumps, and pieces lie between them",
          "[model][periodic_function][breakpoints]") {
  const auto wave = PeriodicFunction::square(1.0, 2.0, 0.3);
  for (const auto& [from, to] :
       {std::pair{0.0, 2.0 * kPi}, {-20.0, -5.0}, {1.0, 1.5}, {1.0, 2.0}, {0.0, 100.0}}) {
    const auto jumps = wave.breakpoints(from, to);
    CHECK(std::is_sorted(jumps.begin(), jumps.end()));
    CHECK(std::abs(static_cast<double>(jumps.size()) - (to - from) / kPi) <= 1.0);
    for (const double jump : jumps) {
      CHECK(jump > from);
      CHECK(jump < to);
      CHECK(wave(jump - 1e-9) == -wave(jump + 1e-9) + 2.0);
    }
    // nothing jumps in between
    std::vector<double> ends = jumps;
    ends.insert(ends.begin(), from);
    ends.push_back(to);
    for (std::size_t j = 0; j + 1 < ends.size(); ++j) {
      const double middle = 0.5 * (ends[j] + ends[j + 1]);
      const auto piece = wave.piece(middle);
      CHECK(piece.is_constant());
      for (const double share : {0.01, 0.3, 0.99})
        CHECK(wave(std::lerp(ends[j], ends[j + 1], share)) == piece(0.0));
    }
  }
  // an interval that ends at a jump does not contain it
  const double jump = wave.breakpoints(0.0, 3.0).front();
  CHECK(wave.breakpoints(0.0, jump).empty());
  CHECK(wave.breakpoints(jump, 3.0).empty());
  CHECK(PeriodicFunction::square(1.0, 2.0, 0.3, 1).breakpoints(0.0, 10.0).empty());
  CHECK(PeriodicFunction::fourier(0.0, {{1, 1.0, 0.0}}).breakpoints(0.0, 10.0).empty());
  CHECK(PeriodicFunction::fourier(0.0, {{1, 1.0, 0.0}}).piece(2.0)(0.4) == std::cos(0.4));
}

TEST_CASE("Misuse of periodic functions names what is wrong", "[model][periodic_function][error]") {
  const double nan = std::nan("");
  CHECK_THROWS_WITH(PeriodicFunction::fourier(0.0, {{0, 1.0, 0.0}}),
                    "order = 0 is not allowed: it must be an integer >= 1");
  CHECK_THROWS_WITH(PeriodicFunction::fourier(0.0, {{-2, 1.0, 0.0}}), Catch::Contains("order = -2"));
  CHECK_THROWS_WITH(PeriodicFunction::fourier(0.0, {{3, 1.0, 0.0}, {1, 1.0, 0.0}, {3, 0.0, 1.0}}),
                    "order = 3 is not allowed: it must be given only once");
  CHECK_THROWS_WITH(PeriodicFunction::square(0.0, 1.0, 0.0, 3),
                    "antiderivative = 3 is not allowed: it must be 0, 1 or 2");
  CHECK_THROWS_AS(PeriodicFunction::square(0.0, 1.0, 0.0, -1), InvalidInput);
  CHECK_THROWS_WITH(PeriodicFunction::square(0.0, 1.0, nan), "shift = nan is not allowed: it must be finite");
  CHECK_THROWS_WITH(PeriodicFunction::samples({}),
                    "number of samples = 0 is not allowed: it must be at least 1");
}

}  // namespace strutt::test::periodic_function_test
