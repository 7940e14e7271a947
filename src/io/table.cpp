#include "strutt/io/table.hpp"

#include <algorithm>

#include "io/csv_reader.hpp"
#include "io/text.hpp"

namespace strutt {
namespace {

std::string located(const std::string& file, int line, int column, const std::string& what) {
  std::string result = printable(file);
  if (line > 0) result += ":" + std::to_string(line);
  if (line > 0 && column > 0) result += ":" + std::to_string(column);
  return result + ": " + what;
}

std::string quoted_list(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  std::string result;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
    result += (i == 0 ? "'" : ", '") + printable(names[i]) + "'";
  }
  if (names.size() > most) result += ", ... (" + std::to_string(names.size()) + " in all)";
  return result;
}

/// The name in `name [unit]`.
std::string_view without_unit(std::string_view header) {
  const auto bracket = header.find('[');
  if (bracket == std::string_view::npos || header.back() != ']') return header;
  return trimmed(header.substr(0, bracket));
}

std::vector<std::string> known_names(const TableSchema& schema) {
  auto names = schema.required;
  names.insert(names.end(), schema.optional.begin(), schema.optional.end());
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_name(const CsvReader& reader, const CsvCell& cell, const std::string& name,
                const std::vector<std::string>& seen, const std::vector<std::string>& known) {
  if (name.empty()) reader.fail(cell, "a column has no name");
  if (contains(seen, name)) reader.fail(cell, "the column '" + printable(name) + "' stands here a second time");
  if (contains(known, name)) return;
  const std::string close = nearest(name, known);
  std::string text = "unknown column '" + printable(name) + "'";
  if (!close.empty()) text += "; did you mean '" + close + "'?";
  else if (!known.empty()) text += "; known are " + quoted_list(known);
  reader.fail(cell, text);
}

std::vector<std::string> read_header(CsvReader& reader, const TableSchema& schema) {
  const auto& cells = reader.cells();
  const auto known = known_names(schema);
  std::vector<std::string> names;
  for (const auto& cell : cells) {
    std::string name(without_unit(cell.text));
    check_name(reader, cell, name, names, known);
    names.push_back(std::move(name));
  }
  for (const auto& name : schema.required) {
    if (!contains(names, name)) {
      reader.fail(cells.front(), "the column '" + name + "' is missing; the columns are " + quoted_list(names));
    }
  }
  return names;
}

double read_cell(const CsvReader& reader, const CsvCell& cell, const std::string& column) {
  const std::string in = " in column '" + printable(column) + "'";
  if (cell.text.empty()) reader.fail(cell, "empty cell" + in);
  double value = 0.0;
  if (!parse_number(std::string(cell.text), value)) {
    const std::string shown = printable(cell.text.substr(0, 40)) + (cell.text.size() > 40 ? "..." : "");
    reader.fail(cell, "'" + shown + "'" + in + " is not a finite decimal number in the range of double");
  }
  return value;
}

std::vector<double> read_row(const CsvReader& reader, const std::vector<std::string>& columns) {
  const auto& cells = reader.cells();
  if (cells.size() != columns.size()) {
    const auto& where = cells.size() > columns.size() ? cells[columns.size()] : cells.back();
    reader.fail(where, "this row has " + std::to_string(cells.size()) + " cells, the header " +
                           std::to_string(columns.size()));
  }
  std::vector<double> row;
  row.reserve(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) row.push_back(read_cell(reader, cells[i], columns[i]));
  return row;
}

}  // namespace

FileError::FileError(const std::string& file, int line, int column, const std::string& what)
    : InvalidInput(located(file, line, column, what)) {}

std::size_t NumericTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  throw FileError(file, 0, 0, "there is no column '" + printable(name) + "'; the columns are " + quoted_list(columns));
}

NumericTable read_table(const std::filesystem::path& path, const TableSchema& schema) {
  NumericTable table;
  table.file = path == "-" ? "standard input" : path.string();
  CsvReader reader(path, table.file);
  if (!reader.next()) throw FileError(table.file, 1, 1, "the file is empty: a line with column names is missing");
  table.columns = read_header(reader, schema);
  while (reader.next()) {
    table.rows.push_back(read_row(reader, table.columns));
    table.lines.push_back(reader.line());
  }
  if (table.rows.empty()) throw FileError(table.file, reader.line(), 0, "there are no rows below the header");
  return table;
}

}  // namespace strutt
