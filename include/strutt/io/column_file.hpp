#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "strutt/io/output_file.hpp"
#include "strutt/io/provenance.hpp"

namespace strutt {

/// One column of a table of results.
struct DataColumn {
  std::string name;                     ///< "angle"
  std::string unit;                     ///< "rad"; "1" for pure numbers, empty for words
  std::string long_name;                ///< what it holds, in words
  std::vector<std::string> categories;  ///< not empty: the values are indices into these words (at most 127)
  std::vector<double> values;
};

/// Columns of equal length, and where they came from.
struct DataTable {
  std::string title;
  std::vector<DataColumn> columns;
  Provenance provenance;
};

/// A file for a table of columns, in the format that the ending of its path tells:
///   .csv (and `-`, standard output, and devices): provenance in `# ` lines, a `# units:` line, names, rows;
///   words spelled
///        out; numbers read back to the same bits;
///   .npz: one array a column, float64, or int8 for words, and `meta.json` with units, words and provenance;
///   .h5, .hdf5: one data set a column with attributes `units`, `long_name` or `flag_values`,
///   `flag_meanings`;
///        provenance as attributes of the file.
/// Opened (and so probed) on construction; appears under its name with `write`. Throws InvalidInput for
/// another ending, InputOutputError.
class ColumnFile {
 public:
  explicit ColumnFile(const std::filesystem::path& path);

  void write(const DataTable& table);

 private:
  using Writer = void (*)(OutputFile&, const std::string& name, const DataTable&);
  std::string name_;
  Writer writer_;
  OutputFile file_;
};

}  // namespace strutt
