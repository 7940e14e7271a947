#pragma once

#include <toml++/toml.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/toml_source.hpp"

namespace strutt {

/// A parsed TOML document whose every complaint says where.
class TomlDocument {
 public:
  /// Throws FileError.
  TomlDocument(std::string_view text, std::string name);

  const toml::table& root() const { return root_; }
  const std::string& name() const { return name_; }

  [[noreturn]] void fail(const toml::source_region& where, const std::string& what) const;
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const { fail(node.source(), what); }

  /// The number that stands at this node, correctly rounded; a string is a quantity with a unit of
  /// `dimension`. Remembers that `path` stands there.
  double number(const toml::node& node, const std::string& path, std::string_view dimension) const;

  /// An integer in [least, most]; 3.0 is none.
  long long integer(const toml::node& node, const std::string& path, long long least, long long most) const;

  /// Where a parameter or other path was read, if it was.
  const toml::source_region* where(const std::string& path) const;
  void remember(const std::string& path, const toml::node& node) const { places_[path] = node.source(); }
  const std::map<std::string, toml::source_region>& places() const { return places_; }

 private:
  std::string name_;
  TomlSource source_;
  toml::table root_;
  mutable std::map<std::string, toml::source_region> places_;
};

/// Which values a number may have.
enum class Range { finite, positive, not_negative };

/// One table of the document, read key by key; keys that nobody asked for are errors. `path` is how messages
/// call it.
class TomlTable {
 public:
  TomlTable(const TomlDocument& document, const toml::node& node, std::string path);

  bool has(std::string_view key) const { return table_->contains(key); }
  const std::string& path() const { return path_; }
  std::string path_of(std::string_view key) const { return path_ + "." + std::string(key); }
  const TomlDocument& document() const { return *document_; }

  /// The node, or null; throws FileError from require() if it is missing.
  const toml::node* find(std::string_view key) const { return table_->get(key); }
  const toml::node& require(std::string_view key) const;

  double number(std::string_view key, std::string_view dimension, Range range = Range::finite) const;
  double number_or(std::string_view key, std::string_view dimension, double fallback,
                   Range range = Range::finite) const;
  std::string text(std::string_view key) const;
  /// Index of the text in `choices`; a missing key is index 0 if `optional`.
  std::size_t choice(std::string_view key, const std::vector<std::string>& choices, bool optional) const;

  /// Throws FileError for the first key that is not in `known`, naming the nearest one that is.
  void allow_only(const std::vector<std::string>& known) const;
  /// Throws FileError if both keys are there.
  void exclude(std::string_view a, std::string_view b) const;

  [[noreturn]] void fail(std::string_view key, const std::string& what) const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  const TomlDocument* document_;
  const toml::node* node_;
  const toml::table* table_;
  std::string path_;
};

/// The matrix that stands at this node as a list of rows; square.
Eigen::MatrixXd read_matrix(const TomlDocument& document, const toml::node& node, const std::string& path);

/// The elements of an array of tables; throws FileError for anything else.
std::vector<const toml::node*> read_list(const TomlDocument& document, const toml::node& node,
                                         const std::string& path);

}  // namespace strutt
