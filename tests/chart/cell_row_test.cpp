// The vector code of chart cells against the code of single points.
#include "chart/cell_row.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "chart/cell_columns.hpp"
#include "chart/vector_math.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

/// Factors with u1 u2' - u1' u2 = 1 over many sizes and all signs, with their turns.
struct Factors {
  std::vector<double> u1, u2, du1, du2, turns;
};

Factors random_factors(std::size_t count, double largest_log) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(-7.0, 7.0), log(-largest_log, largest_log);
  Factors f;
  for (std::size_t c = 0; c < count; ++c) {  // rotation, stretch, rotation
    const double a = angle(random), b = angle(random), s = std::exp(log(random));
    f.u1.push_back(std::cos(a) * s * std::cos(b) - std::sin(a) / s * std::sin(b));
    f.u2.push_back(-std::cos(a) * s * std::sin(b) - std::sin(a) / s * std::cos(b));
    f.du1.push_back(std::sin(a) * s * std::cos(b) + std::cos(a) / s * std::sin(b));
    f.du2.push_back(-std::sin(a) * s * std::sin(b) + std::cos(a) / s * std::cos(b));
    const double quarter_turns = std::atan2(f.u2[c], f.du2[c]) / std::acos(0.0);
    f.turns.push_back(4.0 * static_cast<double>(c % 5 + 1) + quarter_turns);
  }
  return f;
}

ProductTable constant(double value) {
  const Axis x{"x", 0.0, 1.0, CellRow::kMost}, y{"y", 0.0, 1.0, 2};
  return *ProductTable::of([value](double, double) { return value; }, x, y);
}

}  // namespace

TEST_CASE("cells in vector code are those of single points", "[chart][simd]") {
  const double h = GENERATE(0.0, 1e-9, 0.3, 20.0), kappa_square = GENERATE(0.5, 40.0);
  const bool shifted = GENERATE(false, true);
  const Factors f = random_factors(CellRow::kMost, 9.0);
  CellColumns columns;
  columns.set(constant(h), constant(kappa_square), 0, 0, CellRow::kMost);
  CellRow plain;
  plain.count = CellRow::kMost;
  plain.factors = {f.u1.data(), f.u2.data(), f.du1.data(), f.du2.data()};
  plain.quarter_turns = f.turns.data();
  plain.factor_error = {1e-12, 3e-12, 2e-12, 1e-13};
  plain.exponent = 1;
  plain.box_kappa = 2.0;
  plain.shifted = shifted;
  plain.with_growth = plain.with_winding = true;
  columns.give(plain);
  CellRow single = plain;
  plain_cells(plain);
  cells_in_log_form(single);
  for (std::size_t c = 0; c < CellRow::kMost; ++c) {
    INFO("cell " << c << ", h " << h << ", kappa^2 " << kappa_square);
    const double size = std::max(1.0, std::abs(single.margin[c]));
    CHECK(std::abs(plain.margin[c] - single.margin[c]) <= 1e-13 * size);
    CHECK(plain.verdict[c] == single.verdict[c]);
    CHECK(std::abs(plain.growth[c] - single.growth[c]) <= 1e-14 * std::max(1.0, std::abs(single.growth[c])));
    CHECK(std::abs(plain.winding[c] - single.winding[c]) <= 1e-14 * single.winding[c]);
    CHECK(std::abs(plain.trace[c] - single.trace[c]) <=
          1e-13 * std::exp(-h) * 8.0 * std::abs(f.u1[c] * f.du2[c]) + 1e-13 * std::abs(single.trace[c]));
    CHECK(plain.error[c] >= single.error[c] * (1.0 - 1e-12));
    CHECK(plain.error[c] <= 1.01 * single.error[c] + 4e-15);
  }
}

TEST_CASE("a factor that may be zero leaves the verdict open", "[chart][simd]") {
  Factors f = random_factors(16, 1.0);
  f.u1[3] = 1e-13;  // D = -2 within the bound
  f.u2[3] = -1.0;
  f.du1[3] = 1.0;
  f.du2[3] = 1.0;
  CellColumns columns;
  columns.set(constant(0.0), constant(1.0), 0, 0, 16);
  CellRow row;
  row.count = 16;
  row.factors = {f.u1.data(), f.u2.data(), f.du1.data(), f.du2.data()};
  row.factor_error.fill(1e-12);
  columns.give(row);
  plain_cells(row);
  CHECK(row.verdict[3] == static_cast<double>(Verdict::unresolved));
  CHECK(row.verdict[2] != static_cast<double>(Verdict::unresolved));
}

TEST_CASE("elementary functions in vector code are right to a few units", "[chart][simd]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-40.0, 40.0), share(0.0, 1.0);
  const auto units = [](double value, long double truth) {
    return static_cast<double>(std::abs((static_cast<long double>(value) - truth) / truth)) / 0x1p-53;
  };
  double log = 0.0, hyperbolic = 0.0, angle = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::exp(exponent(random) * (i % 2 == 0 ? 1.0 : 0.05)), a = share(random),
                 b = share(random);
    log = std::max(log, units(vector_math::log1p(x), std::log1p(static_cast<long double>(x))));
    hyperbolic =
        std::max(hyperbolic, units(vector_math::asinh(-x), std::asinh(-static_cast<long double>(x))));
    angle = std::max(
        angle, units(vector_math::atan_of_root(a, b), std::atan(std::sqrt(static_cast<long double>(a) / b))));
  }
  CHECK(log <= 2.0);
  CHECK(hyperbolic <= 3.0);
  CHECK(angle <= 5.0);
  CHECK(vector_math::nearest(-2.4) == -2.0);
}

}  // namespace strutt
