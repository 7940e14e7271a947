#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "strutt/base/outcome.hpp"

namespace strutt::test::outcome_test {

TEST_CASE("every outcome has a name of its own", "[base][outcome]") {
  std::set<std::string> names;
  for (int i = 0; i < kOutcomeCount; ++i) names.emplace(to_string(static_cast<Outcome>(i)));
  CHECK(names.size() == kOutcomeCount);
  CHECK(to_string(Outcome::converged) == "converged");
  CHECK(to_string(Outcome::tolerance_not_reached) == "tolerance_not_reached");
  CHECK(to_string(Outcome::step_underflow) == "step_underflow");
  CHECK(to_string(Outcome::non_finite) == "non_finite");
  CHECK(to_string(Outcome::cancelled) == "cancelled");
  CHECK(static_cast<int>(Outcome::failed) + 1 == kOutcomeCount);
}

}  // namespace strutt::test::outcome_test
