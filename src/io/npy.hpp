#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strutt {

/// Magic, version 1.0 and the dictionary of an array in C order, padded so that the data begin at a multiple
/// of 64 bytes. `type` is "<f8" or "|i1".
std::string npy_header(std::string_view type, const std::vector<std::size_t>& shape);

}  // namespace strutt
