#include "strutt/io/provenance.hpp"

#include <H5public.h>
#include <fmt/format.h>
#include <toml++/impl/version.h>
#include <zlib.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string_view>

#include "io/text.hpp"
#include "strutt/base/instruction_set.hpp"

// SUNDIALS' headers stay in src/integrate; for the version of the loaded library one declaration is enough.
extern "C" int SUNDIALSGetVersion(char* version, int length);

namespace strutt {
namespace {

/// SOURCE_DATE_EPOCH if it is a number of seconds, otherwise the clock.
std::time_t build_time() {
  const char* const text = std::getenv("SOURCE_DATE_EPOCH");
  if (text != nullptr && *text != '\0') {
    const std::string_view epoch = text;
    long long seconds = 0;
    const auto [stop, error] = std::from_chars(epoch.data(), epoch.data() + epoch.size(), seconds);
    constexpr long long year_9999 = 253402300799;
    if (error == std::errc{} && stop == epoch.data() + epoch.size() && seconds >= 0 && seconds <= year_9999) {
      return static_cast<std::time_t>(seconds);
    }
  }
  return std::time(nullptr);
}

std::string utc_date() {
  const std::time_t now = build_time();
  std::tm parts{};
  if (gmtime_r(&now, &parts) == nullptr) return "unknown";
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

std::string sundials_version() {
  char text[32] = "";
  return SUNDIALSGetVersion(text, static_cast<int>(sizeof text)) == 0 ? text : "unknown";
}

/// The library versions: of the headers where the code is compiled in, of the loaded library where it can
/// tell.
std::string libraries() {
  const int fmt_version = FMT_VERSION;
  return fmt::format(
      "SUNDIALS {}, Eigen {}.{}.{}, Boost {}.{}.{}, HDF5 {}.{}.{}, toml++ {}.{}.{}, nlohmann-json {}.{}.{}, "
      "fmt {}.{}.{}, zlib {}",
      sundials_version(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
      BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100, H5_VERS_MAJOR, H5_VERS_MINOR,
      H5_VERS_RELEASE, TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH, NLOHMANN_JSON_VERSION_MAJOR,
      NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH, fmt_version / 10000, fmt_version / 100 % 100,
      fmt_version % 100, zlibVersion());
}

}  // namespace

Provenance make_provenance(const std::string& command) {
  Provenance result{{"program", "strutt"},
                    {"version", STRUTT_VERSION},
                    {"compiler", compiler()},
                    {"libraries", libraries()},
                    {"instruction set", std::string(to_string(instruction_set()))},
                    {"date", utc_date()}};
  if (!command.empty()) result.emplace_back("command", command);
  return result;
}

std::string comment_lines(const Provenance& provenance) {
  std::string result;
  for (const auto& [name, value] : provenance) {
    result += "# " + printable(name) + ": ";
    for (std::size_t begin = 0;;) {
      const auto end = value.find('\n', begin);
      result +=
          printable(std::string_view(value).substr(begin, end == std::string::npos ? end : end - begin)) +
          "\n";
      if (end == std::string::npos || end + 1 == value.size()) break;
      begin = end + 1;
      result += "#   ";
    }
  }
  return result;
}

std::string json_text(const Provenance& provenance) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [name, value] : provenance) object[name] = value;
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string version_text() { return std::string(STRUTT_VERSION) + " (" + libraries() + ")"; }

}  // namespace strutt
