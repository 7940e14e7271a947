#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace strutt::app {

/// "strutt: error: ..." and the like on standard error, one line each, without control characters.
void print_error(std::string_view message);
void print_warning(std::string_view message);
void print_note(std::string_view message);

/// Text on standard output; throws InputOutputError.
void print_text(std::string_view text);

/// A bar with rate and time left, on standard error if that is a terminal, from the second second on.
class Progress {
 public:
  Progress(bool enabled, std::string unit);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::size_t done, std::size_t total);
  void clear();
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool shown_ = false;
  std::string unit_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
};

}  // namespace strutt::app
