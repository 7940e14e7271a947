#include "io/tongue_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "io/figure_axis.hpp"
#include "io/gnuplot.hpp"

namespace strutt {
namespace {

// Okabe and Ito's colours, without the yellow, which is too light for lines.
constexpr std::array<const char*, 7> kColours{"#000000", "#0072B2", "#D55E00", "#009E73",
                                              "#CC79A7", "#56B4E9", "#E69F00"};
constexpr std::size_t kMostKeys = 14;

/// The number of the key's entry of a stretch of a curve, and what the key says.
struct Entry {
  int number;
  std::string title;
};

Entry entry_of(const TongueCurve& curve, const CurvePoint& point) {
  if (curve.order != kNoOrder) return {curve.order, fmt::format("n = {}", curve.order)};
  const std::string mechanism(to_string(point.mechanism));
  return {static_cast<int>(point.mechanism),
          point.mechanism == Mechanism::complex_pair ? mechanism : "through " + mechanism};
}

std::vector<Entry> entries_of(const TongueFigureContent& content) {
  std::vector<Entry> entries;
  for (const auto& curve : content.curves)
    for (const auto& point : curve.points) {
      const Entry entry = entry_of(curve, point);
      const auto same = [&](const Entry& e) { return e.number == entry.number; };
      if (std::ranges::none_of(entries, same)) entries.push_back(entry);
    }
  std::ranges::sort(entries, {}, &Entry::number);
  return entries;
}

std::string point_line(const TongueFigureContent& content, const CurvePoint& point) {
  const auto part = [](const TongueLine& line, double value) {
    return (value - line.from) / (line.to - line.from);
  };
  return fmt::format("{:.7f} {:.7f}\n", part(content.along, point.along), part(content.over, point.over));
}

std::string axis_commands(char name, const TongueLine& line, const ParameterInfo& info) {
  const Axis axis{.parameter = line.parameter, .from = line.from, .to = line.to};
  std::string ticks;
  for (const auto& tick : axis_ticks(axis))
    ticks += fmt::format("{}{} {:.9g} {}", ticks.empty() ? "" : ", ", gnuplot_string(tick.label),
                         tick.position, tick.label.empty() ? 1 : 0);
  return fmt::format("set {0}range [0:1]\nset {0}tics nomirror out ({1})\nset {0}label {2} noenhanced\n",
                     name, ticks, gnuplot_string(axis_label(axis, info)));
}

}  // namespace

std::string tongue_curve_data(const TongueFigureContent& content) {
  std::string text, tips;
  for (const Entry& entry : entries_of(content)) {
    for (const auto& curve : content.curves) {
      const std::size_t before = text.size();
      for (const auto& point : curve.points)
        if (entry_of(curve, point).number == entry.number) text += point_line(content, point);
      if (text.size() > before) text += '\n';  // two empty lines would begin a new block
    }
    text += "\n\n";
  }
  for (const auto& curve : content.curves)
    for (const auto& point : curve.points)
      if (point.kind == CurvePoint::Kind::tip) tips += point_line(content, point);
  return text + (tips.empty() ? "NaN NaN\n" : tips);
}

std::string tongue_script(const TongueFigureContent& content, FigureFormat format) {
  std::string text = fmt::format(
      "set encoding utf8\nset terminal {}\nset output '{}'\nset title {} noenhanced\n"
      "set lmargin at screen 0.095\nset rmargin at screen 0.85\nset bmargin at screen 0.12\nset tmargin at "
      "screen 0.935\nset border 15 linewidth 0.7 front\nset tics front\n"
      "set grid linewidth 0.5 linetype 1 linecolor rgb '#D0D0D0'\n"
      "set key at screen 0.99,0.93 right top Left reverse samplen 1.5 spacing 1.3\n",
      gnuplot_terminal(format), kPictureFile, gnuplot_string(content.title));
  text += axis_commands('x', content.along, content.along_info);
  text += axis_commands('y', content.over, content.over_info);
  const auto entries = entries_of(content);
  text += "plot ";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool named = i < kMostKeys;
    text += fmt::format("'{}' index {} with lines linewidth 1.6 linecolor rgb '{}' {} {}, ", kCurvesFile, i,
                        kColours[i % kColours.size()], named ? "title" : "notitle",
                        named ? gnuplot_string(entries[i].title) : "");
  }
  text +=
      fmt::format("'{}' index {} with points pointtype 7 pointsize 0.9 linecolor rgb '#606060' title 'tip'\n",
                  kCurvesFile, entries.size());
  return text + "unset output\n";
}

}  // namespace strutt
