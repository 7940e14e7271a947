#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "strutt/base/error.hpp"

namespace strutt {

/// Something wrong inside an input file: "file:line:column: what". Lines and columns count from 1; 0 when
/// unknown.
class FileError : public InvalidInput {
 public:
  FileError(const std::string& file, int line, int column, const std::string& what);
};

/// A numeric CSV table as read: column names without units, rows of doubles in SI units, and where each row
/// stood in the file.
struct NumericTable {
  std::string file;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::vector<int> lines;  ///< line number of each row, for messages
  std::vector<int>
      cell_columns;  ///< column of the file, in characters, where each cell begins, row after row

  std::size_t column(
      const std::string& name) const;  ///< index; throws FileError naming the columns there are
  /// The complaint `what` about a cell, at its place in the file. Indices count from 0.
  FileError error_at(std::size_t row, std::size_t column, const std::string& what) const;
};

/// Which columns a table must and may have. Anything else, or a column twice, is an error.
struct TableSchema {
  std::vector<std::string> required;
  std::vector<std::string> optional;
  /// SI units of columns. Under the header `name [unit]` values are converted to it, and a unit of another
  /// dimension is an error; in the brackets of other columns may stand anything.
  std::map<std::string, std::string> units = {};
};

/// Reads a CSV file (`-`: standard input): UTF-8 with or without BOM, LF or CRLF, with or without final
/// newline, blank last line, lines starting with `#` skipped, headers `name` or `name [unit]`, decimal
/// numbers of any length, correctly rounded, always with a point. Ragged rows, unknown, missing or repeated
/// columns, empty cells, `nan`, `inf`, hexadecimal, overflow (1e999), NUL bytes, quotes: FileError with line
/// and column. A file without rows is one too. `unknown_column` in messages suggests the nearest name. Throws
/// InputOutputError if the file cannot be read.
NumericTable read_table(const std::filesystem::path& path, const TableSchema& schema);

/// Correctly rounded decimal to double, whole text, no leading/trailing blanks, no hexadecimal, no nan/inf;
/// returns false if it is not a number or overflows. Independent of the locale. Underflow gives the nearest
/// double.
bool parse_number(const std::string& text, double& value);

}  // namespace strutt
