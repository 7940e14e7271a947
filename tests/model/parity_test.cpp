// PeriodicFunction::even_centre and centred.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "strutt/model/periodic_function.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::parity_test {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 0x1p-53;

}  // namespace

TEST_CASE("Even centres of cosines, sines and single waves", "[model][periodic_function][parity][ratchet]") {
  CHECK(PeriodicFunction::fourier(1.0, {{1, -2.0, 0.0}, {2, 1.0, 0.0}}).even_centre() == 0.0);
  for (const auto& [wave, centre] : {std::pair{PeriodicFunction::fourier(1.0, {{1, 0.0, 2.0}}), kPi / 2.0},
                                     {PeriodicFunction::fourier(1.0, {{1, 0.0, -2.0}}), kPi / 2.0},
                                     {PeriodicFunction::fourier(0.0, {{1, 1.0, 1.0}}), kPi / 4.0},
                                     {PeriodicFunction::square(0.0, 1.0, 4.0), 4.0 - kPi},
                                     {PeriodicFunction::square(0.0, 1.0, 0.2, 1), 0.2 + kPi / 2.0},
                                     {PeriodicFunction::square(0.0, 1.0, -0.2, 2), kPi - 0.2}})
    check_close("even centre of a single wave (relative)", wave.even_centre().value(), centre, 8e-16);
}

TEST_CASE("Even about a hidden centre: found, and symmetric about it", "[model][periodic_function][parity]") {
  std::mt19937_64 engine(2);
  const auto random = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine);
  };
  const std::vector<std::vector<int>> orders = {{1},    {1, 2},      {2, 3, 7},
                                                {4, 6}, {5, 10, 11}, {1, 2, 3, 4, 5, 6, 30}};
  for (int i = 0; i < 300; ++i) {
    std::vector<Harmonic> cosines;
    for (const int k : orders[static_cast<std::size_t>(i) % orders.size()]) {
      cosines.push_back({k, random(-1.0, 1.0) * (i % 2 == 0 ? 1.0 : 1e-200), 0.0});
    }
    const double hidden = random(-3.0, 3.0);
    const auto f = PeriodicFunction::fourier(0.3, cosines).shifted(-hidden);
    const auto centre = f.even_centre();
    REQUIRE(centre.has_value());
    CHECK(*centre >= 0.0);
    CHECK(*centre <= kPi);
    const auto centred = f.centred(*centre);
    for (const auto& h : centred.harmonics()) CHECK(h.sine == 0.0);
    const double small = 1e-14 * (1.0 + f.highest_order()) * (f.bound() - 0.3) + 4.0 * kUnit;
    for (const double tau : {0.1, 0.9, 2.0}) {
      CHECK(std::abs(f(*centre + tau) - f(*centre - tau)) <= 2.0 * small);
      CHECK(std::abs(f(*centre + tau) - centred(tau)) <= 2.0 * small);
    }
  }
}

TEST_CASE("What is not even has no centre", "[model][periodic_function][parity]") {
  const std::vector<std::vector<Harmonic>> uneven = {
      {{1, 1.0, 0.0}, {2, 0.0, 1.0}},                 // cos t + sin 2t
      {{1, 1.0, 0.0}, {2, 1.0, 1e-13}},               // almost
      {{1, 0.0, 1.0}, {2, 0.0, 1.0}},                 // odd, but not even a quarter period later
      {{2, 1.0, 0.0}, {3, 0.0, 1.0}, {4, 1.0, 1.0}},  // no first harmonic
      {{1, 1.0, 0.0}, {2, 0.0, 1e-200}},              // a small term has a phase, too
      {{1, 1e-200, 0.0}, {2, 1e-200, 1e-200}}};
  for (const auto& harmonics : uneven) CHECK_FALSE(PeriodicFunction::fourier(3.0, harmonics).even_centre());
  // odd harmonics only: sines are even a quarter period later, but not together with a cosine
  CHECK(PeriodicFunction::fourier(0.0, {{1, 0.0, 1.0}, {3, 0.0, 1.0}}).even_centre().has_value());
  CHECK_FALSE(PeriodicFunction::fourier(0.0, {{1, 1.0, 0.0}, {3, 0.0, 1.0}}).even_centre());
}

TEST_CASE("asymmetry measures what an even centre leaves out",
          "[model][periodic_function][parity][ratchet]") {
  const auto nearly = PeriodicFunction::fourier(1.0, {{1, 2.0, 0.0}, {2, 0.5, 1e-15}});
  REQUIRE(nearly.even_centre() == 0.0);
  check_close("asymmetry of 2e-15 (relative)", nearly.asymmetry(0.0), 2e-15, 8e-16);
  CHECK(PeriodicFunction::fourier(1.0, {{1, 2.0, 0.0}, {2, 0.5, 0.0}}).asymmetry(0.0) == 0.0);
  check_close("asymmetry of harmonics of 1e-200 (relative)",
              PeriodicFunction::fourier(0.0, {{1, 3e-200, 4e-200}}).asymmetry(0.0), 0.8, 8e-16);
  CHECK(PeriodicFunction::fourier(0.0, {{1, 0.0, 4.0}}).asymmetry(kPi / 2.0) < 1e-16);
  CHECK(PeriodicFunction::square(0.0, 1.0, 0.7).asymmetry(0.7) == 0.0);
}

}  // namespace strutt::test::parity_test
