#pragma once

#include "rows.hpp"
#include "strutt/io/chart_file.hpp"

namespace strutt::app {

/// A chart as JSON rows, one a cell, with the columns of the CSV format.
class JsonChartWriter : public ChartWriter {
 public:
  JsonChartWriter(const std::filesystem::path& path, const ChartDescription& description);
  void write(const ChartStrip& strip) override;
  void conclude(const Provenance& done) override { rows_.conclude(done); }
  void prepare() override { rows_.prepare(); }
  void commit() override { rows_.commit(); }

 private:
  ChartRequest request_;
  std::vector<std::vector<std::string>> names_;  // of the categories of each layer, empty for real ones
  RowWriter rows_;
};

}  // namespace strutt::app
