#pragma once

#include <string>

/// Where the build put things. In a file of its own: all others compile to the same objects in any folder, so
/// that a compiler cache serves every copy of the sources.
namespace strutt::test {

std::string source_directory();
std::string program_path();  ///< of the program `strutt`
std::string locales_directory();

}  // namespace strutt::test
