#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/floquet/tongue_edges.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt::test {

/// The edges of the tongues of x'' + (delta + V) x = 0 with their proved indices, ascending: unstable below
/// the first, then stable and unstable by turns.
class HillEdges {
 public:
  /// V = epsilon cos t, epsilon > 0.
  HillEdges(double epsilon, int last) {
    for (const auto& [order, a, b] : characteristic_values(0, last, 2.0 * epsilon)) {
      if (b) edges_.push_back({b->value / 4.0, b->error / 4.0});
      edges_.push_back({a.value / 4.0, a.error / 4.0});
    }
  }
  HillEdges(const PeriodicFunction& v, int last) {
    for (const auto& [order, lower, upper] : tongue_edges(v, 0, last)) {
      if (lower) edges_.push_back(*lower);
      edges_.push_back(upper);
    }
  }
  const CharacteristicValue& operator[](std::size_t k) const { return edges_[k]; }
  std::size_t size() const { return edges_.size(); }
  double highest() const { return edges_.back().value - edges_.back().error; }

  /// Nothing is known within the bound of an edge: unresolved.
  Verdict at(double delta) const {
    const auto above = std::partition_point(
        edges_.begin(), edges_.end(), [&](const auto& edge) { return edge.value + edge.error < delta; });
    if (above == edges_.end() || !(delta < above->value - above->error)) return Verdict::unresolved;
    return (above - edges_.begin()) % 2 == 1 ? Verdict::stable : Verdict::unstable;
  }

 private:
  std::vector<CharacteristicValue> edges_;
};

}  // namespace strutt::test
