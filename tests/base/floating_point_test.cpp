#include "strutt/base/floating_point.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "support/host_environment.hpp"

namespace strutt::test::floating_point_test {
namespace {

/// Values that the compiler does not know.
double opaque(double x) {
  volatile double y = x;
  return y;
}

#ifdef __x86_64__
/// Compiled for a processor that could fuse it.
[[gnu::target("fma"), gnu::noinline]] double difference_of_products(double a, double b, double c, double d) {
  return a * b - c * d;
}
#endif

}  // namespace

TEST_CASE("the default environment is set, and the caller's comes back", "[base][extreme][N35][N49]") {
  for (const HostEnvironment::Kind kind : HostEnvironment::kAll) {
    const HostEnvironment host(kind);
    CAPTURE(host.name());
    REQUIRE_FALSE(HostEnvironment::is_default());
    {
      const DefaultFloatingPoint environment;
      CHECK(HostEnvironment::is_default());
      CHECK(opaque(1.0) + opaque(0x1p-53) == 1.0);          // to even
      CHECK(opaque(1.0) - opaque(0x1p-55) == 1.0);          // not down
      CHECK(opaque(0x1p-1060) * opaque(0.5) == 0x1p-1061);  // no subnormal number is lost
      CHECK(std::isinf(opaque(1e308) * opaque(10.0)));      // no trap
    }
    CHECK(HostEnvironment::is_now(kind));
  }
  CHECK(HostEnvironment::is_default());
  { const DefaultFloatingPoint environment; }
  CHECK(HostEnvironment::is_default());
}

TEST_CASE("a product and a sum are not fused behind our back", "[base][extreme][N43]") {
#ifdef __x86_64__
  if (!__builtin_cpu_supports("fma")) return;
  // the rounding error of a product, which a fused operation would find
  const double a = opaque(1.0 + 0x1p-30), b = opaque(1.0 - 0x1p-29);
  CHECK(difference_of_products(a, b, a, b) == 0.0);
  CHECK(std::fma(a, b, -(a * b)) != 0.0);
#endif
}

TEST_CASE("NaN is told apart and sums keep their rounding error", "[base][extreme][N44]") {
  const double nan = opaque(std::numeric_limits<double>::quiet_NaN());
  CHECK(std::isnan(nan));
  CHECK_FALSE(nan <= opaque(1.0));
  CHECK(nan != opaque(nan));
  const double a = opaque(1.0), b = opaque(0x1p-60);  // Moller and Knuth's exact sum
  const double sum = a + b, part = sum - a;
  CHECK((a - (sum - part)) + (b - part) == 0x1p-60);
  CHECK(std::signbit(opaque(-0.0) * opaque(1.0)));
}

TEST_CASE("a double is rounded once", "[base][extreme][N45]") {
  // rounded to 64 bits first it is half way, and then goes to the even neighbour, 1
  CHECK(opaque(1.0) + opaque(0x1p-53 + 0x1p-66) == 1.0 + 0x1p-52);
}

}  // namespace strutt::test::floating_point_test
