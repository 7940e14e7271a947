#include "io/portrait_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/figure_axis.hpp"
#include "io/gnuplot.hpp"
#include "strutt/chart/axis.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kLeastLeft = 0.085, kBottomOfField = 0.17, kBottomWithoutKey = 0.11, kTopOfField = 0.935;
constexpr double kRightOfField = 0.975, kRightOfBar = 0.865;
constexpr double kHeadroom = 1.06;
constexpr int kArrowColumns = 33, kArrowRows = 21;
constexpr double kArrowPixels = 17.0;
constexpr int kMostTicks = 12;

// Okabe and Ito's colours.
constexpr const char* kLibrationColour = "#0072B2";
constexpr const char* kRotationColour = "#D55E00";
constexpr const char* kSeparatrixColour = "#000000";
constexpr const char* kArrowColour = "#B0B0B0";
constexpr const char* kSaddleColour = "#CC0000";

bool has(const std::vector<PhaseCurve>& curves, CurveKind kind) {
  return std::any_of(curves.begin(), curves.end(), [=](const auto& c) { return c.kind == kind; });
}

/// The free pendulum's state moves along the curves; sections jump.
bool has_field(const std::vector<PhaseCurve>& curves) { return !has(curves, CurveKind::section); }

double largest_velocity(const std::vector<PhaseCurve>& curves, double alpha) {
  double largest = 0.0;
  for (const auto& curve : curves) {
    for (const auto& p : curve.points) largest = std::max(largest, std::abs(p.velocity));
  }
  return kHeadroom * (largest > 0.0 ? largest : alpha);
}

double right(const std::vector<PhaseCurve>& curves) {
  return has_field(curves) ? kRightOfField : kRightOfBar;
}

double bottom(const std::vector<PhaseCurve>& curves) {
  return has_field(curves) ? kBottomOfField : kBottomWithoutKey;
}

constexpr const char* kMinus = "\u2212";

std::string pi_label(int halves) {
  if (halves == 0) return "0";
  const std::string sign = halves < 0 ? kMinus : "";
  const int n = std::abs(halves);
  if (n % 2 != 0) return sign + (n == 1 ? "" : std::to_string(n)) + "\u03C0/2";
  return sign + (n == 2 ? "" : std::to_string(n / 2)) + "\u03C0";
}

/// Marks of the angle axis, whose unit is pi: every half of pi in small windows, fewer in wide ones.
std::string angle_ticks(int cells) {
  int step = 1;
  while (4 * cells / step > kMostTicks) step *= 2;
  std::string ticks;
  for (int halves = -2 * cells; halves <= 2 * cells; ++halves) {
    if (halves % step != 0) continue;
    ticks += fmt::format("{}'{}' {}", ticks.empty() ? "" : ", ", pi_label(halves), 0.5 * halves);
  }
  return ticks;
}

std::vector<Tick> velocity_ticks(double largest) {
  auto ticks = axis_ticks({.parameter = "velocity", .from = -largest, .to = largest, .points = 2});
  for (auto& tick : ticks) {
    if (tick.label.starts_with('-')) tick.label = kMinus + tick.label.substr(1);
  }
  return ticks;
}

std::string tick_list(const std::vector<Tick>& ticks, double largest) {
  std::string list;
  for (const auto& tick : ticks) {
    list += fmt::format("{}{} {:.9g} {}", list.empty() ? "" : ", ", gnuplot_string(tick.label),
                        std::lerp(-largest, largest, tick.position), tick.label.empty() ? 1 : 0);
  }
  return list;
}

/// Left edge of the plot: room for the widest label of the velocity axis and for the title beside it.
double left(double largest) {
  std::ptrdiff_t widest = 0;
  for (const auto& tick : velocity_ticks(largest)) {
    widest = std::max(widest, std::count_if(tick.label.begin(), tick.label.end(), [](unsigned char c) {
                        return (c & 0xC0U) != 0x80U && c != '^' && c != '{' && c != '}';  // seen, in UTF-8
                      }));
  }
  return std::max(kLeastLeft, 0.052 + 0.011 * static_cast<double>(widest));
}

std::string frame(const std::vector<PhaseCurve>& curves, const PortraitDescription& d, FigureFormat format) {
  const double largest = largest_velocity(curves, d.alpha);
  return fmt::format(
      "set encoding utf8\nset terminal {}\nset output '{}'\nset title {} noenhanced\n"
      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen "
      "{}\n"
      "set border 15 linewidth 0.7 front\nset tics front\n"
      "set key at screen {},0.012 center bottom horizontal Left reverse samplen 2.5 width 1 maxrows 2\n"
      "set xrange [{}:{}]\nset yrange [{:.9g}:{:.9g}]\nset xtics nomirror out ({})\nset ytics nomirror out "
      "({})\n"
      "set xlabel 'angle \u03C6 from the hanging position [rad]'\nset ylabel \"angular velocity "
      "\u03C6'{}\"\n",
      gnuplot_terminal(format), kPictureFile, gnuplot_string(d.title), left(largest), right(curves),
      bottom(curves), kTopOfField, (left(largest) + right(curves)) / 2.0, -d.cells, d.cells, -largest,
      largest, angle_ticks(d.cells), tick_list(velocity_ticks(largest), largest),
      d.has_units ? " [rad/s]" : "/\u03B1");
}

std::string colour_bar() {
  return fmt::format(
      // Viridis, without its palest end.
      "set palette defined (0 '#440154', 1 '#46327E', 2 '#365C8D', 3 '#277F8E', 4 '#1FA187', 5 '#4AC16D', 6 "
      "'#BBCC20')\n"
      "set minussign\nset cbtics out nomirror\nset cblabel 'separatrix excess C_1 \u2212 2 of the start' "
      "offset 1,0\n"
      "set colorbox user origin screen {},{} size screen 0.02,{}\n",
      kRightOfBar + 0.02, kBottomWithoutKey, kTopOfField - kBottomWithoutKey);
}

/// Few dots are drawn larger, so that they are seen.
double dot_size(const std::vector<PhaseCurve>& curves) {
  double count = 1.0;
  for (const auto& curve : curves) count += static_cast<double>(curve.points.size());
  return std::clamp(0.22 * std::sqrt(20000.0 / count), 0.22, 0.8);
}

std::string lines(CurveKind kind, double width, const char* colour) {
  return fmt::format("'{}' using 1:2 with lines linewidth {} linecolor rgb '{}' title '{}', ",
                     portrait_file(kind), width, colour, to_string(kind));
}

std::string equilibria() {
  const std::string file = portrait_file(CurveKind::equilibrium);
  return fmt::format(
      "'{0}' using 1:($3 < 0 ? $2 : NaN) with points pointtype 7 pointsize 1.4 linecolor rgb '{1}' title "
      "'centre', "
      "'{0}' using 1:($3 < 0 ? NaN : $2) with points pointtype 2 pointsize 1.7 linewidth 2 linecolor rgb "
      "'{2}' "
      "title 'saddle'",
      file, kSeparatrixColour, kSaddleColour);
}

}  // namespace

std::string portrait_file(CurveKind kind) { return std::string(to_string(kind)) + ".dat"; }

std::string portrait_data(const std::vector<PhaseCurve>& curves, CurveKind kind) {
  std::vector<const PhaseCurve*> chosen;
  for (const auto& curve : curves) {
    if (curve.kind == kind) chosen.push_back(&curve);
  }
  if (kind == CurveKind::section) {
    std::stable_sort(chosen.begin(), chosen.end(), [](const auto* a, const auto* b) {
      return a->separatrix_excess < b->separatrix_excess;
    });
  }
  std::string text;
  for (const auto* curve : chosen) {
    for (const auto& p : curve->points) {
      fmt::format_to(std::back_inserter(text), "{:.7g} {:.7g} {:.7g}\n", p.angle / pi, p.velocity,
                     curve->separatrix_excess);
    }
    text += '\n';
  }
  return text;
}

std::string arrow_data(const std::vector<PhaseCurve>& curves, const PortraitDescription& d) {
  if (!has_field(curves)) return {};
  const double largest = largest_velocity(curves, d.alpha);
  const double per_x = 2.0 * d.cells / ((kRightOfField - left(largest)) * kPictureWidth);  // pi a pixel
  const double per_y = 2.0 * largest / ((kTopOfField - kBottomOfField) * kPictureHeight);  // rad/s a pixel
  std::string text;
  for (int j = 0; j < kArrowRows; ++j) {
    for (int i = 0; i < kArrowColumns; ++i) {
      const double x = d.cells * (2.0 * (i + 0.5) / kArrowColumns - 1.0);
      const double y = largest * (2.0 * (j + 0.5) / kArrowRows - 1.0);
      const double right = y / pi / per_x,
                   up = -d.alpha * d.alpha * std::sin(x * pi) / per_y;  // pixels a second
      const double scale = kArrowPixels / std::hypot(right, up);
      if (!std::isfinite(scale) || std::hypot(right * per_x * pi, up * per_y / d.alpha) < 0.02 * d.alpha)
        continue;
      const double dx = scale * right * per_x, dy = scale * up * per_y;
      fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g} {:.6g} {:.6g}\n", x - dx / 2.0, y - dy / 2.0,
                     dx, dy);
    }
  }
  return text;
}

std::string portrait_script(const std::vector<PhaseCurve>& curves, const PortraitDescription& description,
                            FigureFormat format) {
  std::string text = frame(curves, description, format);
  if (!has_field(curves)) {
    return text + colour_bar() +
           fmt::format(
               "unset key\nplot '{}' using 1:2:3 with points pointtype 7 pointsize {:.3g} linecolor palette "
               "notitle\nunset output\n",
               portrait_file(CurveKind::section), dot_size(curves));
  }
  text += fmt::format(
      "plot '{}' with vectors size screen 0.005,20 filled linewidth 0.5 linecolor rgb '{}' "
      "title 'direction of motion', ",
      kArrowsFile, kArrowColour);
  if (has(curves, CurveKind::libration)) text += lines(CurveKind::libration, 1.0, kLibrationColour);
  if (has(curves, CurveKind::rotation)) text += lines(CurveKind::rotation, 1.0, kRotationColour);
  text += lines(CurveKind::separatrix, 2.2, kSeparatrixColour);
  return text + equilibria() + "\nunset output\n";
}

}  // namespace strutt
