#include "strutt/free_pendulum/period.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "reference/free_pendulum.hpp"
#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::period_test {

using strutt::test::check_within;
using Real = exact::Real50;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kPiRounded = exact::pi<double>();

Real of_amplitude(double amplitude) { return cos(Real(amplitude) / 2); }
Real of_from_top(double from_top) { return sin(Real(from_top) / 2); }

/// The true ratio; every fiftieth call asks the second method, too.
Real true_ratio(const Real& k_prime) {
  static int calls = 0;
  const Real ratio = exact::ratio_by_agm(k_prime);
  if (++calls % 50 == 0) {
    const Real other = exact::ratio_by_series(k_prime);
    if (abs(other / ratio - 1) > Real("1e-45")) FAIL("the references disagree at k' = " << k_prime);
  }
  return ratio;
}

Real true_rotation_ratio(double excess) {
  return 1 / exact::agm(Real(sqrt(4 + Real(excess))), Real(sqrt(Real(excess))));
}

std::vector<double> uniform(double from, double to, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> distribution(from, to);
  std::vector<double> values(count);
  for (double& value : values) value = distribution(generator);
  return values;
}

std::vector<double> logarithmic(double from_exponent, double to_exponent, std::size_t count,
                                std::uint64_t seed) {
  auto values = uniform(from_exponent, to_exponent, count, seed);
  for (double& value : values) value = std::pow(10.0, value);
  return values;
}

struct Worst {
  double ulp = 0.0, relative = 0.0;
};

Worst worst(const std::vector<double>& inputs, const std::function<double(double)>& value,
            const std::function<Real(double)>& truth) {
  Worst result;
  for (const double x : inputs) {
    const double computed = value(x);
    const Real exactly = truth(x);
    result.ulp = std::max(result.ulp, exact::error_in_ulp(computed, exactly));
    const Real relative = abs(computed / exactly - 1);
    result.relative = std::max(result.relative, static_cast<double>(relative));
  }
  return result;
}

}  // namespace

TEST_CASE("the two references of the period agree", "[free_pendulum][period][reference]") {
  const char* const text =
      GENERATE("0.999999", "0.9", "0.71", "0.69", "0.3", "1e-5", "1e-17", "1e-150", "1e-300");
  const Real k_prime(text);
  CHECK(abs(exact::ratio_by_agm(k_prime) / exact::ratio_by_series(k_prime) - 1) < Real("1e-46"));
}

TEST_CASE("T/T0 of a libration is within 0.8 ulp at 100,000 points",
          "[free_pendulum][period][accuracy][ratchet]") {
  const auto amplitude_truth = [](double a) { return true_ratio(of_amplitude(a)); };
  const auto from_top_truth = [](double y) { return true_ratio(of_from_top(y)); };
  const auto near_top = [](std::vector<double> distances) {
    for (double& d : distances) d = kPiRounded - d;
    return distances;
  };
  Worst w;
  SECTION("amplitudes, uniform") {
    w = worst(uniform(0.0, kPiRounded, 40000, 1), period_ratio, amplitude_truth);
  }
  SECTION("amplitudes, small") { w = worst(logarithmic(-300, 0, 10000, 2), period_ratio, amplitude_truth); }
  SECTION("amplitudes, to within 1e-16 of pi") {
    w = worst(near_top(logarithmic(-16, 0, 20000, 3)), period_ratio, amplitude_truth);
  }
  SECTION("from the top, all sizes") {
    w = worst(logarithmic(-307, 0.497, 20000, 4), period_ratio_from_top, from_top_truth);
  }
  SECTION("from the top, uniform") {
    w = worst(uniform(0.0, kPiRounded, 10000, 5), period_ratio_from_top, from_top_truth);
  }
  check_within("period of a libration in ulp", w.ulp, 0.8);
  CHECK(w.ulp >= 0.4);  // a bound that measures nothing would be 0
  CHECK(w.relative <= period_of_amplitude(1.0).error);
}

TEST_CASE("T/T0 at the seams of the table", "[free_pendulum][period][accuracy][ratchet]") {
  double largest = 0.0;
  for (int exponent = -40; exponent <= 1; ++exponent) {
    for (int part = 0; part < 64; ++part) {
      const double seam = std::ldexp(1.0 + part / 64.0, exponent);
      for (const double y : {std::nextafter(seam, 0.0), seam}) {
        if (y > kPiRounded) continue;
        largest =
            std::max(largest, exact::error_in_ulp(period_ratio_from_top(y), true_ratio(of_from_top(y))));
      }
    }
  }
  check_within("period at the seams of the table in ulp", largest, 0.8);
}

TEST_CASE("known periods", "[free_pendulum][period][ratchet]") {
  CHECK(period_ratio(kPiRounded / 2) == 1.18034059901609622604533794);
  CHECK(period_ratio(3.0) == 2.571233949432142049257416);
  CHECK(period_ratio(0.0) == 1.0);
  CHECK(period_ratio(5e-324) == 1.0);
  CHECK(period_ratio(kPiRounded) == Approx(24.65).epsilon(1e-4));
  CHECK(std::isinf(period_ratio_from_top(0.0)));
  CHECK(period_ratio_from_top(kPiRounded) == 1.0);
  check_within("period at the smallest distance from the top in ulp",
               exact::error_in_ulp(period_ratio_from_top(5e-324), true_ratio(of_from_top(5e-324))), 0.8);
  for (const double bad :
       {-1.0, -5e-324, 3.1415926535897936, kNaN, -kNaN, std::numeric_limits<double>::infinity()}) {
    CHECK(std::isnan(period_ratio(bad)));
    CHECK(std::isnan(period_ratio_from_top(bad)));
  }
}

TEST_CASE("a batch has the bits of the single calls, whatever its size and neighbours",
          "[free_pendulum][period][batch][extreme][N46]") {
  auto amplitudes = uniform(0.0, kPiRounded, 3000, 8);
  for (std::size_t i = 0; i < amplitudes.size(); i += 37) amplitudes[i] = kPiRounded - 1e-12 * amplitudes[i];
  amplitudes[100] = kNaN;
  amplitudes[1000] = kPiRounded;
  amplitudes[1001] = -1.0;
  amplitudes[1002] = 0.0;
  const bool from_top = GENERATE(false, true);
  const auto batch = from_top ? period_ratios_from_top : period_ratios;
  const auto single = from_top ? period_ratio_from_top : period_ratio;
  for (const std::size_t size : {0, 1, 7, 255, 256, 257, 3000}) {
    std::vector<double> ratios(amplitudes.begin(), amplitudes.begin() + static_cast<std::ptrdiff_t>(size));
    batch(ratios, ratios);  // in place
    std::size_t different = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const double expected = single(amplitudes[i]);
      if (!(ratios[i] == expected) && !(std::isnan(ratios[i]) && std::isnan(expected))) ++different;
    }
    CHECK(different == 0);
  }
  std::array<double, 2> two{};
  CHECK_THROWS_AS(batch(amplitudes, two), InvalidInput);
}

TEST_CASE("T/T0 by the excess, inside and outside", "[free_pendulum][period][accuracy][ratchet]") {
  const auto value = [](double e) { return period_of_excess(e).ratio; };
  SECTION("rotations, 1e-300 to 1e308") {
    const Worst w = worst(logarithmic(-307, 308, 5000, 11), value, true_rotation_ratio);
    check_within("period by the excess in ulp", w.ulp, 0.51);
    CHECK(w.ulp >= 0.4);
    CHECK(w.relative <= period_of_excess(1.0).error);
  }
  SECTION("librations next to the separatrix") {
    auto excess = logarithmic(-307, 0.6, 5000, 12);
    for (double& e : excess) e = -e;
    const Worst w = worst(excess, value, [](double e) { return true_ratio(Real(sqrt(-Real(e)) / 2)); });
    check_within("period by the excess in ulp", w.ulp, 0.51);
    CHECK(w.relative <= period_of_excess(-1.0).error);
  }
  SECTION("ends") {
    CHECK(period_of_excess(-4.0).ratio == 1.0);
    CHECK(std::isinf(period_of_excess(0.0).period));
    CHECK(period_of_excess(5e-324).ratio > 118.0);
    CHECK_THROWS_AS(period_of_excess(-4.000001), InvalidInput);
    CHECK_THROWS_AS(period_of_excess(kNaN), InvalidInput);
  }
}

TEST_CASE("the stated error holds for the period with its alpha",
          "[free_pendulum][period][accuracy][ratchet]") {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> amplitude(0.0, kPiRounded), frequency(0.1, 10.0), part(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    Eigenfrequency alpha{frequency(generator), 0.0};
    alpha.rest = alpha.value * 0x1p-54 * part(generator);
    const double a = amplitude(generator);
    const Period period = period_of_amplitude(a, alpha);
    const Real truth =
        true_ratio(of_amplitude(a)) * 2 * exact::pi<Real>() / (Real(alpha.value) + Real(alpha.rest));
    const Real error = abs(period.period / truth - 1);
    REQUIRE(error <= Real(period.error));
    REQUIRE(period.quarter == period.period / 4);
  }
  check_within("bound of a period (relative)", period_of_amplitude(1.0).error, 3.5e-16);
  CHECK_THROWS_AS(period_of_amplitude(1.0, {0.0, 0.0}), InvalidInput);
  CHECK_THROWS_AS(period_of_amplitude(3.15), InvalidInput);
  CHECK_THROWS_AS(period_of_from_top(-1e-300), InvalidInput);
}

TEST_CASE("a period below the normal doubles says what it lost", "[free_pendulum][period][extremes]") {
  const double alpha = GENERATE(1e150, 3e154, 1e160, 1e169, 1e170, 1e300);
  const double excess = 1e308;
  const Period period = period_of_excess(excess, {alpha, 0.0});
  const Real truth = true_rotation_ratio(excess) * 2 * exact::pi<Real>() / Real(alpha);
  CHECK(abs(period.period / truth - 1) <= Real(period.error));
  CHECK(abs(4 * Real(period.quarter) / truth - 1) <= Real(period.error));
  CHECK((period.error < 1e-15) == (alpha < 1e154));
}

TEST_CASE("dT/dE is the difference quotient of the exact period", "[free_pendulum][period][accuracy]") {
  const double e = GENERATE(-3.9999, -3.0, -1.0, -1e-5, -1e-20, 1e-20, 1e-5, 1.0, 100.0, 1e10);
  const auto ratio = [](const exact::Real& x) {
    if (x < 0) return exact::Real(exact::ratio_by_agm(exact::Real(sqrt(-x) / 2)));
    return exact::Real(1 / exact::agm(exact::Real(sqrt(4 + x)), exact::Real(sqrt(x))));
  };
  const exact::Real at = e, h = abs(at) * exact::Real("1e-30");
  const exact::Real truth = abs((ratio(at + h) - ratio(at - h)) / (2 * h));
  const BoundedNumber slope = period_ratio_slope_magnitude(e);
  CHECK(abs(slope.value / truth - 1) <= exact::Real(slope.error));
}

TEST_CASE("dT/dE at rest is 1/16, and has no value on the separatrix", "[free_pendulum][period]") {
  CHECK(period_ratio_slope_magnitude(-4.0).value == 0.0625);
  CHECK_THROWS_AS(period_ratio_slope_magnitude(0.0), InvalidInput);
}

TEST_CASE("the libration of a given period", "[free_pendulum][period][inverse][ratchet]") {
  const double ratio =
      GENERATE(1.0 + 0x1p-52, 1.0 + 1e-10, 1.001, 1.18, 1.49999, 1.5, 1.50001, 2.0, 5.0, 24.0, 440.0);
  const LibrationOfPeriod found = libration_of_period_ratio(ratio);
  // The true inverse from the found one by one Newton step in 50 digits.
  const Real y = found.from_top, a = found.amplitude;
  const bool near_top = ratio > 1.5;
  const auto value = [&](const Real& x) {
    return true_ratio(near_top ? Real(sin(x / 2)) : Real(cos(x / 2)));
  };
  const Real x = near_top ? y : a, h = x * Real("1e-20");
  const Real slope = (value(x + h) - value(x - h)) / (2 * h);
  const Real correction = (value(x) - ratio) / slope;
  CHECK(abs(correction / x) <= Real(found.error));
  check_close("angles of a libration of given period: their sum against pi (relative)",
              found.amplitude + found.from_top, kPiRounded, 8e-16);
}

TEST_CASE("the inverse at its ends", "[free_pendulum][period][inverse]") {
  CHECK(libration_of_period_ratio(1.0).amplitude == 0.0);
  CHECK(libration_of_period_ratio(1.0).from_top == kPiRounded);
  for (const double bad : {0.999, 441.0, kNaN}) CHECK_THROWS_AS(libration_of_period_ratio(bad), InvalidInput);
}

}  // namespace strutt::test::period_test
