#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "strutt/chart/tradeoff.hpp"

namespace strutt {

/// Draws a Tradeoff with gnuplot as PNG, SVG or PDF (by the ending of the path), both panels with logarithmic
/// axes. On the left points per second over the largest true error, one line a method, with the front of
/// Pareto as a broad band and rings, labelled with their tolerance, where `automatic` is. On the right the
/// largest true error (solid) and the largest bound reported (dashed) over the tolerance, with their equality
/// as a thin line. Errors below 1e-17 stand at 1e-17. The file is opened (and so probed) on construction.
/// Throws InvalidInput for another ending, InputOutputError.
class TradeoffFigure {
 public:
  explicit TradeoffFigure(const std::filesystem::path& path);
  ~TradeoffFigure();

  /// Runs gnuplot and moves the picture into place. `title` says what was measured. Throws InvalidInput
  /// unless a row has an error.
  void draw(const Tradeoff& tradeoff, const std::string& title);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace strutt
