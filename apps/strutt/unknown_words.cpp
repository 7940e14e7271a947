#include "unknown_words.hpp"

#include <algorithm>

#include "exit_code.hpp"
#include "strutt/base/error.hpp"

namespace strutt::app {
namespace {

bool is_flag(const std::string& word) { return word.starts_with("-"); }

std::string one_of(const std::vector<std::string>& commands) {
  std::string text;
  for (const auto& name : commands) text += (text.empty() ? "" : ", ") + name;
  return "the commands are " + text + " (see strutt --help)";
}

}  // namespace

void refuse_words(const std::vector<std::string>& words, const std::string& command,
                  const std::vector<std::string>& flags) {
  const auto found = std::find_if(words.begin(), words.end(), is_flag);
  if (found == words.end()) throw UsageError("unexpected argument '" + words.front() + "'");
  const std::string flag = found->substr(0, found->find('='));
  const std::string close = nearest(flag, flags);
  throw UsageError(
      "unknown flag '" + flag + "'" +
      (close.empty() ? " (see strutt " + command + " --help)" : "; did you mean '" + close + "'?"));
}

void refuse_command(const std::vector<std::string>& words, const std::vector<std::string>& commands) {
  if (words.empty()) throw UsageError("no command; " + one_of(commands));
  const std::string& word = words.front();
  if (is_flag(word)) throw UsageError("unknown flag '" + word + "'; " + one_of(commands));
  const std::string close = nearest(word, commands);
  throw UsageError("unknown command '" + word + "'; " +
                   (close.empty() ? one_of(commands) : "did you mean '" + close + "'?"));
}

}  // namespace strutt::app
