#pragma once

#include <filesystem>

#include "io/toml_reader.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt {

/// All tables of the scene but [chart], each value checked where it stands. Sample files are looked for in
/// `directory`.
Scene read_scene_tables(const TomlDocument& document, const std::filesystem::path& directory);

/// The [chart] table, against the parameters of the scene.
ChartTable read_chart_table(const TomlDocument& document, const toml::node& node, const Scene& scene);

}  // namespace strutt
