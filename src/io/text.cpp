#include "io/text.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "strutt/base/error.hpp"

namespace strutt {
namespace {

bool is_continuation(std::string_view text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;
}

std::string hexadecimal(unsigned char byte) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  return {digits[byte >> 4], digits[byte & 15]};
}

bool is_control(unsigned char byte) { return byte < 0x20 || byte == 0x7F; }

/// C1 control characters (U+0080..U+009F): some terminals obey them.
bool is_c1_control(std::string_view text, std::size_t at) {
  return text[at] == '\xC2' && static_cast<unsigned char>(text[at + 1]) < 0xA0;
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ > STDERR_FILENO) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation(text, at + i)) return 0;
  }
  const auto second = static_cast<unsigned char>(text[at + 1]);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool surrogate = first == 0xED && second > 0x9F;
  const bool too_large = first == 0xF4 && second > 0x8F;
  return overlong || surrogate || too_large ? 0 : length;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const auto byte = static_cast<unsigned char>(text[i]);
    if (length == 0 || is_control(byte) || is_c1_control(text, i)) {
      for (std::size_t k = 0; k < std::max<std::size_t>(length, 1); ++k) {
        result += "\\x" + hexadecimal(static_cast<unsigned char>(text[i + k]));
      }
    } else {
      result += text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

TextProblem find_text_problem(std::string_view text) {
  TextPosition where;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length(text, i);
    if (length == 0) return {"the byte 0x" + hexadecimal(byte) + " is not part of valid UTF-8", where};
    const bool end_of_line = byte == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (is_control(byte) && byte != '\t' && byte != '\n' && !end_of_line) {
      return {"the control character 0x" + hexadecimal(byte) + " is not allowed", where};
    }
    if (byte == '\n') {
      ++where.line;
      where.column = 1;
    } else {
      ++where.column;
    }
    i += length;
  }
  return {};
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string read_file(const std::filesystem::path& path, std::size_t limit) {
  const bool standard_input = path == "-";
  const std::string name = standard_input ? "standard input" : "'" + printable(path.string()) + "'";
  const Descriptor file(standard_input ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) throw InputOutputError("cannot open " + name, errno);
  std::string result;
  std::string block(std::min<std::size_t>(limit + 1, std::size_t{1} << 16), '\0');
  while (result.size() <= limit) {
    const ssize_t got = ::read(file.get(), block.data(), std::min(block.size(), limit + 1 - result.size()));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputOutputError("cannot read " + name, errno);
    if (got == 0) break;
    result.append(block, 0, static_cast<std::size_t>(got));
  }
  return result;
}

}  // namespace strutt
