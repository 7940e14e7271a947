#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "support/ratchet.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace strutt::test {
namespace {

std::vector<std::string> tags;  // of the running test case
std::map<std::pair<std::string, double>, double>
    worst_by_name;  // what it has observed: (what, allowed) -> worst

/// One write to the end of the file, so that processes that run side by side do not mix their lines.
void append(const char* path, const std::string& lines) {
  const int file = ::open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  const auto written = file < 0 ? -1 : ::write(file, lines.data(), lines.size());
  if (file >= 0) ::close(file);
  if (written != static_cast<ssize_t>(lines.size())) std::abort();
}

struct Recorder : Catch::TestEventListenerBase {
  using TestEventListenerBase::TestEventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo& info) override {
    tags = info.tags;
    worst_by_name.clear();
  }
  void testCaseEnded(const Catch::TestCaseStats&) override {
    const char* path = std::getenv("STRUTT_ACCURACY_LOG");
    if (path == nullptr || worst_by_name.empty()) return;
    std::string lines;
    for (const auto& [key, observed] : worst_by_name)
      lines += fmt::format("{},{},{}\n", key.first, key.second, observed);
    append(path, lines);
  }
};
CATCH_REGISTER_LISTENER(Recorder)

bool has_tag(std::string_view tag) { return std::find(tags.begin(), tags.end(), tag) != tags.end(); }

bool names_a_row(std::string_view what) {
  const auto digit = [&](std::size_t i) { return what[i] >= '0' && what[i] <= '9'; };
  return what.size() > 3 && what[0] == 'N' && digit(1) && digit(2) && what[3] == ' ';
}

void require_name(std::string_view what) {
  INFO(std::string(what));
  REQUIRE(has_tag("ratchet"));
  if (names_a_row(what)) REQUIRE(has_tag(what.substr(0, 3)));
  REQUIRE(what.find(',') == std::string_view::npos);
}

}  // namespace

void check_within(std::string_view what, double observed, double allowed) {
  const auto [entry, is_new] = worst_by_name.try_emplace({std::string(what), allowed}, observed);
  if (is_new) require_name(what);
  entry->second = std::max(entry->second, observed);
  INFO(std::string(what));
  CHECK(observed <= allowed);
}

void check_close(std::string_view what, double value, double expected, double allowed) {
  check_within(what, value == expected ? 0.0 : std::abs(value / expected - 1.0), allowed);
}

}  // namespace strutt::test
