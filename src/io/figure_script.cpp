#include "io/figure_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/chart_writers.hpp"
#include "io/figure_axis.hpp"
#include "io/gnuplot.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

constexpr double kLeft = 0.095, kRight = 0.855, kBottom = 0.185, kTop = 0.935;
constexpr int kPaletteSteps = 64;
constexpr const char* kUnstableKeyColour = "#F2B13C";
constexpr const char* kGrowthLineColour = "#5A1A00";

double half_cell(std::size_t cells) { return cells > 1 ? 0.5 / static_cast<double>(cells - 1) : 0.5; }

/// Position of a cell on its axis: 0 ... 1; the only cell of an axis stands in the middle.
double position(double cell, std::size_t cells) {
  return cells > 1 ? cell / static_cast<double>(cells - 1) : 0.5;
}

std::string range(std::size_t cells) {
  const double half = cells > 1 ? half_cell(cells) : 0.0;
  return fmt::format("[{:.9g}:{:.9g}]", -half, 1.0 + half);
}

std::string axis_commands(char name, const Axis& axis, const ParameterInfo& info, std::size_t cells) {
  std::string ticks;
  for (const auto& tick : axis_ticks(axis)) {
    ticks += fmt::format("{}{} {:.9g} {}", ticks.empty() ? "" : ", ", gnuplot_string(tick.label),
                         tick.position, tick.label.empty() ? 1 : 0);
  }
  return fmt::format("set {0}range {1}\nset {0}tics nomirror out ({2})\nset {0}label {3} noenhanced\n", name,
                     range(cells), ticks, gnuplot_string(axis_label(axis, info)));
}

std::string colour_bar(const GrowthScale& scale) {
  if (scale.levels.empty()) return "unset colorbox\n";
  std::string stops;
  for (int k = 0; k <= kPaletteSteps; ++k) {
    const double t = static_cast<double>(k) / kPaletteSteps;  // denser where the colour changes fast
    stops += fmt::format("{}{:.6g} '{}'", k == 0 ? "" : ", ", t * t,
                         hexadecimal(scale.colour(t * t * scale.largest)));
  }
  return fmt::format(
      "set palette defined ({})\nset cbrange [0:{:.9g}]\nset cbtics out nomirror\n"
      "set cblabel 'growth per period, ln of the spectral radius' offset 1,0\n"
      "set colorbox user origin screen {},{} size screen 0.02,{}\n",
      stops, scale.largest, kRight + 0.02, kBottom, kTop - kBottom);
}

bool occurs(const FigureData& data, Verdict verdict) {
  return std::find(data.verdict().begin(), data.verdict().end(), static_cast<float>(verdict)) !=
         data.verdict().end();
}

std::string key_box(const std::string& colour, const std::string& title) {
  return fmt::format(
      ", keyentry with boxes fillstyle solid 1.0 border lc rgb '#606060' fillcolor rgb '{}' title {}", colour,
      gnuplot_string(title));
}

constexpr std::array kVerdicts{Verdict::stable, Verdict::unstable, Verdict::boundary, Verdict::unresolved};

std::string key_boxes(const FigureData& data) {
  std::string text;
  if (occurs(data, Verdict::stable)) text += key_box(hexadecimal(kStableColour), "stable");
  if (occurs(data, Verdict::unstable)) text += key_box(kUnstableKeyColour, "unstable");
  if (occurs(data, Verdict::boundary)) text += key_box(hexadecimal(kBoundaryColour), "boundary");
  if (occurs(data, Verdict::unresolved)) text += key_box(hexadecimal(kUnresolvedColour), "unresolved");
  return text;
}

std::string image(const FigureData& data, std::size_t repeat) {
  const std::size_t width = data.columns() * repeat, height = data.rows() * repeat;
  const double low_x = data.columns() > 1 ? -half_cell(data.columns()) : 0.0;
  const double low_y = data.rows() > 1 ? -half_cell(data.rows()) : 0.0;
  const double dx = (1.0 - 2.0 * low_x) / static_cast<double>(width);
  const double dy = (1.0 - 2.0 * low_y) / static_cast<double>(height);
  return fmt::format(
      "'{}' binary array=({},{}) format='%uchar%uchar%uchar' dx={:.15g} dy={:.15g} origin=({:.15g},{:.15g}) "
      "using 1:2:3 with rgbimage notitle",
      kCellsFile, width, height, dx, dy, low_x + dx / 2, low_y + dy / 2);
}

/// Characters that gnuplot adds to its estimate of a title, which is generous, and the size of the letters:
/// with less than usual five and six entries with the longest titles still stand in two rows.
std::string key_size(const FigureContent& content, const FigureData& data) {
  if (content.tongues.by_mechanism()) return "width -3";
  const auto boxes = std::ranges::count_if(kVerdicts, [&](Verdict verdict) { return occurs(data, verdict); });
  return boxes > 2 ? "width -3 font ',17'" : "width 1";
}

std::string label_commands(const std::vector<LineLabel>& labels) {
  std::string text;
  for (const auto& label : labels) {
    text += fmt::format(
        "set label {} at {:.5f},{:.5f} center rotate by {:.1f} front font ',15' textcolor rgb '{}'\n",
        gnuplot_string(label.text), label.x, label.y, label.degrees, kGrowthLineColour);
  }
  return text;
}

}  // namespace

PlotSize plot_size(const FigureData& data) {
  return {(kRight - kLeft) * kPictureWidth, (kTop - kBottom) * kPictureHeight, data.columns(), data.rows()};
}

std::string line_data(const std::vector<ContourLine>& lines, const FigureData& data) {
  std::string text;
  for (const auto& line : lines) {
    for (const auto& p : line) {
      fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f}\n", position(p.column, data.columns()),
                     position(p.row, data.rows()));
    }
    text += '\n';
  }
  return text;
}

std::string figure_script(const ChartDescription& description, const FigureData& data,
                          const FigureContent& content) {
  const ChartRequest& request = description.request;
  std::string text = fmt::format(
      "set encoding utf8\nset terminal {}\nset output '{}'\nset title {} noenhanced\n"
      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen "
      "{}\n"
      "set border 15 linewidth 0.7 front\nset tics front\nset boxwidth 1\n"
      "set key at screen {},0.012 center bottom horizontal Left reverse samplen 2 {} maxrows 2\n",
      gnuplot_terminal(content.format), kPictureFile, gnuplot_string(chart_title(description)), kLeft, kRight,
      kBottom, kTop, (kLeft + kRight) / 2, key_size(content, data));
  text += axis_commands('x', request.x, description.x, data.columns());
  text += axis_commands('y', request.y, description.y, data.rows());
  text += colour_bar(content.scale) + label_commands(content.labels);
  text += "plot " + image(data, content.repeat);
  if (content.has_growth_lines) {
    text += fmt::format(", '{}' with lines linewidth 0.6 linecolor rgb '{}' title 'equal growth'",
                        kGrowthFile, kGrowthLineColour);
  }
  // the contour through the cells follows edges of combination resonances in steps
  if (content.has_edges && !content.tongues.by_mechanism()) {
    text += fmt::format(", '{}' with lines linewidth 1.6 linecolor rgb '#000000' {}", kEdgesFile,
                        content.tongues.empty() ? "title 'edge of stability'" : "notitle");
  }
  text += content.tongues.plots();
  text += key_boxes(data);
  // An empty line with a palette is what makes gnuplot draw the colour bar.
  if (!content.scale.levels.empty()) text += ", NaN with lines palette notitle";
  return text + "\nunset output\n";
}

}  // namespace strutt
