#include "recorded_command.hpp"

#include <array>
#include <string_view>

namespace strutt::app {
namespace {

// Flags that change neither the numbers nor how they are written, with the number of values they take.
struct SilentFlag {
  std::string_view name;
  bool takes_value;
};
constexpr std::array<SilentFlag, 6> kSilentFlags{{{"--threads", true},
                                                  {"-o", true},
                                                  {"--output", true},
                                                  {"--figure", true},
                                                  {"--quiet", false},
                                                  {"--force", false}}};

std::string quoted(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

std::string recorded_command(int argc, const char* const* argv) {
  std::string text = "strutt";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    bool silent = false;
    for (const auto& flag : kSilentFlags) {
      const bool attached =
          word.starts_with(std::string(flag.name) + "=") || (flag.name == "-o" && word.starts_with("-o"));
      if (word != flag.name && !attached) continue;
      silent = true;
      if (word == flag.name && flag.takes_value) ++i;
      break;
    }
    if (!silent) text += " " + quoted(word);
  }
  return text;
}

}  // namespace strutt::app
