#pragma once

#include <string>
#include <vector>

#include "io/figure_format.hpp"
#include "strutt/io/portrait_figure.hpp"

namespace strutt {

/// The data file of a kind of curve in the directory of the figure: "libration.dat".
std::string portrait_file(CurveKind kind);

/// The curves of a kind for gnuplot, `angle/pi velocity excess` a line, curves parted by empty lines. Lines
/// of sections have the smallest excess first, so that colours lie over each other in a fixed order.
std::string portrait_data(const std::vector<PhaseCurve>& curves, CurveKind kind);

/// The file of arrows that show where the free pendulum's states move, all of the same length on paper.
inline constexpr const char* kArrowsFile = "arrows.dat";
std::string arrow_data(const std::vector<PhaseCurve>& curves, const PortraitDescription& description);

/// The gnuplot script.
std::string portrait_script(const std::vector<PhaseCurve>& curves, const PortraitDescription& description,
                            FigureFormat format);

}  // namespace strutt
