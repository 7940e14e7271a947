#include "io/figure_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/figure_axis.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

constexpr std::size_t kMargin = 2;  // index into the kept layers
constexpr std::size_t kLevels = 6;

/// At most `most` of the indices 0 .. count - 1, evenly, with both ends.
std::vector<std::size_t> thinned(std::size_t count, std::size_t most) {
  const std::size_t kept = std::min(count, most);
  std::vector<std::size_t> indices(kept);
  for (std::size_t k = 0; k < kept; ++k) {
    const double exact =
        kept == 1 ? 0.0
                  : static_cast<double>(k) * static_cast<double>(count - 1) / static_cast<double>(kept - 1);
    indices[k] = static_cast<std::size_t>(std::llround(exact));
  }
  return indices;
}

std::size_t position_of(const ChartRequest& request, Layer layer) {
  const auto found = std::find(request.layers.begin(), request.layers.end(), layer);
  if (found == request.layers.end()) {
    throw InvalidInput("a figure needs the layer '" + std::string(to_string(layer)) + "'");
  }
  return static_cast<std::size_t>(found - request.layers.begin());
}

Colour mixed(Colour a, Colour b, double t) {
  Colour result{};
  for (std::size_t k = 0; k < 3; ++k)
    result[k] = static_cast<unsigned char>(std::lround(std::lerp(a[k], b[k], t)));
  return result;
}

/// theta^2 with margin = 1 - cos(theta), theta imaginary where the margin is negative: close to linear in the
/// parameters across an edge. The margin itself falls to -1e300; between such a cell and a stable one, a
/// linear interpolation of it would put the edge onto the stable one.
double squared_angle(double margin) {
  const double cosine = 1.0 - margin;
  if (!(cosine > 1.0)) return std::pow(std::acos(std::clamp(cosine, -1.0, 1.0)), 2);
  return -std::pow(std::acosh(std::min(cosine, std::numeric_limits<double>::max())), 2);
}

Colour cell_colour(double verdict, double growth, const GrowthScale& scale) {
  if (verdict == static_cast<double>(Verdict::stable)) return kStableColour;
  if (verdict == static_cast<double>(Verdict::boundary)) return kBoundaryColour;
  if (verdict == static_cast<double>(Verdict::unstable)) return scale.colour(growth);
  return kUnresolvedColour;
}

}  // namespace

FigureData::FigureData(const ChartRequest& request)
    : columns_(thinned(request.x.points, kMostCells)),
      rows_(thinned(request.y.points, kMostCells)),
      source_{position_of(request, Layer::verdict), position_of(request, Layer::growth),
              position_of(request, Layer::margin)} {
  for (auto& layer : layers_) layer.reserve(columns_.size() * rows_.size());
}

void FigureData::add(const ChartStrip& strip) {
  for (; next_row_ < rows_.size() && rows_[next_row_] < strip.first_row + strip.rows; ++next_row_) {
    const std::size_t begin = (rows_[next_row_] - strip.first_row) * strip.columns;
    for (std::size_t l = 0; l < layers_.size(); ++l) keep(l, strip.values[source_[l]], begin);
  }
}

void FigureData::keep(std::size_t layer, std::span<const double> row, std::size_t begin) {
  for (const std::size_t column : columns_) {
    const double value = row[begin + column];
    layers_[layer].push_back(static_cast<float>(layer == kMargin ? squared_angle(value) : value));
  }
}

std::vector<float> FigureData::signed_growth_squared() const {
  std::vector<float> result(growth().size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const float growing = growth()[i];
    result[i] = growing <= 0.0F ? -std::max(margin()[i], 0.0F) : growing * growing;
  }
  return result;
}

std::string hexadecimal(Colour c) { return fmt::format("#{:02X}{:02X}{:02X}", c[0], c[1], c[2]); }

Colour GrowthScale::colour(double growth) const {
  struct Stop {
    double at;
    Colour colour;
  };
  // Okabe-Ito orange and vermillion between a light and a dark end.
  constexpr std::array<Stop, 4> stops{{{0.0, {0xFF, 0xEC, 0xC9}},
                                       {0.45, {0xF2, 0xB1, 0x3C}},
                                       {0.75, {0xD5, 0x5E, 0x00}},
                                       {1.0, {0x9E, 0x2F, 0x00}}}};
  if (std::isnan(growth)) return kUnresolvedColour;
  const double t = std::sqrt(std::clamp(growth / largest, 0.0, 1.0));
  std::size_t k = 1;
  while (k + 1 < stops.size() && t > stops[k].at) ++k;
  return mixed(stops[k - 1].colour, stops[k].colour, (t - stops[k - 1].at) / (stops[k].at - stops[k - 1].at));
}

GrowthScale growth_scale(const FigureData& data) {
  std::vector<float> unstable;
  for (std::size_t i = 0; i < data.growth().size(); ++i) {
    const float growth = data.growth()[i];
    if (data.verdict()[i] == static_cast<float>(Verdict::unstable) && growth > 0.0F &&
        std::isfinite(growth)) {
      unstable.push_back(growth);
    }
  }
  GrowthScale scale;
  if (unstable.empty()) return scale;
  const auto place = unstable.begin() + static_cast<std::ptrdiff_t>((unstable.size() - 1) * 99 / 100);
  std::nth_element(unstable.begin(), place, unstable.end());
  scale.largest = static_cast<double>(*place);
  double level = round_down_125(scale.largest);
  for (std::size_t k = 0; k < kLevels && level > std::numeric_limits<float>::min(); ++k) {
    scale.levels.push_back(level);
    level = round_down_125(0.7 * level);
  }
  std::reverse(scale.levels.begin(), scale.levels.end());
  return scale;
}

std::string image_bytes(const FigureData& data, const GrowthScale& scale, std::size_t repeat) {
  std::string bytes;
  bytes.reserve(3 * data.columns() * data.rows() * repeat * repeat);
  for (std::size_t j = 0; j < data.rows(); ++j) {
    std::string row;
    for (std::size_t i = 0; i < data.columns(); ++i) {
      const std::size_t at = j * data.columns() + i;
      const Colour colour =
          cell_colour(static_cast<double>(data.verdict()[at]), static_cast<double>(data.growth()[at]), scale);
      for (std::size_t k = 0; k < repeat; ++k) row.append(colour.begin(), colour.end());
    }
    for (std::size_t k = 0; k < repeat; ++k) bytes += row;
  }
  return bytes;
}

}  // namespace strutt
