#pragma once

#include <filesystem>
#include <string>

namespace strutt {

/// The ending of a path, which tells the format, in lower case: ".csv".
std::string ending_of(const std::filesystem::path& path);

/// A device or pipe has no ending; text is what can be piped.
bool is_device(const std::filesystem::path& path);

}  // namespace strutt
