#include "strutt/base/instruction_set.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

namespace strutt::test::instruction_set_test {

TEST_CASE("the instruction set is one that has a name, and the one asked for", "[base][simd]") {
  const std::string name(to_string(instruction_set()));
  CHECK((name == "sse2" || name == "avx2" || name == "avx512"));
  const char* const asked = std::getenv("STRUTT_ISA");
  if (asked != nullptr && *asked != '\0') CHECK(name == asked);
}

}  // namespace strutt::test::instruction_set_test
