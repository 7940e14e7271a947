#pragma once

#include <optional>
#include <vector>

#include "chart/edge_function.hpp"
#include "chart/extended_edge.hpp"
#include "chart/stability_line.hpp"

namespace strutt {

/// Whether a line of a scene with an index has damping anywhere.
bool is_damped(const Scene& scene, const TongueLine& line);

/// tongues() order by order, where tongues have an index (has_tongue_index).
class TonguesOfOrder {
 public:
  TonguesOfOrder(MonodromyEngine& engine, const Scene& scene, const TongueLine& line,
                 const TongueOptions& options, Evaluations* evaluations = nullptr);

  std::vector<TongueEdge> edges(KnownTongue& tongue);

 private:
  TongueLine line_;
  TongueOptions options_;
  LineEquation equation_;
  bool changes_;  ///< whether anything changes along the line
  std::optional<StabilityLine> verdicts_;
  ExtendedEdges extended_;
};

}  // namespace strutt
