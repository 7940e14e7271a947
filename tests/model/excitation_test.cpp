#include "strutt/model/excitation.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

namespace strutt::test::excitation_test {

using Real = boost::multiprecision::cpp_bin_float_50;

TEST_CASE("A sinusoidal support is amplitude sin(frequency t + phase)", "[model][excitation]") {
  for (const double phase : {0.0, 0.7, -2.0, std::numbers::pi / 2.0, 40.0}) {
    const auto r = sinusoidal_support(0.05, 12.0, phase);
    CHECK(r.frequency == 12.0);
    CHECK(r.function.mean() == 0.0);
    for (const double t : {0.0, 0.01, 0.3, 1.0}) {
      const Real truth = Real(0.05) * sin(Real(12.0) * t + phase);
      CHECK(static_cast<double>(Real(abs(truth - r.value(t)))) <= 0.05 * 0x1p-53 * (8.0 + 12.0 * t));
    }
  }
  CHECK(sinusoidal_support(0.05, 12.0).function.harmonics()[0].cosine == 0.0);  // odd, exactly
  CHECK(sinusoidal_support(0.0, 12.0).function.is_constant());
}

TEST_CASE("A support with square acceleration has r'' = -amplitude frequency^2 sign(sin)",
          "[model][excitation]") {
  constexpr double kAmplitude = 0.03, kFrequency = 20.0, kTwoPi = 2.0 * std::numbers::pi;
  for (const double phase : {0.0, 1.0, -2.5}) {
    const auto r = square_acceleration_support(kAmplitude, kFrequency, phase);
    const auto acceleration = r.function.derivative().derivative();
    double largest = 0.0, mean = 0.0, mean_velocity = 0.0;
    constexpr int kCount = 4000;
    for (int j = 0; j < kCount; ++j) {
      const double theta = kTwoPi * (j + 0.5) / kCount, sine = std::sin(theta + phase);
      const double expected = sine > 0.0 ? -kAmplitude : kAmplitude;
      if (std::abs(sine) > 1e-9) CHECK(acceleration(theta) == expected);
      largest = std::max(largest, std::abs(r.function(theta)));
      mean += r.function(theta) / kCount;
      mean_velocity += r.function.derivative()(theta) / kCount;
    }
    CHECK(largest == Approx(kAmplitude * std::numbers::pi * std::numbers::pi / 8.0).epsilon(1e-6));
    CHECK(largest <= r.function.bound());
    CHECK(std::abs(mean) < 1e-6 * kAmplitude);
    CHECK(std::abs(mean_velocity) < 1e-3 * kAmplitude);
    // value() runs in time: r'' by differences, within a quarter period of a constant acceleration
    const double t = (0.8 - phase) / kFrequency, h = 1e-3;
    const double second = (r.value(t + h) - 2.0 * r.value(t) + r.value(t - h)) / (h * h);
    CHECK(second == Approx(-kAmplitude * kFrequency * kFrequency).epsilon(1e-8));
  }
}

}  // namespace strutt::test::excitation_test
