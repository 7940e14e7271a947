#include "chart/edge_function.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "support/scenes.hpp"

namespace strutt::test::edge_function_test {

TEST_CASE("between two places an edge of Mathieu's equation bends less than its bound", "[chart][tongues]") {
  const TongueLine line{"mathieu.epsilon", 0.0, 5.0};
  LineEquation equation(mathieu_scene(1.0, 0.0), line);
  for (const int order : {0, 1, 2, 5}) {
    KnownTongue tongue(order);
    EdgeFunction function(equation, tongue);
    double largest_share = 0.0;
    for (const double from : {0.0, 0.1, 1.0, 4.0}) {
      for (const bool upper : {false, true}) {
        if (order == 0 && !upper) continue;
        const double to = from + 0.2, middle = from + 0.1;
        const auto &a = function.at(from), &b = function.at(to), &between = function.at(middle);
        const auto bend = function.bend(a, b, upper);
        REQUIRE(bend);
        const double off = between.below(upper) - 0.5 * (a.below(upper) + b.below(upper));
        CAPTURE(order, from, upper);
        CHECK(std::abs(off) <= *bend + 1e-14);
        largest_share = std::max(largest_share, std::abs(off) / *bend);
      }
    }
    CHECK(largest_share > 0.01);  // and not by orders of magnitude
  }
}

TEST_CASE("nothing is said of the bend where the mean changes or epsilon changes its sign",
          "[chart][tongues]") {
  LineEquation equation(mathieu_scene(1.0, 0.5), {"mathieu.epsilon", -1.0, 1.0});
  KnownTongue tongue(2);
  EdgeFunction function(equation, tongue);
  CHECK_FALSE(function.bend(function.at(-0.1), function.at(0.1), true));
  CHECK(function.bend(function.at(-0.2), function.at(-0.1), true));
  LineEquation other(mathieu_scene(1.0, 0.5), {"mathieu.delta", 0.0, 1.0});
  KnownTongue moved_tongue(2);
  EdgeFunction moved(other, moved_tongue);
  CHECK_FALSE(moved.bend(moved.at(0.4), moved.at(0.5), true));
}

}  // namespace strutt::test::edge_function_test
