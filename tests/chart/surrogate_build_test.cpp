// What becomes of a box whose check fails.
#include "chart/surrogate_build.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "chart/hill_nodes.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt::test::surrogate_build_test {

namespace {

constexpr double kTolerance = 1e-8;

/// Nodes of which those with x above `from` are wrong by a smooth function of the size `wrong`, with bounds
/// as before; the referee is right.
SurrogateBuild build_with(const Scene& scene, const Axis& x, const Axis& y, double wrong) {
  HillNodes nodes(scene, x, y, 0.0, {.threads = 1});
  const auto sample = [&](const std::vector<std::array<double, 2>>& points,
                          std::vector<PropagatorSample>& result) {
    return nodes.sample(points, 1e-14, result);
  };
  const auto wrong_sample = [&](const std::vector<std::array<double, 2>>& points,
                                std::vector<PropagatorSample>& result) {
    const bool complete = sample(points, result);
    for (std::size_t i = 0; i < points.size(); ++i)
      result[i].value(0, 1) += std::ldexp(wrong * points[i][1], static_cast<int>(-result[i].exponent));
    return complete;
  };
  return build_surrogate(scene, x, y, {.tolerance = kTolerance, .threads = 1}, surrogate_scope(scene, x, y),
                         {wrong_sample, sample});
}

}  // namespace

TEST_CASE("a box that fails its check is left to point by point and says so", "[chart][surrogate]") {
  const Scene scene = parse_scene("[mathieu]\ndelta = 1\nepsilon = 0.5\n", "scene").scene;
  const Axis x{"mathieu.delta", 1.0, 3.0, 500}, y{"mathieu.epsilon", 0.0, 1.0, 500};
  const auto right = build_with(scene, x, y, 0.0);
  CHECK(right.data.report.failed_checks == 0);
  CHECK(right.data.report.largest_check <= 1.0);
  CHECK(right.data.report.boxes == 1);
  const auto failed = build_with(scene, x, y, 1e-6);
  CHECK(failed.data.report.failed_checks == 1);
  CHECK(failed.data.report.boxes == 0);
  CHECK(failed.data.report.boxes_left_out == 0);
  CHECK(failed.data.report.largest_check > 1.0);
  REQUIRE(failed.data.boxes.size() == 1);
  CHECK_FALSE(failed.data.boxes[0].interpolated);
  const Surrogate surrogate(failed.data);
  CHECK_FALSE(surrogate.monodromy(2.0, 0.5));
  CHECK_FALSE(surrogate.gradient(2.0, 0.5));
  CHECK(Surrogate(right.data).monodromy(2.0, 0.5));
}

}  // namespace strutt::test::surrogate_build_test
