#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "strutt/chart/tongue_curves.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// What a figure of edge curves shows.
struct TongueFigureContent {
  std::string title;
  TongueLine along, over;               ///< horizontal and vertical axis
  ParameterInfo along_info, over_info;  ///< for their labels
  std::vector<TongueCurve> curves;
};

/// Draws the edge curves of tongues over two parameters with gnuplot as PNG, SVG or PDF (by the ending of the
/// path), a colour for each index (systems: for each mechanism), tips as points. The file is opened (and so
/// probed) on construction. Throws InvalidInput for another ending, InputOutputError.
class TongueFigure {
 public:
  explicit TongueFigure(const std::filesystem::path& path);
  ~TongueFigure();

  void draw(const TongueFigureContent& content);  ///< runs gnuplot and moves the picture into place

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace strutt
