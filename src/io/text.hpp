#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace strutt {

/// Where in a text something stands; lines and columns (in characters) count from 1.
struct TextPosition {
  int line = 1;
  int column = 1;
};

/// The text with control and other non-printable bytes as \xNN, so that a name cannot drive a terminal.
std::string printable(std::string_view text);

/// Bytes of the UTF-8 sequence at `text[at]`, 0 if it is not one (overlong forms and surrogates are not).
std::size_t utf8_length(std::string_view text, std::size_t at);

/// Why a text is not plain UTF-8, and where; `problem` is empty if all is well.
struct TextProblem {
  std::string problem;
  TextPosition where;
};

/// Looks for bytes that are not UTF-8 and for control characters other than tab, LF and CR before LF.
TextProblem find_text_problem(std::string_view text);

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Drops a UTF-8 byte order mark.
std::string_view without_byte_order_mark(std::string_view text);

/// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// The whole file (`-`: standard input). Reading stops after `limit` + 1 bytes: a longer result means a
/// larger file. Throws InputOutputError.
std::string read_file(const std::filesystem::path& path, std::size_t limit);

}  // namespace strutt
