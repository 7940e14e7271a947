#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/stability.hpp"

/// What tests ask of the edges of tongues.
namespace strutt::test {

inline Stability stability_at(Scene scene, const std::string& path, double value) {
  parameter(scene, path) = value;
  static MonodromyEngine engine;
  return analyse(engine, linear_model(scene), {.tolerance = 1e-13}, {.winding = true, .matrix = false});
}

inline double absolute_error(const TongueEdge& edge) {
  return edge.error * std::max(1.0, std::abs(edge.position));
}

inline std::vector<TongueEdge> of_order(const std::vector<TongueEdge>& edges, int order) {
  std::vector<TongueEdge> result;
  std::ranges::copy_if(edges, std::back_inserter(result), [&](const auto& e) { return e.order == order; });
  return result;
}

}  // namespace strutt::test
