#include <catch2/catch.hpp>
#include <string>

#include "strutt/base/error.hpp"
#include "strutt/base/method.hpp"

namespace strutt::test::method_test {

using Catch::Contains;

TEST_CASE("method names read back", "[base][method]") {
  using enum Method;
  for (const Method method : {automatic, surrogate, propagator, cvode, arkode, fourier, exact}) {
    CHECK(method_from_string(to_string(method)) == method);
  }
  CHECK(to_string(automatic) == "auto");
  CHECK(to_string(exact) == "exact");
}

TEST_CASE("an unknown method is refused with the known ones", "[base][method]") {
  CHECK_THROWS_WITH(method_from_string("euler"), Contains("euler") && Contains("auto") && Contains("exact"));
  CHECK_THROWS_AS(method_from_string(""), InvalidInput);
  CHECK_THROWS_AS(method_from_string("Auto"), InvalidInput);
}

}  // namespace strutt::test::method_test
