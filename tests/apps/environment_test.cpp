// The program beside a library that changes the floating-point unit, and with another mathematical library.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "io/scratch.hpp"
#include "support/program.hpp"

namespace strutt::test::environment_test {
namespace {

using Words = std::vector<std::string>;

/// The answer of `strutt stability` for a table of points.
std::string answer(const std::string& scene, const std::string& points, const Words& environment) {
  const ScratchDirectory directory;
  directory.with("scene.toml", scene);
  directory.with("points.csv", points);
  const Result result = strutt({"stability", "scene.toml", "--points", "points.csv", "--quiet"},
                               {.environment = environment, .directory = directory.path()});
  REQUIRE(result.code <= 1);
  REQUIRE(result.err.empty());
  return result.out;
}

std::size_t column(const Words& head, const std::string& name) {
  const auto found = std::find(head.begin(), head.end(), name);
  REQUIRE(found != head.end());
  return static_cast<std::size_t>(found - head.begin());
}

/// The largest |difference| of the margins over the sum of their bounds. Verdicts are the same or open.
double disagreement(const std::string& one, const std::string& other) {
  const auto a = csv_rows(one), b = csv_rows(other);
  REQUIRE(a.size() == b.size());
  REQUIRE(a.size() > 2);
  const std::size_t verdict = column(a[0], "verdict"), margin = column(a[0], "margin"),
                    error = column(a[0], "margin_error");
  double largest = 0.0;
  for (std::size_t row = 1; row < a.size(); ++row) {
    const std::string &va = a[row][verdict], &vb = b[row][verdict];
    CHECK((va == vb || va == "unresolved" || vb == "unresolved"));
    const double difference = std::abs(std::stod(a[row][margin]) - std::stod(b[row][margin]));
    if (difference > 0.0)
      largest = std::max(largest, difference / (std::stod(a[row][error]) + std::stod(b[row][error])));
  }
  return largest;
}

}  // namespace

#ifdef __SSE2__
TEST_CASE("a library that takes subnormal numbers away as it is loaded changes no answer",
          "[apps][extreme][N35][preload]") {
  const std::string points =
      "mathieu.delta,mathieu.epsilon\n-1e-310,0\n1e-310,0\n1,0.5\n0.3,1e-310\n-2e5,1\n";
  const Words spoilt{"LD_PRELOAD=" STRUTT_FAST_MATH_LIBRARY};
  const std::string expected = answer("[mathieu]\n", points, {"SOURCE_DATE_EPOCH=1"});
  CHECK(answer("[mathieu]\n", points, {spoilt[0], "SOURCE_DATE_EPOCH=1"}) == expected);
  const auto rows = csv_rows(expected);
  CHECK(rows[1][column(rows[0], "verdict")] == "unresolved");  // where 0 would be a boundary
}
#endif

TEST_CASE("the sines of an older processor move results within their bounds", "[apps][extreme][N47]") {
  // The C library chooses its functions by the processor; those without FMA differ in last bits.
  const Words older{"GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2_Usable,-AVX2,-FMA_Usable,-FMA,-FMA4_Usable,-FMA4"};
  std::string waves = "hill.mean,hill.amplitude\n",
              cosines = "mathieu.delta,mathieu.epsilon,mathieu.damping\n";
  for (int k = 0; k < 300; ++k) {
    const double x = 0.0137 * k * k;
    waves += std::to_string(x) + "," + std::to_string(0.31 * k) + "\n";
    cosines +=
        std::to_string(x - 20.0) + "," + std::to_string(0.11 * k) + "," + std::to_string(1e-3 * k) + "\n";
  }
  const std::string square = "[hill]\nperiod = 6\nwaveform = \"square\"\n";
  double largest = disagreement(answer(square, waves, {}), answer(square, waves, older));
  largest = std::max(largest,
                     disagreement(answer("[mathieu]\n", cosines, {}), answer("[mathieu]\n", cosines, older)));
  CHECK(largest <= 1.0);
}

}  // namespace strutt::test::environment_test
