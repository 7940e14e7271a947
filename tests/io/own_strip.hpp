#pragma once

#include <utility>
#include <vector>

#include "strutt/chart/stability_chart.hpp"

namespace strutt::test {

/// A strip that has its values in itself.
struct OwnStrip : ChartStrip {
  std::vector<std::vector<double>> layers;

  OwnStrip(std::size_t first, std::size_t row_count, std::size_t column_count)
      : ChartStrip{first, row_count, column_count, {}} {}
  OwnStrip(const OwnStrip&) = delete;
  OwnStrip(OwnStrip&&) = default;

  void add(std::vector<double> layer) {
    layers.push_back(std::move(layer));
    values.emplace_back(layers.back());
  }
};

}  // namespace strutt::test
