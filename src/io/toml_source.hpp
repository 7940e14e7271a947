#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "io/text.hpp"

namespace strutt {

/// A TOML text made ready for a parser whose own conversion of decimals is neither exact nor of any length:
/// each number that is not a plain small integer stands as 0.0 and blanks in `text`, so every position stays
/// what it was; what the author wrote is kept in `numbers`.
struct TomlSource {
  std::string text;
  std::map<std::pair<int, int>, std::string>
      numbers;  ///< (line, column) -> decimal text, without underscores
};

/// Checks size (1 MiB), characters, and nesting (32 levels of brackets and dots), before a recursive parser
/// may see it. Throws FileError; `name` stands for the file in messages.
TomlSource prepare_toml(std::string_view text, const std::string& name);

inline constexpr std::size_t kLargestScene = std::size_t{1} << 20;
inline constexpr int kDeepestNesting = 32;

}  // namespace strutt
