#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "strutt/free_pendulum/phase_portrait.hpp"

namespace strutt {

/// What a figure of a phase portrait says besides its curves.
struct PortraitDescription {
  std::string title;
  double alpha = 1.0;      ///< rad/s
  int cells = 3;           ///< the window is |phi| <= cells pi
  bool has_units = false;  ///< the velocity axis is phi' in rad/s; otherwise phi'/alpha
};

/// Draws a phase portrait with gnuplot as PNG, SVG or PDF (by the ending of the path): librations, rotations,
/// a thick separatrix, centres as dots and saddles as crosses, arrows of the direction in which the state
/// moves; section curves as dots, coloured by the separatrix excess of their start. The angle axis is marked
/// in multiples of pi. The file is opened (and so probed) on construction. Throws InvalidInput for another
/// ending, InputOutputError.
class PortraitFigure {
 public:
  explicit PortraitFigure(const std::filesystem::path& path);
  ~PortraitFigure();

  /// Runs gnuplot and moves the picture into place.
  void draw(const std::vector<PhaseCurve>& curves, const PortraitDescription& description);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace strutt
