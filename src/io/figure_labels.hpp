#pragma once

#include <string>
#include <vector>

#include "io/contour.hpp"

namespace strutt {

/// A value written on its line: where (in the unit square) and at which angle.
struct LineLabel {
  double x = 0.0;
  double y = 0.0;
  double degrees = 0.0;
  std::string text;
};

/// The size of the plotting area in pixels, and of the grid on it.
struct PlotSize {
  double width = 1.0;
  double height = 1.0;
  std::size_t columns = 2;
  std::size_t rows = 2;
};

/// Puts values on lines, in a gap that it cuts into them, apart from each other, from the frame and from
/// other lines.
class LabelPlacer {
 public:
  LabelPlacer(const PlotSize& size, const std::vector<ContourLine>& others);

  /// Labels the longest of the lines with `text`; lines too short or crooked for it stay as they are.
  void place(std::vector<ContourLine>& lines, const std::string& text);

  const std::vector<LineLabel>& labels() const { return labels_; }

 private:
  GridPoint pixels(GridPoint p) const;
  ContourLine refined(const ContourLine& line) const;
  bool place_on(std::vector<ContourLine>& lines, std::size_t index, const std::string& text);
  bool is_free(GridPoint centre) const;

  PlotSize size_;
  std::vector<GridPoint> occupied_;  // pixels of the other lines
  std::vector<LineLabel> labels_;
};

}  // namespace strutt
