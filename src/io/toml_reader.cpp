#include "io/toml_reader.hpp"

#include <algorithm>
#include <cmath>

#include "io/text.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/scene_file.hpp"
#include "strutt/io/table.hpp"

namespace strutt {
namespace {

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    default:
      return "a date or time";
  }
}

std::string in_quotes(std::string_view text) { return "'" + printable(text) + "'"; }

std::string allowed(Range range) {
  if (range == Range::positive) return "a finite number > 0";
  return range == Range::not_negative ? "a finite number >= 0" : "a finite number";
}

bool is_in(Range range, double value) {
  if (!std::isfinite(value)) return false;
  if (range == Range::positive) return value > 0.0;
  return range == Range::finite || value >= 0.0;
}

toml::table parse(const std::string& text, const std::string& name) {
  try {
    return toml::parse(std::string_view(text));
  } catch (const toml::parse_error& error) {
    const auto& where = error.source().begin;
    throw FileError(name, static_cast<int>(where.line), static_cast<int>(where.column),
                    printable(error.description()));
  }
}

}  // namespace

TomlDocument::TomlDocument(std::string_view text, std::string name)
    : name_(std::move(name)), source_(prepare_toml(text, name_)), root_(parse(source_.text, name_)) {}

void TomlDocument::fail(const toml::source_region& where, const std::string& what) const {
  throw FileError(name_, static_cast<int>(where.begin.line), static_cast<int>(where.begin.column), what);
}

double TomlDocument::number(const toml::node& node, const std::string& path,
                            std::string_view dimension) const {
  remember(path, node);
  if (const auto* text = node.as_string()) {
    try {
      return parse_quantity(text->get(), dimension);
    } catch (const InvalidInput& error) {
      fail(node, path + ": " + error.what());
    }
  }
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  const auto* real = node.as_floating_point();
  if (real == nullptr)
    fail(node, path + " must be a number" + (dimension.empty() ? "" : " or a text with a unit") + ", not " +
                   kind_of(node));
  const auto& where = node.source().begin;
  const auto written = source_.numbers.find({static_cast<int>(where.line), static_cast<int>(where.column)});
  if (written == source_.numbers.end()) {
    if (std::isfinite(real->get())) return real->get();
    fail(node, InvalidInput(path, to_text(real->get()), "a finite number").what());
  }
  double value = 0.0;
  if (parse_number(written->second, value)) return value;
  fail(node, path + " is beyond the range of double");
}

long long TomlDocument::integer(const toml::node& node, const std::string& path, long long least,
                                long long most) const {
  remember(path, node);
  const std::string range = "an integer from " + std::to_string(least) + " to " + std::to_string(most);
  const auto* integer = node.as_integer();
  if (integer == nullptr) fail(node, path + " must be " + range);
  const long long value = integer->get();
  if (value < least || value > most) fail(node, InvalidInput(path, std::to_string(value), range).what());
  return value;
}

const toml::source_region* TomlDocument::where(const std::string& path) const {
  const auto found = places_.find(path);
  return found == places_.end() ? nullptr : &found->second;
}

TomlTable::TomlTable(const TomlDocument& document, const toml::node& node, std::string path)
    : document_(&document), node_(&node), table_(node.as_table()), path_(std::move(path)) {
  if (table_ == nullptr) document.fail(node, path_ + " must be a table, not " + kind_of(node));
  document.remember(path_, node);
}

const toml::node& TomlTable::require(std::string_view key) const {
  if (const auto* node = find(key)) return *node;
  document_->fail(*node_, path_of(key) + " is missing");
}

double TomlTable::number(std::string_view key, std::string_view dimension, Range range) const {
  const auto& node = require(key);
  const double value = document_->number(node, path_of(key), dimension);
  if (!is_in(range, value))
    document_->fail(node, InvalidInput(path_of(key), to_text(value), allowed(range)).what());
  return value;
}

double TomlTable::number_or(std::string_view key, std::string_view dimension, double fallback,
                            Range range) const {
  return has(key) ? number(key, dimension, range) : fallback;
}

std::string TomlTable::text(std::string_view key) const {
  const auto& node = require(key);
  document_->remember(path_of(key), node);
  if (const auto* value = node.as_string()) return value->get();
  document_->fail(node, path_of(key) + " must be a text, not " + kind_of(node));
}

std::size_t TomlTable::choice(std::string_view key, const std::vector<std::string>& choices,
                              bool optional) const {
  if (optional && !has(key)) return 0;
  const std::string value = text(key);
  const auto found = std::find(choices.begin(), choices.end(), value);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  std::string list;
  for (const auto& choice : choices) list += (list.empty() ? "" : ", ") + in_quotes(choice);
  const std::string close = nearest(value, choices);
  fail(key, path_of(key) + " = " + in_quotes(value) + " is not known; " +
                (close.empty() ? "it can be " + list : "did you mean " + in_quotes(close) + "?"));
}

void TomlTable::allow_only(const std::vector<std::string>& known) const {
  const toml::key* first =
      nullptr;  // toml++ sorts keys by name; the first in the file is what the reader looks for
  for (const auto& [key, node] : *table_) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const auto position = [](const toml::key& k) {
      return std::pair(k.source().begin.line, k.source().begin.column);
    };
    if (first == nullptr || position(key) < position(*first)) first = &key;
  }
  if (first == nullptr) return;
  document_->fail(first->source(), "unknown key " + in_quotes(first->str()) + " in [" + path_ + "]" +
                                       suggestion(first->str(), known));
}

void TomlTable::exclude(std::string_view a, std::string_view b) const {
  if (has(a) && has(b)) fail(b, path_of(a) + " and " + path_of(b) + " exclude each other");
}

void TomlTable::fail(std::string_view key, const std::string& what) const {
  const auto* node = find(key);
  document_->fail(node == nullptr ? *node_ : *node, what);
}

void TomlTable::fail(const std::string& what) const { document_->fail(*node_, what); }

std::vector<const toml::node*> read_list(const TomlDocument& document, const toml::node& node,
                                         const std::string& path) {
  document.remember(path, node);
  const auto* array = node.as_array();
  if (array == nullptr) document.fail(node, path + " must be a list, not " + kind_of(node));
  std::vector<const toml::node*> result;
  for (const auto& element : *array) result.push_back(&element);
  return result;
}

Eigen::MatrixXd read_matrix(const TomlDocument& document, const toml::node& node, const std::string& path) {
  const auto row_nodes = read_list(document, node, path);
  if (row_nodes.empty()) document.fail(node, path + " is empty: it must be a square matrix, a list of rows");
  std::vector<std::vector<const toml::node*>>
      rows;  // all of them before the matrix: its size is then what was typed
  for (const auto* row_node : row_nodes) {
    rows.push_back(read_list(document, *row_node, path + "." + std::to_string(rows.size())));
    if (rows.back().size() == row_nodes.size()) continue;
    document.fail(*row_node, path + " must be square: it has " + std::to_string(row_nodes.size()) +
                                 " rows, but row " + std::to_string(rows.size() - 1) + " has " +
                                 std::to_string(rows.back().size()) + " entries");
  }
  const auto size = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd result(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      const auto& entry = *rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      result(i, j) = document.number(entry, path + "." + std::to_string(i) + "." + std::to_string(j), "");
    }
  }
  return result;
}

}  // namespace strutt
