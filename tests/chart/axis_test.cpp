#include "strutt/chart/axis.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "io/scratch.hpp"
#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::axis_test {

namespace {

constexpr auto kLog = AxisScale::logarithmic;

Axis axis(double from, double to, std::size_t points, AxisScale scale = AxisScale::linear) {
  return {.parameter = "mathieu.delta", .from = from, .to = to, .points = points, .scale = scale};
}

std::string refusal(const Axis& wrong) {
  return test::message_of<InvalidInput>([&] { wrong.validate("x"); });
}

}  // namespace

TEST_CASE("both ends of an axis are exact", "[chart][axis][extreme][N39]") {
  // 1.1 and 2.3 have no short binary form: from + (to - from) would miss the end.
  for (const auto& [from, to] : {std::pair{0.1, 0.7}, {1.1, 2.3}, {-1e-3, 1e16}, {1e300, -1e300}}) {
    const Axis line = axis(from, to, 37);
    CHECK(line.value(0) == from);
    CHECK(line.value(36) == to);
  }
  CHECK(axis(0.3, 7.7, 12, kLog).value(0) == 0.3);
  CHECK(axis(0.3, 7.7, 12, kLog).value(11) == 7.7);
}

TEST_CASE("linear axes are equidistant and monotone, reversed ones too",
          "[chart][axis][extreme][N39][ratchet]") {
  const Axis line = axis(-1.0, 5.0, 13);
  for (std::size_t j = 0; j < 13; ++j)
    check_within("N39 linear axis", std::abs(line.value(j) - (-1.0 + 0.5 * static_cast<double>(j))), 1e-15);
  const Axis reversed = axis(0.7, 0.1, 101);
  for (std::size_t j = 1; j < 101; ++j) CHECK(reversed.value(j) < reversed.value(j - 1));
}

TEST_CASE("the whole range of double does not overflow", "[chart][axis][extreme][N39]") {
  constexpr double largest = std::numeric_limits<double>::max();
  CHECK(axis(-largest, largest, 3).value(1) == 0.0);
}

TEST_CASE("logarithmic axes have a constant ratio, on either side of zero",
          "[chart][axis][extreme][N40][ratchet]") {
  const Axis decades = axis(1e-3, 1e3, 7, kLog);
  for (std::size_t j = 0; j < 7; ++j)
    check_close("N40 logarithmic axis (relative)", decades.value(j),
                std::pow(10.0, static_cast<double>(j) - 3.0), 2e-15);
  const Axis negative = axis(-1e-2, -1e2, 5, kLog);
  for (std::size_t j = 0; j < 5; ++j)
    check_close("N40 logarithmic axis (relative)", negative.value(j),
                -std::pow(10.0, static_cast<double>(j) - 2.0), 2e-15);
  CHECK_NOTHROW(negative.validate("y"));
  CHECK_NOTHROW(axis(1e-320, 1e-310, 5, kLog).validate("y"));  // the product of the ends underflows
}

TEST_CASE("an axis of one point", "[chart][axis][extreme][N39]") {
  CHECK(axis(0.3, 0.3, 1).value(0) == 0.3);
  CHECK_NOTHROW(axis(0.3, 0.3, 1).validate("x"));
  CHECK_NOTHROW(axis(-0.3, -0.3, 1, kLog).validate("x"));
  CHECK(refusal(axis(0.3, 0.4, 1)).find("equal to from (0.3)") != std::string::npos);
}

TEST_CASE("axes that make no sense are refused, with the field and the range",
          "[chart][axis][extreme][N36][N39][N40]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  CHECK(refusal(axis(nan, 1.0, 3)) == "x axis: from = nan is not allowed: it must be finite");
  CHECK(refusal(axis(0.0, -inf, 3)) == "x axis: to = -inf is not allowed: it must be finite");
  CHECK(refusal(axis(0.0, 1.0, 0)) == "x axis: points = 0 is not allowed: it must be at least 1");
  CHECK(refusal(axis(2.0, 2.0, 3)).find("the range is empty") != std::string::npos);
  for (const auto& [from, to] : {std::pair{-1.0, 1.0}, {0.0, 1.0}, {1.0, 0.0}, {-1.0, 0.0}, {-0.0, 1.0}}) {
    INFO(from << " to " << to);
    CHECK(refusal(axis(from, to, 3, kLog)).find("logarithmic axis") != std::string::npos);
  }
}

}  // namespace strutt::test::axis_test
