#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "io/own_strip.hpp"
#include "strutt/io/chart_file.hpp"

/// A chart whose cells tell where they belong.
namespace strutt::test {

/// A chart of nx times ny cells with a provenance that does not change.
inline ChartDescription description_of(std::size_t nx, std::size_t ny, std::vector<Layer> layers) {
  ChartDescription d;
  d.x = {"support.frequency", "rad/s", "support frequency"};
  d.y = {"mathieu.delta", "", "delta"};
  d.request.x = {"support.frequency", 1.0, 1.0 + 0.1 * static_cast<double>(nx - 1), nx, AxisScale::linear};
  d.request.y = {"mathieu.delta", 3.0, nx == 1 ? 3.0 : -1.0, ny, AxisScale::linear};
  if (ny == 1) d.request.y.to = 3.0;
  d.request.layers = std::move(layers);
  d.provenance = {
      {"program", "strutt"}, {"version", "9"}, {"date", "2001-09-09T01:46:40Z"}, {"command", "strutt chart"}};
  return d;
}

/// A value that tells layer, row and column.
inline double cell(Layer layer, std::size_t j, std::size_t i) {
  if (layer == Layer::verdict) return static_cast<double>((i + j) % 4);
  if (layer == Layer::outcome) return static_cast<double>((i + 2 * j) % 8);
  if (i == 0 && j == 0) return std::numeric_limits<double>::quiet_NaN();
  if (i == 1 && j == 0) return layer == Layer::discriminant ? -std::numeric_limits<double>::infinity() : 0.1;
  return std::sqrt(static_cast<double>(2 + static_cast<int>(layer) + 10 * i + 1000 * j));
}

inline OwnStrip strip_of(const ChartDescription& d, std::size_t first, std::size_t rows) {
  OwnStrip strip{first, rows, d.request.x.points};
  for (const Layer layer : d.request.layers) {
    std::vector<double> values;
    for (std::size_t j = first; j < first + rows; ++j) {
      for (std::size_t i = 0; i < strip.columns; ++i) values.push_back(cell(layer, j, i));
    }
    strip.add(std::move(values));
  }
  return strip;
}

/// The whole chart, strip by strip; the file must not be there before it is committed.
inline void write_chart(const std::filesystem::path& path, const ChartDescription& d,
                        std::size_t rows_per_strip) {
  const auto writer = make_chart_writer(path, d);
  for (std::size_t j = 0; j < d.request.y.points; j += rows_per_strip) {
    writer->write(strip_of(d, j, std::min(rows_per_strip, d.request.y.points - j)));
  }
  CHECK_FALSE(std::filesystem::exists(path));
  writer->commit();
}

inline const std::vector<Layer> kAll{Layer::verdict,      Layer::growth, Layer::winding,
                                     Layer::discriminant, Layer::margin, Layer::outcome};

}  // namespace strutt::test
