#include "io/figure_labels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strutt {
namespace {

constexpr double kPixelsPerCharacter = 10.5;
constexpr double kPixelsAround = 12.0;
constexpr double kShortestLine = 5.0;  // in widths of the label
constexpr double kFrame = 30.0;        // pixels to the frame
constexpr double kFromLines = 26.0;    // pixels to other lines
constexpr double kApart = 90.0;        // pixels between labels
constexpr double kStepPixels = 3.0;
constexpr double kStraight = 0.93;  // chord over arc under the label
constexpr std::size_t kLabelsPerLevel = 2;
constexpr double kCandidates[] = {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9};

double distance(GridPoint a, GridPoint b) { return std::hypot(a.column - b.column, a.row - b.row); }

}  // namespace

LabelPlacer::LabelPlacer(const PlotSize& size, const std::vector<ContourLine>& others) : size_(size) {
  for (const auto& line : others) {
    for (const auto& p : refined(line)) occupied_.push_back(pixels(p));
  }
}

GridPoint LabelPlacer::pixels(GridPoint p) const {
  return {p.column / static_cast<double>(size_.columns - 1) * size_.width,
          p.row / static_cast<double>(size_.rows - 1) * size_.height};
}

/// The same line in short steps: on a coarse grid, a label would find no corners to begin and end its gap at.
ContourLine LabelPlacer::refined(const ContourLine& line) const {
  ContourLine result;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const GridPoint a = line[i], b = line[i + 1];
    const auto steps = static_cast<int>(std::ceil(distance(pixels(a), pixels(b)) / kStepPixels));
    for (int k = 0; k < std::max(steps, 1); ++k) {
      const double t = static_cast<double>(k) / std::max(steps, 1);
      result.push_back({std::lerp(a.column, b.column, t), std::lerp(a.row, b.row, t)});
    }
  }
  result.push_back(line.back());
  return result;
}

bool LabelPlacer::is_free(GridPoint c) const {
  if (c.column < kFrame || c.row < kFrame || c.column > size_.width - kFrame || c.row > size_.height - kFrame)
    return false;
  const auto near = [&](const GridPoint& p) { return distance(c, p) < kFromLines; };
  if (std::any_of(occupied_.begin(), occupied_.end(), near)) return false;
  return std::none_of(labels_.begin(), labels_.end(), [&](const LineLabel& label) {
    return distance(c, {label.x * size_.width, label.y * size_.height}) < kApart;
  });
}

bool LabelPlacer::place_on(std::vector<ContourLine>& lines, std::size_t index, const std::string& text) {
  const ContourLine line = refined(lines[index]);
  const double width = kPixelsPerCharacter * static_cast<double>(text.size()) + kPixelsAround;
  std::vector<double> arc{0.0};
  for (std::size_t i = 1; i < line.size(); ++i)
    arc.push_back(arc.back() + distance(pixels(line[i - 1]), pixels(line[i])));
  if (arc.back() < kShortestLine * width) return false;
  for (const double candidate : kCandidates) {
    const double middle = candidate * arc.back();
    const auto first = std::lower_bound(arc.begin(), arc.end(), middle - width / 2) - arc.begin();
    const auto last = std::upper_bound(arc.begin(), arc.end(), middle + width / 2) - arc.begin() - 1;
    if (first < 1 || last <= first || last + 1 >= static_cast<std::ptrdiff_t>(line.size())) continue;
    const GridPoint a = pixels(line[static_cast<std::size_t>(first)]),
                    b = pixels(line[static_cast<std::size_t>(last)]);
    const double stretch = arc[static_cast<std::size_t>(last)] - arc[static_cast<std::size_t>(first)];
    const GridPoint centre{(a.column + b.column) / 2, (a.row + b.row) / 2};
    if (distance(a, b) < kStraight * stretch || !is_free(centre)) continue;
    double degrees = std::atan2(b.row - a.row, b.column - a.column) * 180.0 / std::numbers::pi;
    if (degrees > 90.0) degrees -= 180.0;
    if (degrees <= -90.0) degrees += 180.0;
    labels_.push_back({centre.column / size_.width, centre.row / size_.height, degrees, text});
    lines[index].assign(line.begin(), line.begin() + first + 1);
    lines.emplace_back(line.begin() + last, line.end());
    return true;
  }
  return false;
}

void LabelPlacer::place(std::vector<ContourLine>& lines, const std::string& text) {
  const double column_unit = size_.width / static_cast<double>(size_.columns - 1);
  const double row_unit = size_.height / static_cast<double>(size_.rows - 1);
  std::vector<std::pair<double, std::size_t>> by_length;
  for (std::size_t i = 0; i < lines.size(); ++i)
    by_length.emplace_back(-length_of(lines[i], column_unit, row_unit), i);
  std::sort(by_length.begin(), by_length.end());
  std::size_t placed = 0;
  for (std::size_t k = 0; k < std::min<std::size_t>(by_length.size(), 6) && placed < kLabelsPerLevel; ++k) {
    if (place_on(lines, by_length[k].second, text)) ++placed;
  }
}

}  // namespace strutt
