#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "strutt/chart/tongue_curves.hpp"
#include "strutt/io/chart_file.hpp"

namespace strutt {

/// Draws a chart with gnuplot as PNG, SVG or PDF (by the ending of the path): verdict regions in
/// colour-blind-safe colours, iso-lines of growth, tongue boundaries (margin = 0), labelled axes with units,
/// legend. Keeps a reduced copy of the strips (at most about 1000 x 1000 cells), so memory does not grow with
/// the chart. Needs the layers that `layers()` names, in any position of the strips.
class ChartFigure {
 public:
  ChartFigure(const std::filesystem::path& path, const ChartDescription& description);
  ~ChartFigure();

  /// The layers a figure is drawn from: verdict, growth, margin.
  static std::vector<Layer> layers();

  void add(const ChartStrip& strip);

  /// The edges of tongues with x along and y over (tongue_curves), drawn on top, however thin the tongues
  /// are.
  void set_tongues(const std::vector<TongueCurve>& curves);
  void commit();  ///< runs gnuplot and moves the picture into place

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace strutt
