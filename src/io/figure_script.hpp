#pragma once

#include <string>
#include <vector>

#include "io/figure_data.hpp"
#include "io/figure_format.hpp"
#include "io/figure_labels.hpp"
#include "io/tongue_overlay.hpp"
#include "strutt/io/chart_file.hpp"

namespace strutt {

/// Files of a figure in its directory.
inline constexpr const char* kCellsFile = "cells.rgb";
inline constexpr const char* kEdgesFile = "edges.dat";
inline constexpr const char* kGrowthFile = "growth.dat";

/// The plotting area in pixels of a picture of 1600 x 1100.
PlotSize plot_size(const FigureData& data);

/// What the script has to know besides the data files.
struct FigureContent {
  FigureFormat format = FigureFormat::png;
  std::size_t repeat = 1;  ///< of each cell in the image
  GrowthScale scale;
  std::vector<LineLabel> labels;
  bool has_edges = false;
  TongueOverlay tongues = {};
  bool has_growth_lines = false;
};

/// The gnuplot script.
std::string figure_script(const ChartDescription& description, const FigureData& data,
                          const FigureContent& content);

/// Lines for `plot ... with lines`, in units of the plotting area.
std::string line_data(const std::vector<ContourLine>& lines, const FigureData& data);

}  // namespace strutt
