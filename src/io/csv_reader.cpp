#include "io/csv_reader.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <climits>

#include "io/text.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/table.hpp"

namespace strutt {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16;
/// A guard against files that are no tables; numbers of a million digits still fit.
constexpr std::size_t kLongestLine = std::size_t{1} << 24;

}  // namespace

/// The open file.
class CsvReader::Input {
 public:
  Input(const std::filesystem::path& path, std::string name)
      : name_(std::move(name)), fd_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (fd_ < 0) throw InputOutputError("cannot open '" + printable(name_) + "'", errno);
  }
  ~Input() {
    if (fd_ != STDIN_FILENO) ::close(fd_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  std::size_t read(char* to, std::size_t most) {
    for (;;) {
      const ssize_t got = ::read(fd_, to, most);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) throw InputOutputError("cannot read '" + printable(name_) + "'", errno);
    }
  }

 private:
  std::string name_;
  int fd_;
};

CsvReader::CsvReader(const std::filesystem::path& path, std::string name)
    : input_(std::make_unique<Input>(path, name)), name_(std::move(name)) {}

CsvReader::~CsvReader() = default;

void CsvReader::fail(const CsvCell& cell, const std::string& what) const {
  throw FileError(name_, line_, cell.column, what);
}

bool CsvReader::fill() {
  buffer_.resize(kBlockBytes);
  buffer_.resize(input_->read(buffer_.data(), kBlockBytes));
  position_ = 0;
  return !buffer_.empty();
}

bool CsvReader::read_line() {
  text_.clear();
  bool any = false;
  for (;;) {
    if (position_ == buffer_.size() && !fill()) break;
    any = true;
    const auto end = buffer_.find('\n', position_);
    text_.append(buffer_, position_, end == std::string::npos ? end : end - position_);
    position_ = end == std::string::npos ? buffer_.size() : end + 1;
    if (end != std::string::npos) break;
    if (text_.size() > kLongestLine) throw FileError(name_, line_ + 1, 1, "the line is longer than 16 MiB");
  }
  if (!any) return false;
  if (line_ == INT_MAX) throw FileError(name_, line_, 0, "too many lines");
  ++line_;
  if (!text_.empty() && text_.back() == '\r') text_.pop_back();
  if (line_ == 1) text_.erase(0, text_.size() - without_byte_order_mark(text_).size());
  return true;
}

void CsvReader::check_line() const {
  const auto problem = find_text_problem(text_);
  if (!problem.problem.empty()) throw FileError(name_, line_, problem.where.column, problem.problem);
}

void CsvReader::split() {
  cells_.clear();
  const std::string_view text = text_;
  int column = 1;
  for (std::size_t begin = 0;;) {
    const auto comma = text.find(',', begin);
    const auto raw = text.substr(begin, comma == std::string_view::npos ? comma : comma - begin);
    const auto cell = trimmed(raw);
    const auto blanks = cell.empty() ? std::size_t{0} : raw.find_first_not_of(" \t");
    cells_.push_back({cell, column + static_cast<int>(blanks)});
    if (cell.find('"') != std::string_view::npos) fail(cells_.back(), "quotation marks are not allowed");
    if (comma == std::string_view::npos) return;
    for (const char c : raw) column += (c & 0xC0) != 0x80 ? 1 : 0;
    ++column;
    begin = comma + 1;
  }
}

bool CsvReader::next() {
  while (read_line()) {
    check_line();
    if (text_.starts_with('#')) continue;
    if (trimmed(text_).empty()) {
      if (started_ && blank_line_ == 0) blank_line_ = line_;
      continue;
    }
    if (blank_line_ != 0) throw FileError(name_, blank_line_, 1, "blank line inside the table");
    started_ = true;
    split();
    return true;
  }
  return false;
}

}  // namespace strutt
