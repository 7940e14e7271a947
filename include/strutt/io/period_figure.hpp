#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "strutt/free_pendulum/period_formulas.hpp"

namespace strutt {

/// The period of a libration, and what two formulas make of it. NaN where a formula has no meaning.
struct PeriodSample {
  double amplitude = 0.0;       ///< rad, 0 to pi
  double ratio = 1.0;           ///< exact T/T0; +inf on the separatrix
  FormulaError krylov;          ///< 1/(1 - A^2/16), (31) and (22)
  FormulaError krylov_squared;  ///< 1/sqrt(1 - A^2/8)
};

/// Draws the paper's Fig. 3 with gnuplot as PNG, SVG or PDF (by the ending of the path): on the left T/T0
/// over the amplitude, exact and by both formulas, up to T/T0 = 4; on the right the relative errors of the
/// formulas on a logarithmic scale, dashed where the formula is too small. The file is opened (and so probed)
/// on construction. Throws InvalidInput for another ending, InputOutputError.
class PeriodFigure {
 public:
  explicit PeriodFigure(const std::filesystem::path& path);
  ~PeriodFigure();

  /// Runs gnuplot and moves the picture into place. Samples come in any order. Throws InvalidInput unless
  /// there are two or more that differ in amplitude.
  void draw(std::vector<PeriodSample> samples);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace strutt
