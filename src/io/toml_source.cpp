#include "io/toml_source.hpp"

#include "io/text.hpp"
#include "strutt/io/table.hpp"

namespace strutt {
namespace {

constexpr std::size_t kSafeIntegerDigits = 18;

bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' || c == '-' ||
         c == '_' || c == '.';
}

/// Goes over digits with single underscores between them; returns false if there are none.
bool skip_digits(std::string_view word, std::size_t& at) {
  if (at >= word.size() || !is_digit(word[at])) return false;
  while (at < word.size() &&
         (is_digit(word[at]) || (word[at] == '_' && at + 1 < word.size() && is_digit(word[at + 1])))) {
    ++at;
  }
  return true;
}

/// Whether a word is a number as TOML writes it that should not be left to the parser.
bool needs_own_conversion(std::string_view word) {
  std::size_t at = word.starts_with('+') || word.starts_with('-') ? 1 : 0;
  const std::size_t first = at;
  if (!skip_digits(word, at)) return false;
  const std::size_t integer_digits = at - first;
  if (word[first] == '0' && integer_digits > 1)
    return false;  // no leading zeros in TOML: the parser complains
  if (at == word.size()) return integer_digits > kSafeIntegerDigits;
  if (word[at] == '.' && !skip_digits(word, ++at)) return false;
  if (at < word.size() && (word[at] == 'e' || word[at] == 'E')) {
    ++at;
    if (at < word.size() && (word[at] == '+' || word[at] == '-')) ++at;
    if (!skip_digits(word, at)) return false;
  }
  return at == word.size();
}

/// Walks over the text as TOML lexes it: strings and comments are skipped, values told from keys.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& name) : name_(name) { source_.text = text; }

  TomlSource run() {
    while (at_ < source_.text.size()) step();
    return std::move(source_);
  }

 private:
  char here(std::size_t ahead = 0) const {
    return at_ + ahead < source_.text.size() ? source_.text[at_ + ahead] : '\0';
  }

  void advance(std::size_t count = 1) {
    for (; count > 0 && at_ < source_.text.size(); --count, ++at_) {
      const char c = source_.text[at_];
      if (c == '\n') {
        ++where_.line;
        where_.column = 1;
      } else if ((c & 0xC0) != 0x80) {
        ++where_.column;
      }
    }
  }

  void check_depth() const {
    if (brackets_ + dots_ <= kDeepestNesting) return;
    throw FileError(name_, where_.line, where_.column,
                    "nesting is deeper than " + std::to_string(kDeepestNesting) + " levels");
  }

  void step() {
    const char c = here();
    if (c == '"' || c == '\'') return skip_string(c);
    if (c == '#') {
      while (here() != '\n' && at_ < source_.text.size()) advance();
      return;
    }
    if (is_word(c)) return read_word();
    if (c == '\n' && brackets_ == 0) {
      in_value_ = false;
      dots_ = 0;
    }
    if (c == '\n' && header_) {
      header_ = false;
      brackets_ = 0;
    }
    step_mark(c);
    advance();
  }

  void step_mark(char c) {
    if (c == '[' || c == '{') {
      if (brackets_ == 0 && !in_value_) header_ = true;
      ++brackets_;
      check_depth();
    }
    if ((c == ']' || c == '}') && brackets_ > 0) --brackets_;
    if (c == '=') in_value_ = true;
    if (c == '=' || c == ',') dots_ = 0;
  }

  void skip_string(char quote) {
    const bool block = here(1) == quote && here(2) == quote;
    if (!block && here(1) == quote) return advance(2);
    advance(block ? 3 : 1);
    while (at_ < source_.text.size()) {
      if (here() == '\\' && quote == '"') {
        advance(2);
        continue;
      }
      if (!block && here() == '\n') return;  // not closed: the parser will say so
      if (here() == quote && (!block || (here(1) == quote && here(2) == quote)))
        return close_string(quote, block);
      advance();
    }
  }

  /// A block may end with one or two quotation marks of its own before the closing three.
  void close_string(char quote, bool block) {
    advance(block ? 3 : 1);
    for (int i = 0; block && i < 2 && here() == quote; ++i) advance();
  }

  /// Whether the words just read are a key: what follows is `=`, or they stand in a header or before any `=`.
  bool is_key(std::size_t after) const {
    if (!in_value_ || header_) return true;
    const auto next = source_.text.find_first_not_of(" \t", after);
    return next != std::string::npos && source_.text[next] == '=';
  }

  void read_word() {
    std::size_t end = at_;
    while (end < source_.text.size() && is_word(source_.text[end])) ++end;
    const std::string word = source_.text.substr(at_, end - at_);
    if (is_key(end) || brackets_ > 0) count_dots(word);
    if (!is_key(end) && needs_own_conversion(word)) replace(word);
    advance(word.size());
  }

  /// Dots outside numbers are levels of a key. Between brackets a word can be part of a key with blanks
  /// around its dots.
  void count_dots(const std::string& word) {
    if (needs_own_conversion(word)) return;
    for (const char c : word) dots_ += c == '.' ? 1 : 0;
    check_depth();
  }

  void replace(const std::string& word) {
    std::string& number = source_.numbers[{where_.line, where_.column}];
    for (const char c : word) {
      if (c != '_') number += c;
    }
    source_.text.replace(at_, word.size(), "0.0" + std::string(word.size() - 3, ' '));
  }

  TomlSource source_;
  const std::string& name_;
  std::size_t at_ = 0;
  TextPosition where_;
  int brackets_ = 0;
  int dots_ = 0;           // in the key that is being read
  bool in_value_ = false;  // after the `=` of this line
  bool header_ = false;    // inside [table] or [[table]]
};

}  // namespace

TomlSource prepare_toml(std::string_view text, const std::string& name) {
  if (text.size() > kLargestScene) throw FileError(name, 0, 0, "the file is larger than 1 MiB");
  text = without_byte_order_mark(text);
  const auto problem = find_text_problem(text);
  if (!problem.problem.empty())
    throw FileError(name, problem.where.line, problem.where.column, problem.problem);
  return Scanner(text, name).run();
}

}  // namespace strutt
