#include "strutt/io/column_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/column_writers.hpp"
#include "io/file_ending.hpp"
#include "io/npy.hpp"
#include "io/text.hpp"
#include "io/zip_layout.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

using Writer = void (*)(OutputFile&, const std::string&, const DataTable&);

struct TableFormat {
  std::string_view ending;
  Writer writer;
};

constexpr TableFormat kTableFormats[] = {{".csv", write_csv_columns},
                                         {".npz", write_npz_columns},
                                         {".h5", write_hdf5_columns},
                                         {".hdf5", write_hdf5_columns}};

Writer writer_for(const std::filesystem::path& path) {
  if (path == "-") return write_csv_columns;
  const std::string ending = ending_of(path);
  for (const auto& format : kTableFormats) {
    if (format.ending == ending) return format.writer;
  }
  if (is_device(path)) return write_csv_columns;
  throw InvalidInput("the format of '" + printable(path.string()) +
                     "' is not known: a table of this kind ends with .csv, .npz, .h5 or .hdf5");
}

using Json = nlohmann::ordered_json;

std::string metadata(const DataTable& table) {
  Json columns = Json::object();
  for (const auto& column : table.columns) {
    Json entry{{"unit", column.unit}, {"long_name", column.long_name}};
    for (std::size_t k = 0; k < column.categories.size(); ++k) entry["values"][column.categories[k]] = k;
    columns[column.name] = entry;
  }
  const Json json{{"schema_version", 1},
                  {"title", table.title},
                  {"columns", columns},
                  {"provenance", Json::parse(json_text(table.provenance))}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string array_bytes(const DataColumn& column) {
  return npy_header(column.categories.empty() ? "<f8" : "|i1", {column.values.size()}) + column_bytes(column);
}

}  // namespace

ColumnFile::ColumnFile(const std::filesystem::path& path)
    : name_(path.string()), writer_(writer_for(path)), file_(path == "-" ? "/dev/stdout" : path) {}

void ColumnFile::write(const DataTable& table) { writer_(file_, name_, table); }

std::size_t row_count(const DataTable& table) {
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().values.size();
  for (const auto& column : table.columns) {
    if (column.values.size() != rows) throw std::logic_error("the columns of a table differ in length");
  }
  return rows;
}

std::string column_bytes(const DataColumn& column) {
  const auto& values = column.values;
  if (column.categories.empty())
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
  std::string bytes(values.size(), '\0');
  std::transform(values.begin(), values.end(), bytes.begin(), [](double v) { return static_cast<char>(v); });
  return bytes;
}

void write_csv_columns(OutputFile& file, const std::string&, const DataTable& table) {
  std::string units = "# units: ", names, line;
  for (const auto& column : table.columns) {
    units += (names.empty() ? "" : ",") + column.unit;
    names += (names.empty() ? "" : ",") + column.name;
  }
  file.write(comment_lines(table.provenance) + units + "\n" + names + "\n");
  for (std::size_t row = 0; row < row_count(table); ++row) {
    line.clear();
    for (const auto& column : table.columns) {
      const double value = column.values[row];
      line +=
          column.categories.empty() ? to_text(value) : column.categories.at(static_cast<std::size_t>(value));
      line += ',';
    }
    line.back() = '\n';
    file.write(line);
  }
  file.commit();
}

void write_npz_columns(OutputFile& file, const std::string&, const DataTable& table) {
  row_count(table);
  std::vector<ZipMember> members;
  std::vector<std::string> contents;
  std::vector<std::uint32_t> checksums;
  const auto add = [&](const std::string& name, std::string content) {
    const auto* const data = reinterpret_cast<const Bytef*>(content.data());
    checksums.push_back(static_cast<std::uint32_t>(crc32_z(0, data, content.size())));
    members.push_back({name, content.size()});
    contents.push_back(std::move(content));
  };
  for (const auto& column : table.columns) add(column.name + ".npy", array_bytes(column));
  add("meta.json", metadata(table));
  const ZipLayout layout(members);
  for (std::size_t m = 0; m < members.size(); ++m) {
    file.write(layout.local_header(m, checksums[m]));
    file.write(contents[m]);
  }
  file.write(layout.directory(checksums));
  file.commit();
}

}  // namespace strutt
