// Cells that the discriminant alone tells.
#include "chart/trace_runs.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "chart/chebyshev.hpp"
#include "chart/surrogate_grid.hpp"

namespace strutt::test::trace_runs_test {
namespace {

constexpr double kLeastGap = 0.05;

/// All runs of a row.
std::vector<CellRun> runs_of(const std::vector<double>& trace, std::size_t count) {
  TraceRuns runs;
  runs.begin(trace.data(), count);
  for (std::size_t first = 0; first < count; first += TraceRuns::kMostAdded)
    runs.add(std::min(TraceRuns::kMostAdded, count - first), kLeastGap);
  return runs.runs();
}

bool is_on(TraceSide side, double d) {
  switch (side) {
    case TraceSide::between:
      return std::abs(d) < 2.0 - kLeastGap;
    case TraceSide::above:
      return d > 2.0 + kLeastGap;
    case TraceSide::below:
      return d < -2.0 - kLeastGap;
    case TraceSide::near:
      break;
  }
  return true;
}

/// A row of D, readable to the next multiple of 8 cells.
template <typename Function>
std::vector<double> row_of(std::size_t count, const Function& function) {
  std::vector<double> trace(count + 8, 0.0);
  for (std::size_t c = 0; c < count; ++c) trace[c] = function(static_cast<double>(c));
  return trace;
}

}  // namespace

TEST_CASE("runs follow each other, and in each but the near ones all cells are on one side",
          "[chart][simd]") {
  const std::size_t count = GENERATE(1, 7, 8, 9, 48, 49, 240, 241, 1000, 2160);
  const double steepness = GENERATE(0.003, 0.02, 0.3, 3.0);
  const auto trace = row_of(count, [&](double c) { return 6.0 * std::sin(steepness * c); });
  const auto runs = runs_of(trace, count);
  std::size_t next = 0, far = 0;
  for (const CellRun& run : runs) {
    CAPTURE(count, steepness, run.first, run.last);
    CHECK(run.first == next);
    CHECK(run.last > run.first);
    next = run.last;
    if (run.side == TraceSide::near) continue;
    far += run.last - run.first;
    REQUIRE(run.first > 0);
    for (std::size_t c = run.first - 1; c < run.last; ++c) CHECK(is_on(run.side, trace[c]));
  }
  CHECK(next == count);
  CHECK(runs.front().side == TraceSide::near);
  CHECK(runs.back().side == TraceSide::near);
  if (count > 900 && steepness == 0.003) CHECK(far > count * 8 / 10);
}

TEST_CASE("a step from one side to the other makes its cells near", "[chart][simd]") {
  const std::size_t at = GENERATE(96, 100, 480, 485);
  const auto trace = row_of(1000, [&](double c) { return c < static_cast<double>(at) ? 1.0 : 9.0; });
  for (const CellRun& run : runs_of(trace, 1000))
    if (run.first <= at && at < run.last) CHECK(run.side == TraceSide::near);
}

TEST_CASE("what is no number is near", "[chart][simd]") {
  auto trace = row_of(500, [](double) { return 0.5; });
  trace[250] = std::numeric_limits<double>::quiet_NaN();
  for (const CellRun& run : runs_of(trace, 500))
    if (run.first <= 250 && 250 < run.last) CHECK(run.side == TraceSide::near);
}

TEST_CASE("between cells a function leaves its chord by no more than the grid says", "[chart][surrogate]") {
  // one function of a box, 24 x 3 terms, on 700 columns, so that there are panels
  const bool ascending = GENERATE(true, false);
  SurrogateBox box;
  box.interpolated = true;
  box.low = {0.0, 0.0};
  box.high = {3.0, 1.0};
  Eigen::MatrixXd c(24, 3);
  for (Eigen::Index k = 0; k < 24; ++k)
    for (Eigen::Index l = 0; l < 3; ++l)
      c(k, l) = std::cos(3.0 * static_cast<double>(k + 5 * l)) * std::pow(0.7, static_cast<double>(k + l));
  box.coefficients = {c};
  box.error = {1e-9};
  constexpr std::size_t columns = 1500, rows = 5;
  const Axis x{"x", ascending ? 0.0 : 3.0, ascending ? 3.0 : 0.0, columns}, y{"y", 0.0, 1.0, rows};
  SurrogateGrid grid({box}, x, y);
  const auto pieces = grid.pieces(0, rows);
  REQUIRE(pieces.size() == 1);
  const auto value = [&](double px, double py) {
    Eigen::MatrixXd in_x, in_y;
    chebyshev::polynomials(std::vector{px / 1.5 - 1.0}, 23, in_x);
    chebyshev::polynomials(std::vector{2.0 * py - 1.0}, 2, in_y);
    return (in_x * c * in_y.transpose())(0, 0);
  };
  double largest_share = 0.0;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t i = 1; i < columns; ++i) {
      const double bend = grid.bend({0, r, 1, i, 1}, 0);
      const double a = x.value(i - 1), b = x.value(i), py = y.value(r);
      for (const double share : {0.3, 0.5, 0.8}) {
        const double chord = std::lerp(value(a, py), value(b, py), share);
        const double off = std::abs(value(std::lerp(a, b, share), py) - chord);
        CHECK(off <= bend + 1e-14);
        largest_share = std::max(largest_share, off / bend);
      }
    }
  }
  CHECK(largest_share > 0.02);
}

}  // namespace strutt::test::trace_runs_test
