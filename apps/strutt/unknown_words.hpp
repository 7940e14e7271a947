#pragma once

#include <string>
#include <vector>

namespace strutt::app {

/// Throws UsageError about the words that `command` does not take: about the first flag among them, with the
/// nearest of its `flags`, else about the first word.
[[noreturn]] void refuse_words(const std::vector<std::string>& words, const std::string& command,
                               const std::vector<std::string>& flags);

/// Throws UsageError about words that begin with none of the `commands`, or about no words at all.
[[noreturn]] void refuse_command(const std::vector<std::string>& words,
                                 const std::vector<std::string>& commands);

}  // namespace strutt::app
