#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strutt/chart/axis.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/io/table.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// The [chart] table: every key is optional, flags may supply what is missing.
struct ChartTable {
  std::optional<Axis> x;
  std::optional<Axis> y;
  std::optional<std::vector<Layer>> layers;
  std::optional<double> tolerance;
};

/// A scene file as read.
struct SceneFile {
  std::string file;
  Scene scene;
  ChartTable chart;
};

/// Reads a TOML scene (see docs/scene.md). Everything that is not as documented is a FileError with file,
/// line, column, the key, the allowed range and, for an unknown key or name, the nearest known one: malformed
/// TOML, unknown keys or tables, wrong types, missing keys, two models, values outside their range (NaN and
/// infinities included), forms that exclude each other, units of the wrong dimension, nesting deeper than 32,
/// more than 1 MiB, bytes that are not UTF-8. The values are validated (strutt::validate), and that they make
/// an equation (strutt::linear_model). Throws InputOutputError if the file cannot be read.
SceneFile read_scene(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in messages; sample files are looked for beside `name`.
SceneFile parse_scene(std::string_view text, const std::string& name);

/// A number, or a number with a unit: "25 cm", "12 rad/s", "2 Hz" (-> rad/s), "30 deg". `dimension` is the SI
/// unit wanted
/// ("m", "rad/s", "1/s", "rad", "kg", "kg m^2", "m/s^2", "N m", "s", ""). Throws InvalidInput.
double parse_quantity(std::string_view text, std::string_view dimension);

/// The scene as TOML that parses back to the same scene, for --dry-run and provenance.
std::string to_toml(const SceneFile& scene);

}  // namespace strutt
