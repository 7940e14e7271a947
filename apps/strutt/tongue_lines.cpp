#include "tongue_lines.hpp"

#include <cmath>

#include "scene_arguments.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/table.hpp"

namespace strutt::app {
namespace {

/// A scene that is refused on every line, however short, is a mistake of the file.
void require_scene(const TonguesArguments& arguments, const SceneFile& file, const std::string& path) {
  if (!arguments.set.empty()) return;
  try {
    const double value = parameter(file.scene, path);
    require_tongue_line(file.scene, {path, value, std::nextafter(value, HUGE_VAL)});
  } catch (const InvalidInput& error) {
    throw FileError(file.file, 0, 0, error.what());
  }
}

}  // namespace

TongueLine usable_line(const TonguesArguments& arguments, const SceneFile& file) {
  const TongueLine line = line_of("--along", arguments.along, file.scene);
  try {
    require_tongue_line(file.scene, line);
    if (arguments.count && !has_tongue_index(file.scene, line))
      throw UsageError("--count: tongues of a system with more than one degree of freedom have no index");
  } catch (const InvalidInput& error) {
    require_scene(arguments, file, line.parameter);
    throw UsageError("--along '" + arguments.along + "': " + error.what());
  }
  return line;
}

SceneRows scene_rows(const TonguesArguments& arguments, const Scene& scene, const TongueLine& line,
                     const std::vector<std::string>& taken) {
  if (!arguments.at) return {.columns = {}, .scenes = {scene}};
  TableSchema schema{.required = {}, .optional = parameter_paths(scene)};
  for (const auto& path : taken) std::erase(schema.optional, path);
  for (const auto& path : schema.optional) {
    const std::string unit = parameter_info(scene, path).unit;
    if (!unit.empty()) schema.units[path] = unit;
  }
  NumericTable table = read_table(*arguments.at, schema);
  SceneRows lines{.columns = table.columns, .rows = table.rows, .scenes = {}};
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Scene changed = scene;
    for (std::size_t j = 0; j < table.columns.size(); ++j)
      parameter(changed, table.columns[j]) = table.rows[i][j];
    try {
      require_tongue_line(changed, line);
    } catch (const InvalidInput& error) {
      throw table.error_at(i, 0, error.what());
    }
    lines.scenes.push_back(std::move(changed));
  }
  return lines;
}

}  // namespace strutt::app
