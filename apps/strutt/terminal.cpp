#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>

#include "strutt/io/output_file.hpp"

namespace strutt::app {
namespace {

void write_to_stderr(std::string_view text) {
  while (!text.empty()) {
    const auto done = ::write(STDERR_FILENO, text.data(), text.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return;  // nobody to tell
    text.remove_prefix(static_cast<std::size_t>(done));
  }
}

void print_line(std::string_view kind, std::string_view message) {
  std::string line = "strutt: " + std::string(kind);
  for (const char c : message) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte == 0x7f ? ' ' : c;
  }
  write_to_stderr(line + "\n");
}

std::string duration_text(double seconds) {
  if (!(seconds < 1e7)) return "very long";
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

void print_error(std::string_view message) { print_line("error: ", message); }
void print_warning(std::string_view message) { print_line("warning: ", message); }
void print_note(std::string_view message) { print_line("", message); }

void print_text(std::string_view text) {
  OutputFile out("/dev/stdout");
  out.write(text);
  out.commit();
}

Progress::Progress(bool enabled, std::string unit)
    : enabled_(enabled && ::isatty(STDERR_FILENO) == 1), unit_(std::move(unit)) {}

double Progress::seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

void Progress::update(std::size_t done, std::size_t total) {
  constexpr auto kQuiet = std::chrono::seconds(1);
  constexpr auto kRefresh = std::chrono::milliseconds(200);
  const auto now = Clock::now();
  if (!enabled_ || total == 0 || now - begin_ < kQuiet || (shown_ && now - last_ < kRefresh)) return;
  last_ = now;
  shown_ = true;
  constexpr std::size_t width = 24;
  const double share = static_cast<double>(done) / static_cast<double>(total);
  const auto filled = static_cast<std::size_t>(share * width);
  const double rate = static_cast<double>(done) / seconds();
  const double left = static_cast<double>(total - done) / rate;
  write_to_stderr(fmt::format("\r[{:=<{}}{: <{}}] {:3.0f} % {:.3g} {}/s, {} left \x1b[K", "", filled, "",
                              width - filled, 100.0 * share, rate, unit_,
                              done == 0 ? "?" : duration_text(left)));
}

void Progress::clear() {
  if (shown_) write_to_stderr("\r\x1b[K");
  shown_ = false;
}

}  // namespace strutt::app
