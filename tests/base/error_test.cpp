#include <catch2/catch.hpp>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include "strutt/base/error.hpp"

namespace strutt::test::error_test {

using Catch::Contains;

TEST_CASE("a refused value is named with its field and its range", "[base][error]") {
  CHECK_THROWS_WITH(require(false, "length", -0.5, "a finite number > 0"),
                    Contains("length") && Contains("-0.5") && Contains("a finite number > 0"));
  CHECK_THROWS_AS(throw InvalidInput("a", "b", "c"), std::invalid_argument);
  CHECK_NOTHROW(require(true, "length", 1.0, "anything"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(require(nan > 0.0, "length", nan, "> 0"), Contains("nan"));
}

TEST_CASE("an input/output error keeps errno and says it in words", "[base][error]") {
  const InputOutputError error("chart.csv", ENOSPC);
  CHECK(error.error_number() == ENOSPC);
  CHECK_THAT(error.what(), Contains("chart.csv") && Contains(std::strerror(ENOSPC)));
  CHECK(std::string(InputOutputError("closed", 0).what()) == "closed");
}

TEST_CASE("the text of a double reads back to the same bits", "[base][error]") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isnan(value)) continue;
    const double back = std::strtod(to_text(value).c_str(), nullptr);
    CHECK(std::memcmp(&back, &value, sizeof value) == 0);
  }
  CHECK(to_text(0.1) == "0.1");
  CHECK(to_text(-0.0) == "-0");
  CHECK(to_text(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(to_text(-std::numeric_limits<double>::infinity()) == "-inf");
  CHECK(to_text(std::copysign(std::numeric_limits<double>::quiet_NaN(), -1.0)) == "nan");
  CHECK(to_text(std::numeric_limits<double>::denorm_min()) == "5e-324");
}

TEST_CASE("the nearest name", "[base][error]") {
  const std::vector<std::string> names{"length", "mass", "gravity", "damping"};
  CHECK(nearest("lenght", names) == "length");  // two substitutions
  CHECK(nearest("gravty", names) == "gravity");
  CHECK(nearest("dampings", names) == "damping");
  CHECK(nearest("mass", names) == "mass");
  CHECK(nearest("frequency", names).empty());
  CHECK(nearest("", names).empty());
  CHECK(nearest("mass", {}).empty());
}

TEST_CASE("an unknown word is answered with the nearest one, else with all", "[base][error]") {
  CHECK(suggestion("lenght", {"mass", "length"}) == "; did you mean 'length'?");
  CHECK(suggestion("z", {"x", "y"}) == "; known are 'x', 'y'");
  CHECK(suggestion("z", {}).empty());
  CHECK(quoted_list(std::vector<std::string>(12, "a")).ends_with(", 'a'"));
  CHECK(quoted_list(std::vector<std::string>(13, "a")).ends_with("'a', ... (13 in all)"));
}

}  // namespace strutt::test::error_test
