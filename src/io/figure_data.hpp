#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/contour.hpp"
#include "strutt/chart/stability_chart.hpp"

namespace strutt {

/// A reduced copy of a chart: every k-th row and column, ends included, so that neither exceeds `kMostCells`.
class FigureData {
 public:
  static constexpr std::size_t kMostCells = 1000;

  /// Throws InvalidInput if one of the layers verdict, growth and margin is missing.
  explicit FigureData(const ChartRequest& request);

  void add(const ChartStrip& strip);

  std::size_t columns() const { return columns_.size(); }
  std::size_t rows() const { return rows_.size(); }
  const std::vector<float>& verdict() const { return layers_[0]; }
  const std::vector<float>& growth() const { return layers_[1]; }
  /// As a function of it that crosses 0 evenly, with the same sign.
  const std::vector<float>& margin() const { return layers_[2]; }
  /// growth^2 where there is growth, -margin() elsewhere: close to linear in the parameters up to the edge,
  /// so that lines of equal growth do not follow the cells there.
  std::vector<float> signed_growth_squared() const;

 private:
  void keep(std::size_t layer, std::span<const double> row, std::size_t begin);

  std::vector<std::size_t> columns_;  // kept, of the chart
  std::vector<std::size_t> rows_;
  std::size_t next_row_ = 0;           // index into rows_
  std::array<std::size_t, 3> source_;  // where verdict, growth, margin stand in a strip
  std::array<std::vector<float>, 3> layers_;
};

using Colour = std::array<unsigned char, 3>;
std::string hexadecimal(Colour colour);  ///< #RRGGBB

inline constexpr Colour kStableColour{0xC5, 0xE5, 0xF7};      // Okabe-Ito sky blue, light
inline constexpr Colour kBoundaryColour{0x00, 0x9E, 0x73};    // bluish green
inline constexpr Colour kUnresolvedColour{0x99, 0x99, 0x99};  // grey

/// Colours and levels of growth: from 0 to `largest`, darker with the square root of growth.
struct GrowthScale {
  double largest = 1.0;
  std::vector<double> levels;  ///< ascending, 1-2-5 series; empty if nothing grows

  Colour colour(double growth) const;
};

/// Such that one cell in a hundred of the unstable ones may be beyond the end of the scale.
GrowthScale growth_scale(const FigureData& data);

/// The cells as an image, first row first, each cell repeated `repeat` times in both directions.
std::string image_bytes(const FigureData& data, const GrowthScale& scale, std::size_t repeat);

}  // namespace strutt
