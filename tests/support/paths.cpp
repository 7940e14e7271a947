#include "support/paths.hpp"

namespace strutt::test {

std::string source_directory() { return STRUTT_SOURCE_DIR; }
std::string program_path() { return STRUTT_PROGRAM; }
std::string locales_directory() { return STRUTT_LOCALES; }

}  // namespace strutt::test
