#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/io/output_file.hpp"
#include "strutt/io/provenance.hpp"

namespace strutt::app {

/// One column of a result; its unit goes to the `# units:` line ("1" for pure numbers, empty for words).
struct Column {
  std::string name;
  std::string unit;
};

/// A number, a word, or nothing.
using Cell = std::variant<std::monostate, double, std::string>;

/// Cells that are empty for NaN and for nothing.
Cell number(double x);
Cell number(const std::optional<double>& x);
Cell number(const std::optional<int>& x);
Cell word(Method method);

/// Writes rows as CSV with provenance, or as {"schema_version":1,"provenance":{...},"rows":[{column:
/// value,...}]}. Numbers read back to the same bits; NaN and infinities are `nan`, `inf`, `-inf`, in JSON as
/// strings. An empty cell is null in JSON. The file appears under its name with commit(); `-` is standard
/// output.
class RowWriter {
 public:
  RowWriter(const std::filesystem::path& path, bool json, std::vector<Column> columns,
            const Provenance& provenance);

  void write(std::span<const Cell> row);
  void conclude(const Provenance& done);  ///< what was done, known only now; behind the last row
  void prepare();                         ///< after the last row: all that can fail but the renaming
  void commit();

 private:
  void write_csv(std::span<const Cell> row);
  void write_json(std::span<const Cell> row);

  OutputFile file_;
  bool json_;
  bool first_ = true;
  bool complete_ = false;
  Provenance done_;
  std::vector<Column> columns_;
  std::string line_;
};

}  // namespace strutt::app
