// Numbers with units, as scenes and columns hold them.
#include <catch2/catch.hpp>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt::test::quantity_test {

TEST_CASE("quantities with units", "[io][scene_file][quantity]") {
  CHECK(parse_quantity("25 cm", "m") == 0.25);
  CHECK(parse_quantity("7cm", "m") == 0.07);
  CHECK(parse_quantity("2.5e-1 mm", "m") == 2.5e-4);
  CHECK(parse_quantity("-3 \xC2\xB5m", "m") == -3e-6);
  CHECK(parse_quantity("1 in", "m") == 0.0254);
  CHECK(parse_quantity("12 rad/s", "rad/s") == 12.0);
  CHECK(parse_quantity("2 Hz", "rad/s") == 4 * std::numbers::pi);
  CHECK(parse_quantity("60 rpm", "rad/s") == 2 * std::numbers::pi);
  CHECK(parse_quantity("180 deg", "rad") == std::numbers::pi);
  CHECK(parse_quantity("90\xC2\xB0", "rad") == std::numbers::pi / 2);
  CHECK(parse_quantity("5 kg\xC2\xB7m\xC2\xB2", "kg m^2") == 5.0);
  CHECK(parse_quantity("5 g*cm^2", "kg m^2") == 5e-7);
  CHECK(parse_quantity("5 N m", "N m") == 5.0);
  CHECK(parse_quantity("981 cm/s^2", "m/s^2") == 9.81);
  CHECK(parse_quantity("3 ms", "s") == 0.003);
  CHECK(parse_quantity("0.5 1/s", "1/s") == 0.5);
  CHECK(parse_quantity("  1.5  ", "m") == 1.5);
  CHECK(parse_quantity("1.5", "") == 1.5);
  CHECK(parse_quantity("1e0 m", "m") == 1.0);
}

TEST_CASE("quantities that make no sense", "[io][scene_file][quantity]") {
  const std::string text = GENERATE("", "m", "1 s", "1 Hz", "1 parsec", "nan", "inf m", "1e999 m", "1e308 km",
                                    "1 2 m", "0x10 m", "1,5 m", "1..5 m", "1 \x1b m", "- 1 m", "1e m");
  CHECK_THROWS_AS(parse_quantity(text, "m"), InvalidInput);
  CHECK_THROWS_AS(parse_quantity("1 Hz", "1/s"), InvalidInput);
  CHECK_THROWS_AS(parse_quantity("1 m", ""), InvalidInput);
}

}  // namespace strutt::test::quantity_test
