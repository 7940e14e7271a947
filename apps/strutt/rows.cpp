#include "rows.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "strutt/base/error.hpp"

namespace strutt::app {
namespace {

std::filesystem::path target(const std::filesystem::path& path) { return path == "-" ? "/dev/stdout" : path; }

std::string json_number(double value) {
  if (!std::isfinite(value)) return "\"" + to_text(value) + "\"";
  const std::string text = to_text(value);
  // Readers that know integers take -0 as 0.
  return text == "-0" ? "-0.0" : text;
}

}  // namespace

Cell number(double x) { return std::isnan(x) ? Cell() : Cell(x); }
Cell number(const std::optional<double>& x) { return x ? Cell(*x) : Cell(); }
Cell number(const std::optional<int>& x) { return x ? Cell(static_cast<double>(*x)) : Cell(); }
Cell word(Method method) { return std::string(to_string(method)); }

RowWriter::RowWriter(const std::filesystem::path& path, bool json, std::vector<Column> columns,
                     const Provenance& provenance)
    : file_(target(path)), json_(json), columns_(std::move(columns)) {
  if (json_) {
    file_.write("{\"schema_version\":1,\"provenance\":" + json_text(provenance) + ",\"rows\":[");
    // Names become keys once for all rows.
    for (auto& column : columns_) column.name = nlohmann::ordered_json(column.name).dump() + ":";
    return;
  }
  std::string units, names;
  for (const auto& column : columns_) {
    units += column.unit + ",";
    names += column.name + ",";
  }
  units.back() = names.back() = '\n';
  file_.write(comment_lines(provenance) + "# units: " + units + names);
}

void RowWriter::write(std::span<const Cell> row) {
  if (row.size() != columns_.size())
    throw std::logic_error("a row has another number of cells than there are columns");
  line_.clear();
  if (json_)
    write_json(row);
  else
    write_csv(row);
  file_.write(line_);
  first_ = false;
}

void RowWriter::write_csv(std::span<const Cell> row) {
  for (const Cell& cell : row) {
    if (const auto* number = std::get_if<double>(&cell)) line_ += to_text(*number);
    if (const auto* word = std::get_if<std::string>(&cell)) line_ += *word;
    line_ += ',';
  }
  line_.back() = '\n';
}

void RowWriter::write_json(std::span<const Cell> row) {
  line_ += first_ ? "\n{" : ",\n{";
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) line_ += ',';
    line_ += columns_[i].name;
    if (const auto* number = std::get_if<double>(&row[i]))
      line_ += json_number(*number);
    else if (const auto* word = std::get_if<std::string>(&row[i]))
      line_ += nlohmann::ordered_json(*word).dump();
    else
      line_ += "null";
  }
  line_ += '}';
}

void RowWriter::conclude(const Provenance& done) { done_ = done; }

void RowWriter::prepare() {
  if (json_ && !complete_)
    file_.write("\n]" + (done_.empty() ? "" : ",\"done\":" + json_text(done_)) + "}\n");
  if (!json_ && !complete_) file_.write(comment_lines(done_));
  complete_ = true;
  file_.prepare();
}

void RowWriter::commit() {
  prepare();
  file_.commit();
}

}  // namespace strutt::app
