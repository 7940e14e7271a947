#include "io/period_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace strutt {
namespace {

constexpr double kLargestRatio = 4.0;
constexpr int kLeastDecade = -10, kMostDecade = 1;

// Okabe and Ito's colours.
constexpr const char* kExactColour = "#000000";
constexpr const char* kKrylovColour = "#0072B2";
constexpr const char* kSquaredColour = "#D55E00";

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : "NaN"; }

/// What both panels have in common.
std::string frame(FigureFormat format) {
  return fmt::format(
      "set encoding utf8\nset terminal {}\nset output '{}'\n"
      "set border 15 linewidth 0.7 front\nset tics front out nomirror\nset grid linewidth 0.5 linetype 1 "
      "linecolor rgb '#D0D0D0'\n"
      "set bmargin at screen 0.11\nset tmargin at screen 0.935\n"
      "set xrange [0:pi]\nset xtics 0,0.5,3 add ('\u03C0' pi)\nset xlabel 'amplitude A [rad]'\n"
      "set key at graph 0.03,0.97 left top Left reverse samplen 2 spacing 1.3\n",
      gnuplot_terminal(format), kPictureFile);
}

std::string ratio_panel() {
  return fmt::format(
      "set title 'Period of the free pendulum'\nset ylabel 'period ratio T/T_0' offset 1,0\nset format y "
      "'%.1f'\n"
      "set lmargin at screen 0.085\nset rmargin at screen 0.475\nset yrange [1:{1}]\n"
      "plot '{0}' using 1:2 with lines linewidth 2.6 linecolor rgb '{2}' title 'exact (10)', "
      "'{0}' using 1:3 with lines linewidth 1.5 linecolor rgb '{3}' "
      "title '1/(1 \u2212 A\u00B2/16), (31) and (22)', "
      "'{0}' using 1:5 with lines linewidth 1.5 linecolor rgb '{4}' "
      "title '1/\u221A(1 \u2212 A\u00B2/8), Krylov with \u03B3\u00B2'\n",
      kPeriodFile, kLargestRatio, kExactColour, kKrylovColour, kSquaredColour);
}

/// One formula's error: solid where it is too large, dashed where too small.
std::string error_lines(int column, const char* colour) {
  return fmt::format(
      "'{0}' using 1:(${1} > 0 ? ${1} : NaN) with lines linewidth 1.5 linecolor rgb '{2}' notitle, "
      "'{0}' using 1:(${1} < 0 ? -${1} : NaN) with lines linewidth 1.5 dashtype (8,5) linecolor rgb '{2}' "
      "notitle",
      kPeriodFile, column, colour);
}

std::string error_panel(const Decades& decades) {
  return fmt::format(
      "set title 'Error of the formulas'\n"
      "set ylabel '|formula/exact \u2212 1|, dashed: formula too small' offset 0,0\n"
      "set lmargin at screen 0.59\nset rmargin at screen 0.985\nset logscale y\nset ytics 10\nset mytics "
      "1\nset yrange [1e{}:1e{}]\n"
      "set format y '10^{{%T}}'\nset minussign\nplot {}, {}\n",
      decades.from, decades.to, error_lines(4, kKrylovColour), error_lines(6, kSquaredColour));
}

}  // namespace

std::string period_data(const std::vector<PeriodSample>& samples) {
  std::string text;
  for (const auto& s : samples) {
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {}\n", cell(s.amplitude), cell(s.ratio),
                   cell(s.krylov.ratio), cell(s.krylov.relative_error), cell(s.krylov_squared.ratio),
                   cell(s.krylov_squared.relative_error));
  }
  return text;
}

Decades error_decades(const std::vector<PeriodSample>& samples) {
  double least = INFINITY, most = 0.0;
  for (const auto& s : samples) {
    for (const double error : {s.krylov.relative_error, s.krylov_squared.relative_error}) {
      if (!std::isfinite(error) || error == 0.0) continue;
      least = std::min(least, std::abs(error));
      most = std::max(most, std::abs(error));
    }
  }
  if (most == 0.0) return {};
  const int to = std::clamp(static_cast<int>(std::ceil(std::log10(most))), kLeastDecade + 1, kMostDecade);
  const int from = std::clamp(static_cast<int>(std::floor(std::log10(least))), kLeastDecade, to - 1);
  return {from, to};
}

std::string period_script(const std::vector<PeriodSample>& samples, FigureFormat format) {
  return frame(format) + "set multiplot\n" + ratio_panel() + "unset key\n" +
         error_panel(error_decades(samples)) + "unset multiplot\nunset output\n";
}

}  // namespace strutt
