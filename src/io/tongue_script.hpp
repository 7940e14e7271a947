#pragma once

#include <string>

#include "io/figure_format.hpp"
#include "strutt/io/tongue_figure.hpp"

namespace strutt {

inline constexpr const char* kCurvesFile = "curves.dat";

/// The curves in units of the window, a data block of gnuplot for each entry of the key, and behind them one
/// of all tips.
std::string tongue_curve_data(const TongueFigureContent& content);

std::string tongue_script(const TongueFigureContent& content, FigureFormat format);

}  // namespace strutt
