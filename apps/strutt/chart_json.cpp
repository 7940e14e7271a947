#include "chart_json.hpp"

namespace strutt::app {
namespace {

std::vector<Column> columns_of(const ChartDescription& description) {
  std::vector<Column> columns{{description.request.x.parameter, unit_of(description.x)},
                              {description.request.y.parameter, unit_of(description.y)}};
  for (const Layer layer : description.request.layers) {
    columns.push_back({std::string(to_string(layer)), std::string(unit_of(layer))});
  }
  return columns;
}

}  // namespace

JsonChartWriter::JsonChartWriter(const std::filesystem::path& path, const ChartDescription& description)
    : request_(description.request), rows_(path, true, columns_of(description), description.provenance) {
  for (const Layer layer : request_.layers)
    names_.push_back(is_categorical(layer) ? category_names(layer) : std::vector<std::string>{});
}

void JsonChartWriter::write(const ChartStrip& strip) {
  std::vector<Cell> row(2 + names_.size());
  for (std::size_t j = 0; j < strip.rows; ++j) {
    row[1] = request_.y.value(strip.first_row + j);
    for (std::size_t i = 0; i < strip.columns; ++i) {
      row[0] = request_.x.value(i);
      for (std::size_t l = 0; l < names_.size(); ++l) {
        const double value = strip.values[l][j * strip.columns + i];
        if (names_[l].empty())
          row[2 + l] = value;
        else
          row[2 + l] = names_[l].at(static_cast<std::size_t>(value));
      }
      rows_.write(row);
    }
  }
}

}  // namespace strutt::app
