#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt::test {

/// The edges of Mathieu's tongues at one epsilon > 0, ascending: below the first unstable, then by turns.
class MathieuEdges {
 public:
  MathieuEdges(double epsilon, int last) {
    for (const auto& [order, a, b] : characteristic_values(0, last, 2.0 * epsilon)) {
      if (b) edges_.push_back({b->value / 4.0, b->error / 4.0});
      edges_.push_back({a.value / 4.0, a.error / 4.0});
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
