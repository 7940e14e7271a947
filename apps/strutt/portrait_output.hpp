#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "rows.hpp"
#include "strutt/io/column_file.hpp"
#include "strutt/io/portrait_figure.hpp"

namespace strutt::app {

/// The data file and the figure of a portrait, opened before anything is computed.
class PortraitOutput {
 public:
  PortraitOutput(const PortraitArguments& arguments, const PortraitDescription& description);

  void write(const std::vector<PhaseCurve>& curves, const Provenance& provenance);

  /// Where it went, for the summary.
  std::string places() const;

 private:
  void write_json(const std::vector<PhaseCurve>& curves, const Provenance& provenance) const;

  std::filesystem::path path_;
  PortraitDescription description_;
  std::optional<ColumnFile> columns_;  // unless JSON
  std::optional<PortraitFigure> figure_;
  std::string figure_path_;
};

}  // namespace strutt::app
