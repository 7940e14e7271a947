#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace strutt {

/// One cell without the blanks around it, and the column (in characters, from 1) where it begins.
struct CsvCell {
  std::string_view text;
  int column = 1;
};

/// Cuts a CSV file into rows of cells, one row in memory at a time. Skips comment lines, and blank lines
/// before the header and at the end. Throws FileError for bytes that no CSV file of numbers contains,
/// InputOutputError.
class CsvReader {
 public:
  /// `name` stands for the file in messages.
  CsvReader(const std::filesystem::path& path, std::string name);
  ~CsvReader();

  bool next();  ///< goes to the next row; false after the last
  const std::vector<CsvCell>& cells() const { return cells_; }  ///< of the row; at least one
  int line() const { return line_; }                            ///< of the row
  [[noreturn]] void fail(const CsvCell& cell, const std::string& what) const;

 private:
  bool read_line();  ///< next line into text_, without its end
  bool fill();
  void check_line() const;
  void split();

  class Input;
  std::unique_ptr<Input> input_;
  std::string name_;
  std::string buffer_;
  std::size_t position_ = 0;
  std::string text_;
  std::vector<CsvCell> cells_;
  int line_ = 0;
  int blank_line_ = 0;  ///< the first of the blank lines just before, 0 if there is none
  bool started_ = false;
};

}  // namespace strutt
