#pragma once

#include <filesystem>

#include "strutt/chart/surrogate.hpp"
#include "strutt/io/provenance.hpp"

namespace strutt {

/// Writes a surrogate as JSON: the scene as TOML, both axes, tolerance, kind, boxes with coefficients and
/// error bounds, how building and checking went, and the provenance. Numbers read back to the same bits.
/// Throws InputOutputError.
void save_surrogate(const std::filesystem::path& path, const Surrogate& surrogate,
                    const Provenance& provenance);

/// Reads such a file. Throws InputOutputError if it cannot be read, FileError if it is not one or is damaged.
Surrogate load_surrogate(const std::filesystem::path& path);

}  // namespace strutt
