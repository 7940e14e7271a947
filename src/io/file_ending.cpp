#include "io/file_ending.hpp"

namespace strutt {

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

bool is_device(const std::filesystem::path& path) {
  std::error_code ignored;
  return path.string().starts_with("/dev/") || std::filesystem::is_other(path, ignored);
}

}  // namespace strutt
