#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "support/ratchet.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>
#include <vector>

namespace strutt::test {
namespace {

std::vector<std::string> tags_now;

struct TagWatcher : Catch::TestEventListenerBase {
  using TestEventListenerBase::TestEventListenerBase;
  void testCaseStarting(const Catch::TestCaseInfo& info) override { tags_now = info.tags; }
};
CATCH_REGISTER_LISTENER(TagWatcher)

bool has_tag(std::string_view tag) {
  return std::find(tags_now.begin(), tags_now.end(), tag) != tags_now.end();
}

bool names_a_row(std::string_view what) {
  const auto digit = [&](std::size_t i) { return what[i] >= '0' && what[i] <= '9'; };
  return what.size() > 3 && what[0] == 'N' && digit(1) && digit(2) && what[3] == ' ';
}

/// One write to the end of the file, so that tests that run side by side do not mix their lines.
void append(const char* path, const std::string& line) {
  const int file = ::open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  REQUIRE(file >= 0);
  const auto written = ::write(file, line.data(), line.size());
  ::close(file);
  REQUIRE(written == static_cast<ssize_t>(line.size()));
}

}  // namespace

void check_within(std::string_view what, double observed, double allowed) {
  INFO(std::string(what));
  REQUIRE(has_tag("ratchet"));
  if (names_a_row(what)) REQUIRE(has_tag(what.substr(0, 3)));
  REQUIRE(what.find(',') == std::string_view::npos);
  CHECK(observed <= allowed);
  if (const char* path = std::getenv("STRUTT_ACCURACY_LOG"))
    append(path, fmt::format("{},{},{}\n", what, allowed, observed));
}

}  // namespace strutt::test
