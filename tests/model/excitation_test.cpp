#include "strutt/model/excitation.hpp"
#include "support/ratchet.hpp"

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
          "[model][excitation][ratchet]") {
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
    check_close("largest value of a support with square acceleration at 4000 points (relative)", largest,
                kAmplitude * std::numbers::pi * std::numbers::pi / 8.0, 8e-7);
    CHECK(largest <= r.function.bound());
    check_within("mean of a support with square acceleration at 4000 points over the amplitude",
                 std::abs(mean) / kAmplitude, 5e-15);
    check_within("mean velocity of a support with square acceleration at 4000 points over the amplitude",
                 std::abs(mean_velocity) / kAmplitude, 6e-16);
    // value() runs in time: r'' by differences, within a quarter period of a constant acceleration
    const double t = (0.8 - phase) / kFrequency, h = 1e-3;
    const double second = (r.value(t + h) - 2.0 * r.value(t) + r.value(t - h)) / (h * h);
    check_close("acceleration of a support with square acceleration by differences (relative)", second,
                -kAmplitude * kFrequency * kFrequency, 6e-12);
  }
}

}  // namespace strutt::test::excitation_test
