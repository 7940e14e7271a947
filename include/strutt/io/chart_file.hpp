#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>

#include "strutt/chart/stability_chart.hpp"
#include "strutt/io/provenance.hpp"

namespace strutt {

/// What a chart file says besides its cells.
struct ChartDescription {
  ParameterInfo x;
  ParameterInfo y;
  ChartRequest request;
  Provenance provenance;
};

/// Writes a chart strip by strip, in bounded memory; see docs/files.md for the formats.
class ChartWriter {
 public:
  virtual ~ChartWriter() = default;
  virtual void write(const ChartStrip& strip) = 0;  ///< strips in order of rows
  virtual void commit() = 0;                        ///< after the last strip: the file appears under its name
};

/// The writer for a path, by its ending: .csv, .npy (one layer only), .npz, .h5/.hdf5. `-` is CSV on standard output. Throws
/// InvalidInput for another ending or several layers in .npy, InputOutputError when the place cannot be written.
std::unique_ptr<ChartWriter> make_chart_writer(const std::filesystem::path& path, const ChartDescription& description);

/// Name and integer value of each entry of a categorical layer, e.g. {"stable", "unstable", ...}.
std::vector<std::string> category_names(Layer layer);

}  // namespace strutt
