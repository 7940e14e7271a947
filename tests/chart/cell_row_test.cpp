// The vector code of chart cells against the code of single points.
#include "chart/cell_row.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "chart/cell_columns.hpp"
#include "strutt/floquet/verdict.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::cell_row_test {

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

constexpr std::size_t kCells = 509;  // no whole number of registers

ProductTable constant(double value) {
  const Axis x{"x", 0.0, 1.0, kCells}, y{"y", 0.0, 1.0, 2};
  return *ProductTable::of([value](double, double) { return value; }, x, y);
}

/// A row with room for all results.
struct Row : CellRow {
  std::vector<double> results[6];

  Row(const Factors& f, std::size_t cells) {
    count = cells;
    factors = {f.u1.data(), f.u2.data(), f.du1.data(), f.du2.data()};
    for (auto& values : results) values.assign(cells + 1, -77.0);
    error = results[0].data();
    verdict = results[1].data();
    margin = results[2].data();
    growth = results[3].data();
    winding = results[4].data();
    trace = results[5].data();
  }
  Row(const Row&) = delete;
};

}  // namespace

TEST_CASE("cells in vector code are those of single points", "[chart][simd][ratchet]") {
  const double h = GENERATE(0.0, 1e-9, 0.3, 20.0), kappa_square = GENERATE(0.5, 40.0);
  const bool shifted = GENERATE(false, true);
  Factors f = random_factors(kCells + 8, 9.0);
  for (auto* values : {&f.u1, &f.u2, &f.du1, &f.du2}) {
    for (double& value : *values) value *= 0.5;  // in units of 2^exponent
  }
  CellColumns columns;
  columns.set(constant(h), constant(kappa_square), 0, 0, kCells);
  Row plain(f, kCells), single(f, kCells);
  for (Row* row : {&plain, &single}) {
    row->quarter_turns = f.turns.data();
    row->factor_error = {1e-12, 3e-12, 2e-12, 1e-13};
    row->exponent = 1;
    row->box_kappa = 2.0;
    row->shifted = shifted;
    row->damped = h != 0.0;
    columns.give(*row, 0);
  }
  plain_cells(plain);
  cells_in_log_form(single);
  CHECK(plain.all_resolved == single.all_resolved);
  CHECK(plain.largest_error == *std::max_element(plain.error, plain.error + kCells));
  for (const auto& values : plain.results) CHECK(values[kCells] == -77.0);
  for (std::size_t c = 0; c < kCells; ++c) {
    INFO("cell " << c << ", h " << h << ", kappa^2 " << kappa_square);
    const double size = std::max(1.0, std::abs(single.margin[c]));
    check_within("margin of a cell in vector code over max(1; |margin|)",
                 std::abs(plain.margin[c] - single.margin[c]) / size, 8e-16);
    CHECK(plain.verdict[c] == single.verdict[c]);
    check_within("growth of a cell in vector code over max(1; |growth|)",
                 std::abs(plain.growth[c] - single.growth[c]) / std::max(1.0, std::abs(single.growth[c])),
                 8e-16);
    check_close("winding of a cell in vector code (relative)", plain.winding[c], single.winding[c], 8e-16);
    const double terms = std::exp(-h) * 32.0 * std::abs(f.u1[c] * f.du2[c]) + std::abs(single.trace[c]);
    check_within("trace of a cell in vector code over its terms",
                 std::abs(plain.trace[c] - single.trace[c]) / terms, 2.5e-15);
    CHECK(plain.error[c] >= single.error[c] * (1.0 - 1e-12));
    CHECK(plain.error[c] <= 1.01 * single.error[c] + 2e-14);
  }
}

/// The same, changing slowly from cell to cell, as on a chart: a tongue and the bands beside it.
Factors smooth_factors(std::size_t count) {
  Factors f;
  for (std::size_t c = 0; c < count; ++c) {
    const double a = 1.0 + 0.002 * static_cast<double>(c), s = std::exp(0.002 * static_cast<double>(c));
    f.u1.push_back(std::cos(a) * s);
    f.u2.push_back(-std::sin(a) / s);
    f.du1.push_back(std::sin(a) * s);
    f.du2.push_back(std::cos(a) / s);
    f.turns.push_back(0.0);
  }
  return f;
}

TEST_CASE("errors are bounded by what blocks of cells have in common", "[chart][simd]") {
  const bool shifted = GENERATE(false, true), is_smooth = GENERATE(false, true);
  const double h = GENERATE(0.0, 0.3);
  const std::size_t cells = GENERATE(std::size_t{1}, std::size_t{5}, std::size_t{64}, kCells);
  const Factors f = is_smooth ? smooth_factors(kCells + 8) : random_factors(kCells + 8, 9.0);
  CellColumns columns;
  columns.set(constant(h), constant(0.5), 0, 0, kCells);
  Row each(f, cells), in_blocks(f, cells);
  in_blocks.error = nullptr;
  for (Row* const row : {&each, &in_blocks}) {
    row->quarter_turns = f.turns.data();
    row->factor_error = {1e-12, 3e-12, 2e-12, 1e-13};
    row->shifted = shifted;
    row->damped = h != 0.0;
    columns.give(*row, 0);
    plain_cells(*row);
  }
  CHECK(in_blocks.largest_error >= each.largest_error * (1.0 - 1e-15));
  if (is_smooth) CHECK(in_blocks.largest_error <= 1.5 * each.largest_error);
  for (std::size_t c = 0; c < cells; ++c) {
    if (in_blocks.verdict[c] != static_cast<double>(Verdict::unresolved))
      CHECK(in_blocks.verdict[c] == each.verdict[c]);
    CHECK(in_blocks.margin[c] == each.margin[c]);
    CHECK(in_blocks.growth[c] == each.growth[c]);
  }
}

TEST_CASE("a row with a cell that is no number has no bound", "[chart][simd]") {
  Factors f = random_factors(16, 1.0);
  f.u1[11] = std::nan("");
  CellColumns columns;
  columns.set(constant(0.0), constant(1.0), 0, 0, 16);
  const bool each = GENERATE(false, true);
  Row row(f, 16);
  row.winding = nullptr;
  if (!each) row.error = nullptr;
  columns.give(row, 0);
  plain_cells(row);
  CHECK_FALSE(row.largest_error <= 1e300);
}

TEST_CASE("a factor that may be zero leaves the verdict open", "[chart][simd]") {
  Factors f = random_factors(16, 1.0);
  f.u1[3] = 1e-13;  // D = -2 within the bound
  f.u2[3] = -1.0;
  f.du1[3] = 1.0;
  f.du2[3] = 1.0;
  CellColumns columns;
  columns.set(constant(0.0), constant(1.0), 0, 0, 16);
  Row row(f, 16);
  row.winding = nullptr;
  row.factor_error.fill(1e-12);
  columns.give(row, 0);
  plain_cells(row);
  CHECK(row.verdict[3] == static_cast<double>(Verdict::unresolved));
  CHECK(row.verdict[2] != static_cast<double>(Verdict::unresolved));
  CHECK_FALSE(row.all_resolved);
}

TEST_CASE("turns are followed from cell to cell by the signs", "[chart][simd][ratchet]") {
  constexpr std::size_t cells = 300;
  const double step = GENERATE(0.05, 0.9, 1.7);  // in quarter turns
  Factors f;
  for (std::size_t c = 0; c < cells + 8; ++c) {
    const double angle = (5.3 + step * static_cast<double>(c)) * std::acos(0.0);
    f.u1.push_back(std::cos(angle));
    f.u2.push_back(std::sin(angle));
    f.du1.push_back(-std::sin(angle));
    f.du2.push_back(std::cos(angle));
  }
  CellColumns columns;
  columns.set(constant(0.0), constant(1.0), 0, 0, cells);
  for (const auto& compute : {plain_cells, cells_in_log_form}) {
    Row row(f, cells);
    row.damped = false;
    row.turns = {5.0, 1, 0};
    columns.give(row, 0);
    compute(row);
    CHECK((row.turns.doubts == 0) == (step < 1.0));
    if (step > 1.0) continue;
    CHECK(row.turns.quadrant == std::floor(5.3 + step * static_cast<double>(cells - 1)));
    // a rotation by half of it over half a period
    for (std::size_t c = 0; c < cells; ++c)
      check_close("winding of cells on a line (relative)", row.winding[c],
                  0.5 * (5.3 + step * static_cast<double>(c)), 8e-16);
  }
}

TEST_CASE("cells told by the discriminant are those told by their factors", "[chart][simd][ratchet]") {
  const double h = GENERATE(0.0, 1e-9, 0.3);
  const int side = GENERATE(-1, 0, 1);  // D below -2, between, above 2
  constexpr std::size_t cells = 301;
  Factors f;
  std::vector<double> d;
  for (std::size_t c = 0; c < cells + 8; ++c) {
    const double share = static_cast<double>(c) / (cells + 8);
    d.push_back(side == 0 ? 1.98 - 3.96 * share : side * (2.02 * std::exp(20.0 * share)));
    // u1' u2 = (D - 2)/4, u1 u2' = (D + 2)/4
    f.u1.push_back(0.7);
    f.u2.push_back(1.3);
    f.du1.push_back((0.25 * d[c] - 0.5) / 1.3);
    f.du2.push_back((0.25 * d[c] + 0.5) / 0.7);
  }
  CellColumns columns;
  columns.set(constant(h), constant(1.0), 0, 0, cells);
  Row by_factors(f, cells), by_trace(f, cells);
  by_factors.factor_error = {1e-13, 1e-13, 1e-13, 1e-13};
  for (Row* row : {&by_factors, &by_trace}) {
    row->damped = h != 0.0;
    columns.give(*row, 0);
    row->turns = {sign_quadrant(f.u2[0], f.du2[0]) + 8.0, sign_quadrant(f.u2[0], f.du2[0]), 0};
    row->error = nullptr;
  }
  by_trace.discriminant = d.data();
  by_trace.discriminant_error = 1e-12;
  by_trace.discriminant_bound = 1e-11;
  plain_cells(by_factors);
  plain_cells(by_trace);
  CHECK(by_trace.largest_error == 1e-12);
  CHECK(by_trace.all_resolved == by_factors.all_resolved);
  for (const auto& values : by_trace.results) CHECK(values[cells] == -77.0);
  for (std::size_t c = 0; c < cells; ++c) {
    INFO("cell " << c << ", D " << d[c] << ", h " << h);
    CHECK(by_trace.verdict[c] == by_factors.verdict[c]);
    check_within(
        "trace of a cell by D alone over max(1; |trace|)",
        std::abs(by_trace.trace[c] - by_factors.trace[c]) / std::max(1.0, std::abs(by_factors.trace[c])),
        1.5e-15);
    check_within(
        "margin of a cell by D alone over max(1; |margin|)",
        std::abs(by_trace.margin[c] - by_factors.margin[c]) / std::max(1.0, std::abs(by_factors.margin[c])),
        1.5e-15);
    check_within("growth of a cell by D alone (to 0.02 of an edge)",
                 std::abs(by_trace.growth[c] - by_factors.growth[c]), 2e-14);
    CHECK(std::abs(by_trace.winding[c] - by_factors.winding[c]) <= 4e-16);
  }
  // the verdict alone needs no arithmetic without damping
  Row verdicts(f, cells);
  verdicts.error = verdicts.margin = verdicts.growth = verdicts.winding = verdicts.trace = nullptr;
  verdicts.damped = h != 0.0;
  columns.give(verdicts, 0);
  verdicts.discriminant = d.data();
  verdicts.discriminant_bound = 1e-11;
  plain_cells(verdicts);
  for (std::size_t c = 0; c < cells; ++c) CHECK(verdicts.verdict[c] == by_factors.verdict[c]);
}

TEST_CASE("logarithm and arc sine in vector code are right to a few units", "[chart][simd]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-40.0, 40.0), share(0.0, 1.0);
  constexpr std::size_t cells = 500;
  const auto units = [](double value, long double truth) {
    return static_cast<double>(std::abs((static_cast<long double>(value) - truth) / truth)) / 0x1p-53;
  };
  double largest_log = 0.0, largest_angle = 0.0;
  CellColumns columns;
  columns.set(constant(0.0), constant(1.0), 0, 0, cells);
  for (int i = 0; i < 200; ++i) {
    Factors f;
    std::vector<double> x;
    for (std::size_t c = 0; c < cells + 8; ++c) {  // D/2 = 1 + x, 1 - 2 s in turns
      const bool unstable = (c / 40) % 2 == 0;
      x.push_back(unstable ? std::exp(exponent(random) * (c % 2 == 0 ? 1.0 : 0.05)) : share(random));
      const double upper = unstable ? 0.5 * x[c] : -x[c];
      f.u1.push_back(1.0);
      f.u2.push_back(1.0);
      f.du1.push_back(upper);
      f.du2.push_back(1.0 + upper);
    }
    Row row(f, cells);
    row.damped = false;
    columns.give(row, 0);
    row.turns = {0.0, sign_quadrant(f.u2[0], f.du2[0]), 0};
    plain_cells(row);
    for (std::size_t c = 0; c < cells; ++c) {
      const auto exact = static_cast<long double>(x[c]);
      if ((c / 40) % 2 == 0) {
        largest_log = std::max(largest_log,
                               units(row.growth[c], std::log1p(exact + std::sqrt(exact * (2.0L + exact)))));
      } else {
        largest_angle =
            std::max(largest_angle, units(row.winding[c], std::asin(std::sqrt(exact)) / std::acos(-1.0L)));
      }
    }
  }
  CHECK(largest_log <= 4.0);
  CHECK(largest_angle <= 5.0);
}

}  // namespace strutt::test::cell_row_test
