#pragma once

#include <catch2/catch.hpp>
#include <cstring>
#include <string>
#include <vector>

#include "support/host_environment.hpp"

namespace strutt::test {

using Numbers = std::vector<double>;

inline bool same_bits(const Numbers& a, const Numbers& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Numbers with and without a host that has changed the environment.
template <typename Compute>
void check_same(Compute compute) {
  const Numbers expected = compute();
  REQUIRE(expected.size() > 20);
  for (const auto kind : HostEnvironment::kAll) {
    Numbers found;
    bool kept = false;
    std::string name;
    {
      const HostEnvironment host(kind);
      name = host.name();
      found = compute();
      kept = HostEnvironment::is_now(kind);
    }
    INFO(name);
    CHECK(kept);
    CHECK(same_bits(found, expected));
  }
}

}  // namespace strutt::test
