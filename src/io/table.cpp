#include "strutt/io/table.hpp"

#include <algorithm>

#include "io/csv_reader.hpp"
#include "io/text.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt {
namespace {

std::string located(const std::string& file, int line, int column, const std::string& what) {
  std::string result = printable(file);
  if (line > 0) result += ":" + std::to_string(line);
  if (line > 0 && column > 0) result += ":" + std::to_string(column);
  return result + ": " + what;
}

std::string printable_list(std::vector<std::string> names) {
  for (auto& name : names) name = printable(name);
  return quoted_list(names);
}

/// A column as its header describes it.
struct Header {
  std::string name;
  std::string unit;       // empty: that of the dimension
  std::string dimension;  // the SI unit
};

/// The parts of `name` or `name [unit]`.
Header split_header(std::string_view text, const TableSchema& schema) {
  Header header{.name = std::string(text), .unit = {}, .dimension = {}};
  const auto bracket = text.find('[');
  const bool has_unit = bracket != std::string_view::npos && text.back() == ']';
  if (has_unit) header.name = trimmed(text.substr(0, bracket));
  const auto found = schema.units.find(header.name);
  if (found == schema.units.end()) return header;
  header.dimension = found->second;
  if (has_unit) header.unit = trimmed(text.substr(bracket + 1, text.size() - bracket - 2));
  return header;
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
  if (contains(seen, name))
    reader.fail(cell, "the column '" + printable(name) + "' stands here a second time");
  if (contains(known, name)) return;
  reader.fail(cell, "unknown column '" + printable(name) + "'" + suggestion(name, known));
}

/// A decimal number, checked before, in the unit of its column.
double converted(const CsvReader& reader, const CsvCell& cell, const std::string& number,
                 const Header& header) {
  try {
    return parse_quantity(number + " " + header.unit, header.dimension);
  } catch (const InvalidInput& error) {
    reader.fail(cell, "column '" + printable(header.name) + "': " + error.what());
  }
}

std::vector<Header> read_header(CsvReader& reader, const TableSchema& schema) {
  const auto& cells = reader.cells();
  const auto known = known_names(schema);
  std::vector<Header> headers;
  std::vector<std::string> names;
  for (const auto& cell : cells) {
    headers.push_back(split_header(cell.text, schema));
    check_name(reader, cell, headers.back().name, names, known);
    names.push_back(headers.back().name);
    if (!headers.back().unit.empty()) converted(reader, cell, "1", headers.back());  // does the unit fit?
  }
  for (const auto& name : schema.required) {
    if (!contains(names, name)) {
      reader.fail(cells.front(),
                  "the column '" + name + "' is missing; the columns are " + printable_list(names));
    }
  }
  return headers;
}

double read_cell(const CsvReader& reader, const CsvCell& cell, const Header& header) {
  const std::string in = " in column '" + printable(header.name) + "'";
  if (cell.text.empty()) reader.fail(cell, "empty cell" + in);
  double value = 0.0;
  if (!parse_number(std::string(cell.text), value)) {
    const std::string shown = printable(cell.text.substr(0, 40)) + (cell.text.size() > 40 ? "..." : "");
    reader.fail(cell, "'" + shown + "'" + in + " is not a finite decimal number in the range of double");
  }
  return header.unit.empty() ? value : converted(reader, cell, std::string(cell.text), header);
}

std::vector<double> read_row(const CsvReader& reader, const std::vector<Header>& columns) {
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
  throw FileError(file, 0, 0,
                  "there is no column '" + printable(name) + "'; the columns are " + printable_list(columns));
}

FileError NumericTable::error_at(std::size_t row, std::size_t column, const std::string& what) const {
  return {file, lines.at(row), cell_columns.at(row * columns.size() + column), what};
}

NumericTable read_table(const std::filesystem::path& path, const TableSchema& schema) {
  NumericTable table;
  table.file = path == "-" ? "standard input" : path.string();
  CsvReader reader(path, table.file);
  if (!reader.next())
    throw FileError(table.file, 1, 1, "the file is empty: a line with column names is missing");
  const auto headers = read_header(reader, schema);
  for (const auto& header : headers) table.columns.push_back(header.name);
  while (reader.next()) {
    table.rows.push_back(read_row(reader, headers));
    table.lines.push_back(reader.line());
    for (const auto& cell : reader.cells()) table.cell_columns.push_back(cell.column);
  }
  if (table.rows.empty()) throw FileError(table.file, reader.line(), 0, "there are no rows below the header");
  return table;
}

}  // namespace strutt
