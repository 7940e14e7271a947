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
  /// After the last strip, at most once: what was done, known only now. It follows the provenance, or the
  /// cells.
  virtual void conclude(const Provenance& done) = 0;
  virtual void
  prepare() = 0;  ///< after the last strip: all that can fail but the renaming; OutputFile::prepare
  virtual void commit() = 0;  ///< prepare, unless that is done; then the file appears under its name
};

/// The writer for a path, by its ending: .csv, .npy (one layer only), .npz, .h5/.hdf5. `-` is CSV on standard
/// output. Throws InvalidInput for another ending or several layers in .npy, InputOutputError when the place
/// cannot be written.
std::unique_ptr<ChartWriter> make_chart_writer(const std::filesystem::path& path,
                                               const ChartDescription& description);

/// The unit of a parameter as written to files: "1" for pure numbers.
std::string unit_of(const ParameterInfo& info);

/// Name and integer value of each entry of a categorical layer, e.g. {"stable", "unstable", ...}.
std::vector<std::string> category_names(Layer layer);

}  // namespace strutt
